// Vectors of the points of a block, W points from one of them on.
#pragma once

#include "base/surface_block.h"
#include "simd/vectors3.h"

#include <cstddef>

LANES_BEGIN

constexpr unsigned kEvery = (1u << W) - 1; // a bit for each lane

using Lane = SurfaceBlock::Lane;

inline Floats3 load(const Lane (&v)[3], std::size_t first) {
    return {Floats::load(v[0] + first), Floats::load(v[1] + first), Floats::load(v[2] + first)};
}
inline void store(const Floats3& v, Lane (&to)[3], std::size_t first) {
    v.x.store(to[0] + first), v.y.store(to[1] + first), v.z.store(to[2] + first);
}
// Sixteen vectors or colours that follow each other.
template <class T> Floats3 loadRow(const T* v, std::size_t first) {
    static_assert(sizeof(T) == 3 * sizeof(float));
    Floats3 out;
    loadVectors(reinterpret_cast<const float*>(v + first), out.x, out.y, out.z);
    return out;
}
template <class T> void storeChosen(unsigned lanes, const Floats3& v, T* to) {
    static_assert(sizeof(T) == 3 * sizeof(float));
    storeChosenVectors(lanes, v.x, v.y, v.z, reinterpret_cast<float*>(to));
}

LANES_END
