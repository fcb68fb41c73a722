// Tables of the energy that GGX facets send on in one bounce, for what they lose by not following
// light from facet to facet. Made at first use, the same bits everywhere; numbers are stored as the
// bits of floats, for look-ups in lanes (energy.h).
#pragma once

#include <cstdint>

namespace energy {

// Rows by angle (Ggx::tablePlace()), columns by roughness from 0 to 1.
inline constexpr int kPlaces = 24, kRoughs = 24;
struct FacetTables {
    std::uint32_t all[kPlaces * kRoughs];  // of facets that reflect everything
    std::uint32_t rise[kPlaces * kRoughs]; // that reflect schlickPart()
    std::uint32_t bend[kPlaces * kRoughs]; // that reflect cos (1 - cos)^6
    std::uint32_t mean[kRoughs];           // of `all` over the hemisphere, weighted by the cosine
};
const FacetTables& facetTables(); // 4 ms at the first call

// The same for dielectric boundaries, a slice for each of some etas: eta < 1 first, then > 1. Slice
// k of a side has |1 - eta| / (1 + eta) = (k / (kSlices - 1))^2.
inline constexpr int kSlices = 32, kSlicePlaces = 16, kSliceRoughs = 16, kCosines = 16;
// The words of a slice: what is reflected and transmitted; from kReflected on the mean reflectance
// of the facets that reflect, rows by the square root of the cosine; at kMean Fresnel's part over
// the hemisphere, weighted by the cosine.
inline constexpr int kReflected = kSlicePlaces * kSliceRoughs;
inline constexpr int kMean = kReflected + kCosines * kSliceRoughs, kSliceWords = kMean + 1;
// The first word of the slices. Those that needSlice() hasn't made are empty.
const std::uint32_t* slices();
void needSlice(int k); // 2 ms at the first call for each

} // namespace energy
