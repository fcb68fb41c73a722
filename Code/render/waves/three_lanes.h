// Vectors of a register of points each.
#pragma once

#include "render/waves/lamp_lanes.h"
#include "simd/lanes.h"

#include <cstddef>

LANES_BEGIN

struct Three {
    Floats x, y, z;
    static Three load(const float (*v)[LitBlock::kPoints], std::size_t first) {
        return {Floats::load(v[0] + first), Floats::load(v[1] + first), Floats::load(v[2] + first)};
    }
    static Three all(float x, float y, float z) { return {Floats(x), Floats(y), Floats(z)}; }
};
inline Three operator+(Three a, Three b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Three operator-(Three a, Three b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Three operator*(Three a, Three b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Three operator*(Three a, Floats s) { return {a.x * s, a.y * s, a.z * s}; }
inline Three operator/(Three a, Floats s) { return {a.x / s, a.y / s, a.z / s}; }
inline Three select(Mask m, Three a, Three b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
inline Floats dot(Three a, Three b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline unsigned black(Three a) {
    const Floats zero(0.0f);
    return bits((a.x == zero) & (a.y == zero) & (a.z == zero));
}

LANES_END
