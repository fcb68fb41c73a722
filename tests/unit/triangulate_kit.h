// What the tests of triangulation share: polygons placed in space, and the check that the triangles
// cover a polygon once.
#pragma once

#include "check.h"
#include "read/mesh/exact_orientation.h"
#include "read/mesh/mesh_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace triangulate_kit {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Polygon = std::vector<Vec2d>;

inline Triangles trianglesOf(const std::vector<Vec3d>& corners) {
    Triangles triangles;
    triangulate(corners, triangles);
    return triangles;
}

// In the plane with axis `normal` dropped; `slope` tilts it, but leaves that axis the longest.
inline std::vector<Vec3d> placed(const Polygon& polygon, std::size_t normal = 2, double slope = 0) {
    std::vector<Vec3d> corners(polygon.size());
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        corners[i][(normal + 1) % 3] = polygon[i].x;
        corners[i][(normal + 2) % 3] = polygon[i].y;
        corners[i][normal] = slope * (polygon[i].x - polygon[i].y);
    }
    return corners;
}

inline double twiceArea(Vec2d a, Vec2d b, Vec2d c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}
inline double twiceArea(const Polygon& p) {
    double area = 0;
    for (std::size_t i = 1; i + 1 < p.size(); ++i) area += twiceArea(p[0], p[i], p[i + 1]);
    return area;
}

// All wound as the polygon and their areas its area: then none overlap and nothing is left out.
inline void checkCovers(const Polygon& p, const Triangles& triangles, const std::string& what) {
    CHECK_INFO(triangles.size() == p.size() - 2, what << ": " << triangles.size());
    const double area = twiceArea(p);
    const int turn = area < 0 ? -1 : 1;
    double sum = 0;
    std::vector<bool> used(p.size());
    for (const auto& t : triangles) {
        for (const std::uint32_t i : t) used.at(i) = true;
        const int sign = orientation(p[t[0]], p[t[1]], p[t[2]]);
        CHECK_INFO(sign * turn >= 0, what << ": triangle " << t[0] << ' ' << t[1] << ' ' << t[2]
                                          << " is turned round");
        sum += std::fabs(twiceArea(p[t[0]], p[t[1]], p[t[2]]));
    }
    CHECK_INFO(std::fabs(sum - std::fabs(area)) <= 1e-12 * std::fabs(area) + 1e-300,
               what << ": areas " << sum << " of " << std::fabs(area));
    CHECK_INFO(std::find(used.begin(), used.end(), false) == used.end(),
               what << ": a corner is not used");
}
// Both ways round, from several first corners, in all three planes.
inline void checkPolygon(Polygon p, const std::string& what) {
    for (int turned = 0; turned < 2; ++turned) {
        for (std::size_t i = 0; i < 3; ++i) {
            checkCovers(p, trianglesOf(placed(p, i, i == 1 ? 0.9 : 0)),
                        what + (turned ? " reversed" : "") + ", start " + std::to_string(i));
            std::rotate(p.begin(), p.begin() + 1 + static_cast<std::ptrdiff_t>(i) % 2, p.end());
        }
        std::reverse(p.begin(), p.end());
    }
}
// None without area either: what a polygon without three corners in line allows.
inline bool hasFlatTriangle(const Polygon& p) {
    for (const auto& t : trianglesOf(placed(p)))
        if (orientation(p[t[0]], p[t[1]], p[t[2]]) == 0) return true;
    return false;
}

inline double uniform(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

} // namespace triangulate_kit
