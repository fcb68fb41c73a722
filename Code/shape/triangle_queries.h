// The questions that a ray asks of triangles, whatever finds the candidates: nearest, any, all.
// `candidates(setup, zCut, leaf)` calls leaf(number, corners, zCut) for every triangle that the ray
// may hit in front of zCut, in any order; leaf lowers zCut to the depth behind which nothing is
// wanted any more, and true stops. setup is that of the ray, in the space of the corners.
#pragma once

#include "accel/triangle.h"
#include "base/ray.h"

#include <array>
#include <cstdint>
#include <vector>

using TriangleCorners = std::array<Vec3, 3>;

// Which hits count. Asked of t itself, not of its key: a ray that goes on where it hit, from tMin =
// hit.t, must not hit the same triangle again by the rounding from one to the other.
struct KeyRange {
    float dz, tMin, tMax;
    float farthest() const { return depthCut(1.0f / (tMax * dz)); } // no box behind it counts
    bool contains(float key) const {
        if (!(key > 0)) return false;
        const float t = 1.0f / (key * dz);
        return t > tMin && t < tMax;
    }
};

inline float canonicalKey(const RaySetup& setup, const TriangleCorners& v) {
    return canonicalKey(setup, v[0], v[1], v[2]);
}

// Weights of the corners 1 and 2, from edge functions without error.
inline Vec2 barycentrics(const ShearedTriangle& sheared) {
    const Vec3d e = sheared.edgesExact();
    const double sum = e.x + e.y + e.z;
    return {static_cast<float>(e.y / sum), static_cast<float>(e.z / sum)};
}

// The nearest of the triangles that it was shown.
class NearestTriangle {
public:
    // Takes the triangle if it is nearer; lowers zCut then.
    void show(const RaySetup& setup, float tMin, std::uint32_t triangle, const TriangleCorners& v,
              float& zCut) {
        const float key = canonicalKey(setup, v);
        if (!KeyRange{setup.dz, tMin, kInfinityF}.contains(key)) return;
        if (key < key_ || (key == key_ && triangle > triangle_)) return;
        key_ = key;
        triangle_ = triangle;
        corners_ = v;
        zCut = min(depthCut(key), zCut);
    }
    // Writes t, u, v and prim if it is not behind hit.t.
    bool becomes(const RaySetup& setup, Hit& hit) const {
        const float t = 1.0f / (key_ * setup.dz);
        if (key_ == 0 || !(t <= hit.t)) return false;
        const Vec2 uv = barycentrics({setup, corners_[0], corners_[1], corners_[2]});
        hit.t = t;
        hit.u = uv.x;
        hit.v = uv.y;
        hit.prim = triangle_;
        return true;
    }

private:
    float key_ = 0;
    std::uint32_t triangle_ = 0;
    TriangleCorners corners_;
};

// Shape::intersect()
template <class Candidates>
bool nearestTriangle(const Ray& ray, const RaySetup& setup, Hit& hit, Candidates&& candidates) {
    NearestTriangle nearest;
    const float zLimit = depthCut(1.0f / (hit.t * setup.dz)); // behind it nothing is wanted
    candidates(setup, zLimit, [&](std::uint32_t triangle, const TriangleCorners& v, float& zCut) {
        nearest.show(setup, ray.tMin, triangle, v, zCut);
        return false;
    });
    return nearest.becomes(setup, hit);
}

// Shape::occludes()
template <class Candidates>
bool anyTriangle(const Ray& ray, const RaySetup& setup, Candidates&& candidates) {
    const KeyRange range{setup.dz, ray.tMin, ray.tMax};
    bool found = false;
    candidates(setup, range.farthest(), [&](std::uint32_t, const TriangleCorners& v, float&) {
        found = range.contains(canonicalKey(setup, v));
        return found;
    });
    return found;
}

// Shape::collect()
template <class Candidates>
void allTriangles(const Ray& ray, const RaySetup& setup, std::vector<Hit>& hits,
                  Candidates&& candidates) {
    const KeyRange range{setup.dz, ray.tMin, ray.tMax};
    const auto leaf = [&](std::uint32_t triangle, const TriangleCorners& v, float&) {
        const float key = canonicalKey(setup, v);
        if (!range.contains(key)) return false;
        const Vec2 uv = barycentrics({setup, v[0], v[1], v[2]});
        hits.push_back({.t = 1.0f / (key * setup.dz), .u = uv.x, .v = uv.y, .prim = triangle});
        return false;
    };
    candidates(setup, range.farthest(), leaf);
}
