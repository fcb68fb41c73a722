// W rays in the lanes of registers: how they come from a batch, and RaySetup of accel/ray_setup.h
// for all of them at once, by the same formulas and with the same bits.
#pragma once

#include "accel/ray_setup.h"
#include "base/bounds.h"
#include "base/ray.h"
#include "base/vec.h"
#include "simd/lanes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

LANES_BEGIN

struct RayColumns {
    Floats org[3], dir[3], tMin, tMax;
    bool inARow; // W rays that follow each other in the batch
};

// The rays order[0 .. count - 1]; lanes behind them repeat the first. Their numbers go into `ray`.
inline RayColumns loadRays(const RaySpan& rays, const std::uint32_t* order, std::size_t count,
                           std::uint32_t (&ray)[W]) {
    RayColumns c;
    if (count == W)
        std::copy_n(order, W, ray);
    else
        for (std::uint32_t i = 0; i < W; ++i) ray[i] = order[i < count ? i : 0];
    c.inARow = count == W && bits(Ints::unaligned(order) == Ints::from(order[0])) == (1u << W) - 1;
    if (c.inARow) {
        loadVectors(&rays.org[order[0]].x, c.org[0], c.org[1], c.org[2]);
        loadVectors(&rays.dir[order[0]].x, c.dir[0], c.dir[1], c.dir[2]);
        c.tMin = Floats::unaligned(&rays.tMin[order[0]]);
        c.tMax = Floats::unaligned(&rays.tMax[order[0]]);
        return c;
    }
    alignas(64) float o[3][W], d[3][W], tMin[W], tMax[W];
    for (std::size_t i = 0; i < W; ++i) {
        const Vec3 org = rays.org[ray[i]], dir = rays.dir[ray[i]];
        o[0][i] = org.x, o[1][i] = org.y, o[2][i] = org.z;
        d[0][i] = dir.x, d[1][i] = dir.y, d[2][i] = dir.z;
        tMin[i] = rays.tMin[ray[i]], tMax[i] = rays.tMax[ray[i]];
    }
    for (int axis = 0; axis < 3; ++axis)
        c.org[axis] = Floats::load(o[axis]), c.dir[axis] = Floats::load(d[axis]);
    c.tMin = Floats::load(tMin), c.tMax = Floats::load(tMax);
    return c;
}

// depthCut() of positive keys; without an end for others.
inline Floats depthCuts(Floats key) {
    return select(key > Floats(0.0f), (Floats(1.0f) / key) * Floats(1.0000005f),
                  Floats(std::numeric_limits<float>::max()));
}

// The axes of W rays and what they move along them.
struct RayAxes {
    Mask alongZ, alongY; // the dominant axis; x if neither
    Floats sign, dz, Sx, Sy;
    Floats oMax;        // largest |coordinate| of the origin
    unsigned traceable; // isTraceable(), a bit each

    RayAxes() = default;
    [[gnu::always_inline]] explicit RayAxes(const RayColumns& c) {
        const Floats zero(0.0f);
        const Floats ax = abs(c.dir[0]), ay = abs(c.dir[1]), az = abs(c.dir[2]);
        alongZ = (az >= ax) & (az >= ay), alongY = ay >= ax;
        const Floats depth = dominant(c.dir);
        dz = abs(depth);
        sign = select(depth < zero, Floats(-1.0f), Floats(1.0f));
        Sx = lateralX(c.dir) / dz, Sy = lateralY(c.dir) / dz;
        oMax = max(max(abs(c.org[0]), abs(c.org[1])), abs(c.org[2]));
        const Floats sum = ((c.dir[0] + c.dir[1]) + c.dir[2]) + ((c.org[0] + c.org[1]) + c.org[2]);
        const Floats longest = max(max(ax, ay), az);
        traceable = bits((longest > Floats(1e-30f)) & (longest < Floats(1e30f)) &
                         (oMax < Floats(1e30f)) & (sum - sum == zero));
    }

    // 2^-19 of the scale.
    Floats errorIn(float extent) const { return max(Floats(extent), oMax) * Floats(0x1p-19f); }

    // By the dominant axis.
    Floats byAxis(Floats ifX, Floats ifY, Floats ifZ) const {
        return select(alongZ, ifZ, select(alongY, ifY, ifX));
    }
    // In the order (lateral x, lateral y, depth) of each ray's own axes.
    Floats lateralX(const Floats (&v)[3]) const { return byAxis(v[1], v[2], v[0]); }
    Floats lateralY(const Floats (&v)[3]) const { return byAxis(v[2], v[0], v[1]); }
    Floats dominant(const Floats (&v)[3]) const { return byAxis(v[0], v[1], v[2]); }

    // The depth behind which nothing is at t or before.
    // Farther than depthCut() of the key 1 / (t dz), which is off by three roundings at most.
    Floats cutAt(Floats t) const {
        return min(t * dz * Floats(1.000001f), Floats(std::numeric_limits<float>::max()));
    }
};

// With what boxes ask.
struct RayLanes : RayAxes {
    Floats error;
    Floats r[3], nearOffset[3], farOffset[3], room[3]; // slabs; room: of the offsets

    RayLanes() = default;
    [[gnu::always_inline]] RayLanes(const RayColumns& c, float extent)
        : RayLanes(c, RayAxes(c), extent) {}
    [[gnu::always_inline]] RayLanes(const RayColumns& c, const RayAxes& axes, float extent)
        : RayAxes(axes), error(errorIn(extent)) {
        const Floats one(1.0f), zero(0.0f);
        const Floats smallestSlope(RaySetup::kSmallestSlope);
        const Floats rx = one / withSign(max(abs(Sx), smallestSlope), Sx);
        const Floats ry = one / withSign(max(abs(Sy), smallestSlope), Sy);
        const Floats px = error * abs(rx), py = error * abs(ry);
        const auto slab = [&](int axis, Floats inverse, Floats pad) {
            const Floats at = (zero - c.org[axis]) * inverse;
            r[axis] = inverse;
            room[axis] = pad + pad;
            nearOffset[axis] = at - room[axis];
            farOffset[axis] = at + room[axis];
        };
        slab(0, byAxis(sign, ry, rx), byAxis(error, py, px));
        slab(1, byAxis(rx, sign, ry), byAxis(px, error, py));
        slab(2, byAxis(ry, rx, sign), byAxis(py, px, error));
    }

    // RaySetup::enters(), and where.
    unsigned entering(const Bounds& box, Floats zCut, Floats& entry) const {
        Floats exit = zCut;
        entry = Floats(0.0f);
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const Mask back = r[axis] < Floats(0.0f);
            const Floats lo(box.lo[a]), hi(box.hi[a]);
            entry = max(select(back, hi, lo) * r[axis] + nearOffset[axis], entry);
            exit = min(select(back, lo, hi) * r[axis] + farOffset[axis], exit);
        }
        return bits(entry <= exit);
    }
};

LANES_END
