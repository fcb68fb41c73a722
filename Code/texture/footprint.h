// UvFootprint: the part of a surface that a ray stands for, in texture coordinates.
#pragma once

#include "base/ray.h"
#include "base/vec.h"

#include <algorithm>
#include <cmath>

// Two conjugate axes of an ellipse, each from side to side. Zero: a single point.
struct UvFootprint {
    Vec2 along, across;
    bool isPoint() const { return along == Vec2{} && across == Vec2{}; }
};

// Returns the texture coordinates of a vector along the surface.
inline Vec2d uvOf(const SurfaceDerivatives& d, Vec3d along) {
    const Vec3d dpdu = toDouble(d.dpdu), dpdv = toDouble(d.dpdv), n = cross(dpdu, dpdv);
    const double area2 = dot(n, n);
    if (!(area2 > 0)) return {};
    return {dot(cross(along, dpdv), n) / area2, dot(cross(dpdu, along), n) / area2};
}

// Returns the ellipse in which a cone of some width around the unit direction `dir` meets the plane
// of a surface with the unit normal n.
inline UvFootprint footprintOn(float width, Vec3 dir, Vec3 n, const SurfaceDerivatives& d) {
    constexpr double kLeastCosine = 1.0 / 1024; // the length is no more than so many widths
    const Vec3d ray = toDouble(dir), normal = toDouble(n);
    const double cosine = dot(ray, normal), w = static_cast<double>(width);
    const Vec3d level = ray - normal * cosine;
    const double length2 = dot(level, level);
    // Straight from above any axis will do.
    const Vec3d side = std::fabs(normal.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
    const Vec3d axis =
        length2 > 1e-12 ? level / std::sqrt(length2) : normalize(cross(normal, side));
    const Vec2d along = uvOf(d, axis * (w / std::max(std::fabs(cosine), kLeastCosine)));
    const Vec2d across = uvOf(d, cross(normal, axis) * w);
    const auto isUsable = [](Vec2d v) {
        constexpr double kMost = 1e6; // of uv: nothing is to be seen of a picture
        return std::fabs(v.x) < kMost && std::fabs(v.y) < kMost;
    };
    if (!isUsable(along) || !isUsable(across)) return {};
    return {{static_cast<float>(along.x), static_cast<float>(along.y)},
            {static_cast<float>(across.x), static_cast<float>(across.y)}};
}
