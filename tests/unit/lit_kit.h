// Points that a lamp lights, alone and in blocks, for the tests of lamps in lanes.
#pragma once

#include "base/hit.h"
#include "material/material.h"
#include "render/waves/lamp_lanes.h"
#include "verify/meshes.h"

#include <bit>
#include <cmath>
#include <vector>

namespace litkit {

using meshes::Random;

struct Point {
    Surface surface;
    Vec3 n, toEye;
    Rgb weight;
    Material material;
};

inline Rgb someLight(Random& random, double black) {
    if (random.chance(black)) return {};
    const auto channel = [&] { return static_cast<float>(random.unit()); };
    return {channel(), random.chance(0.1) ? 0 : channel(), channel()};
}

inline Point somePoint(Random& random, Vec3 lamp) {
    Point point;
    Surface& s = point.surface;
    s.p = toFloat(random.inBox(random.chance(0.1) ? 1e4 : 1));
    if (random.chance(0.05)) s.p = lamp;
    if (random.chance(0.05))
        s.p = lamp + toFloat(random.direction() * random.logUniform(1e-22, 1e-5));
    s.ng = toFloat(random.direction());
    const Vec3d toLamp = normalize(toDouble(lamp) - toDouble(s.p));
    if (random.chance(0.3)) // the lamp near the horizon
        s.ng = toFloat(normalize(cross(toLamp, random.direction()) +
                                 toLamp * random.uniform(-1, 1) * 0x1p-14));
    s.ns =
        random.chance(0.5) ? s.ng : toFloat(normalize(toDouble(s.ng) + random.direction() * 0.5));
    point.n =
        random.chance(0.5) ? s.ns : toFloat(normalize(toDouble(s.ns) + random.direction() * 0.3));
    s.error = random.chance(0.1) ? 0 : static_cast<float>(random.logUniform(1e-9, 1e-2));
    s.rayError = random.chance(0.5) ? 0 : 0x1p-22f;
    if (random.chance(0.3)) s.lift = s.ng * static_cast<float>(random.logUniform(1e-8, 1e-2));
    point.toEye = toFloat(random.direction());
    if (random.chance(0.2)) // in the middle of the highlight
        point.toEye =
            toFloat(normalize(toDouble(point.n) * (2 * dot(toDouble(point.n), toLamp)) - toLamp));
    point.weight = someLight(random, 0.05);
    point.material.diffuse = someLight(random, 0.1);
    point.material.specular = someLight(random, 0.4);
    point.material.specularModel = static_cast<SpecularModel>(random.below(LitBlock::kModels));
    point.material.exponent =
        random.chance(0.1) ? 0 : static_cast<float>(random.logUniform(1, 1e5));
    if (random.chance(0.5)) // of these, powers are taken by squares
        point.material.exponent = std::floor(point.material.exponent);
    return point;
}

inline void put(float (*to)[LitBlock::kPoints], std::size_t i, Vec3 v) {
    to[0][i] = v.x, to[1][i] = v.y, to[2][i] = v.z;
}
inline Vec3 taken(const float (*from)[LitBlock::kPoints], std::size_t i) {
    return {from[0][i], from[1][i], from[2][i]};
}
// Of numbers that are none the payload may be another one.
inline bool sameBits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (a != a && b != b);
}
inline bool sameBits(Vec3 a, Vec3 b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z);
}

inline LitBlock blockOf(const std::vector<Point>& points) {
    LitBlock block;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const auto& [s, n, toEye, weight, m] = points[i];
        put(block.p, i, s.p), put(block.lift, i, s.lift), put(block.ng, i, s.ng);
        put(block.ns, i, s.ns), put(block.n, i, n), put(block.toEye, i, toEye);
        put(block.weight, i, {weight.r, weight.g, weight.b});
        put(block.diffuse, i, {m.diffuse.r, m.diffuse.g, m.diffuse.b});
        put(block.specular, i, {m.specular.r, m.specular.g, m.specular.b});
        block.exponent[i] = m.exponent, block.error[i] = s.error, block.rayError[i] = s.rayError;
        block.used |= 1u << i;
        if (s.lift != Vec3{}) block.lifted |= 1u << i;
        if (!isBlack(m.specular)) block.shiny[static_cast<std::size_t>(m.specularModel)] |= 1u << i;
    }
    return block;
}

} // namespace litkit
