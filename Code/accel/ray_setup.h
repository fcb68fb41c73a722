// RaySetup: a ray prepared for boxes and triangles. Its parameter is the depth z along the ray's
// dominant axis instead of t (t = z / dz), because z of a vertex is one subtraction and therefore
// exact enough to order hits the same way in every kernel.
// One rounding per operation, no FMA: every kernel has to repeat these bits.
#pragma once

#include "base/bounds.h"
#include "base/ray.h"

#include <cmath>
#include <cstddef>
#include <limits>

struct RaySetup {
    Vec3 org;
    std::size_t k = 2, kx = 0, ky = 1; // dominant axis and the two lateral ones
    float sign = 1;                    // of the direction's dominant component
    float dz = 1;                      // its magnitude
    float dx = 0, dy = 0;              // the lateral components
    float Sx = 0, Sy = 0;              // slopes: lateral movement per unit of z
    float rx = 0, ry = 0;              // their inverses, kept finite
    float px = 0, py = 0;              // pads of the lateral box test of a triangle
    // Slabs of boxes: entry = plane * r + nearOffset, exit = plane * r + farOffset, in z.
    Vec3 r, nearOffset, farOffset;

    // `extent`: largest |coordinate| of any vertex or box of the space that the ray is traced in;
    // it is a property of the scene, never of a tree. See isTraceable for what rays are allowed.
    RaySetup(Vec3 rayOrg, Vec3 rayDir, float extent) : org(rayOrg) {
        const float ax = std::fabs(rayDir.x), ay = std::fabs(rayDir.y), az = std::fabs(rayDir.z);
        k = az >= ax && az >= ay ? 2 : ay >= ax ? 1 : 0;
        kx = k == 2 ? 0 : k + 1;
        ky = kx == 2 ? 0 : kx + 1;
        sign = rayDir[k] < 0 ? -1.0f : 1.0f;
        dz = std::fabs(rayDir[k]);
        dx = rayDir[kx], dy = rayDir[ky];
        Sx = dx / dz;
        Sy = dy / dz;
        rx = 1.0f / std::copysign(max(std::fabs(Sx), kSmallestSlope), Sx);
        ry = 1.0f / std::copysign(max(std::fabs(Sy), kSmallestSlope), Sy);
        // 2^-19 of the scale covers 32 roundings of a coordinate difference, with slack 2 to 3.
        const float e = max(extent, maxAbs(org)) * 0x1p-19f;
        px = e * std::fabs(rx);
        py = e * std::fabs(ry);
        r[k] = sign, r[kx] = rx, r[ky] = ry;
        const auto offsets = [&](std::size_t axis, float pad) {
            const float at = -org[axis] * r[axis];
            nearOffset[axis] = at - 2 * pad;
            farOffset[axis] = at + 2 * pad;
        };
        offsets(k, e);
        offsets(kx, px);
        offsets(ky, py);
    }

    // Entry depth of a box, or nothing reached (false) when the ray misses it or enters behind
    // zCut. Monotone in the planes, so a box never starts behind a box inside it, to the last bit.
    bool enters(const Bounds& box, float zCut, float& zEntry) const {
        float entry = 0, exit = zCut;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const bool backwards = r[axis] < 0;
            const float nearPlane = backwards ? box.hi[axis] : box.lo[axis];
            const float farPlane = backwards ? box.lo[axis] : box.hi[axis];
            entry = max(nearPlane * r[axis] + nearOffset[axis], entry);
            exit = min(farPlane * r[axis] + farOffset[axis], exit);
        }
        zEntry = entry;
        return entry <= exit;
    }

    static constexpr float kSmallestSlope = 1e-18f;
};

// Rays with a zero, NaN or infinite direction or origin meet nothing.
inline bool isTraceable(const Ray& ray) {
    const float d = maxAbs(ray.dir), o = maxAbs(ray.org);
    const float sum = (ray.dir.x + ray.dir.y + ray.dir.z) + (ray.org.x + ray.org.y + ray.org.z);
    return d > 1e-30f && d < 1e30f && o < 1e30f && sum - sum == 0;
}

// Depth behind which no box can hold a hit that beats `key`: 8 units of rounding more.
inline float depthCut(float key) {
    return key > 0 ? (1.0f / key) * 1.0000005f : std::numeric_limits<float>::max();
}
