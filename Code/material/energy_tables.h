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

// The same for dielectric boundaries: slices of some etas, eta < 1 first, then > 1. Slice k of a
// side has |1 - eta| / (1 + eta) = (k / (kSlices - 1))^2, and a column for each roughness. A column
// has what is reflected and transmitted by angle, and from kReflected on the mean reflectance of
// the facets that reflect, by the square root of the cosine.
inline constexpr int kSlices = 32, kSliceRoughs = 16, kSlicePlaces = 20, kCosines = 16;
inline constexpr int kReflected = kSlicePlaces, kColumnWords = kSlicePlaces + kCosines;
inline constexpr int kSliceWords = kSliceRoughs * kColumnWords;
// The first word of the first slice. Columns that needColumn() hasn't made are empty.
const std::uint32_t* slices();
void needColumn(int slice, int column); // 0.4 ms at the first call for each
// Fresnel's part over the hemisphere, weighted by the cosine, of each slice.
const std::uint32_t* sliceMeans();

} // namespace energy
