// Tables of the energy that GGX facets send on in one bounce, for what they lose by not following
// light from facet to facet. Made at first use, the same bits everywhere; numbers are stored as the
// bits of floats, for look-ups in lanes (energy.h).
#pragma once

#include <atomic>
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
// side has |1 - eta| / (1 + eta) = (k / (kSlices - 1))^4, and a column for each roughness.
inline constexpr int kSlices = 96, kSliceRoughs = 24;
struct SliceTable {
    int rows; // of a column
    void (*makeColumn)(std::uint32_t* column, double eta, double alpha);
    std::uint32_t* words; // the first slice; columns that need() hasn't made are empty
    std::atomic<bool>* columnIsMade;

    int sliceWords() const { return kSliceRoughs * rows; }
    void need(int slice, int column) const;
};
// What facets reflect and transmit, by Ggx::glassPlace(). A column takes 0.9 ms.
extern const SliceTable kSentOn;
// The mean reflectance of the facets that reflect, by the square root of the cosine. A column takes
// 0.1 ms.
extern const SliceTable kReflected;
// Fresnel's part over the hemisphere, weighted by the cosine, of each slice.
const std::uint32_t* sliceMeans();

} // namespace energy
