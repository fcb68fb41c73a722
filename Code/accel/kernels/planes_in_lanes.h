// The steps of canHit(), AnalyticShape::rootsOf() and InfinitePlane::roots() for W rays at a time.
#pragma once

#include "accel/kernels/planes.h"
#include "accel/kernels/vectors3.h"
#include "base/math.h"
#include "base/ray_span.h"
#include "simd/lanes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

LANES_BEGIN

// W rays from `first` on; lanes behind the last ray repeat it.
struct RaysForPlane {
    Floats org[3], dir[3], tMin, tMax;
    unsigned lanes; // that there are rays for

    RaysForPlane(const RaySpan& rays, std::size_t first) {
        if (first + W <= rays.size()) {
            loadVectors(&rays.org[first].x, org[0], org[1], org[2]);
            loadVectors(&rays.dir[first].x, dir[0], dir[1], dir[2]);
            tMin = Floats::unaligned(&rays.tMin[first]);
            tMax = Floats::unaligned(&rays.tMax[first]);
            lanes = (1u << W) - 1;
            return;
        }
        alignas(64) float o[3][W], d[3][W], near[W], far[W];
        for (std::size_t i = 0; i < W; ++i) {
            const std::size_t ray = std::min(first + i, rays.size() - 1);
            for (std::size_t axis = 0; axis < 3; ++axis)
                o[axis][i] = rays.org[ray][axis], d[axis][i] = rays.dir[ray][axis];
            near[i] = rays.tMin[ray], far[i] = rays.tMax[ray];
        }
        for (std::size_t axis = 0; axis < 3; ++axis)
            org[axis] = Floats::load(o[axis]), dir[axis] = Floats::load(d[axis]);
        tMin = Floats::load(near), tMax = Floats::load(far);
        lanes = (1u << (rays.size() - first)) - 1;
    }
    // isTraceable()
    Mask traceable() const {
        const auto largest = [](const Floats(&v)[3]) {
            return max(max(abs(v[0]), abs(v[1])), abs(v[2]));
        };
        const Floats d = largest(dir), o = largest(org);
        const Floats sum = (dir[0] + dir[1] + dir[2]) + (org[0] + org[1] + org[2]);
        return (d > Floats(1e-30f)) & (d < Floats(1e30f)) & (o < Floats(1e30f)) &
               (sum - sum == Floats(0.0f));
    }
};

// Squares of what it maps traceable rays to are finite.
inline bool isTame(const StillPlane& plane) {
    return std::all_of(plane.objectFromWorld.begin(), plane.objectFromWorld.end(),
                       [](double entry) { return std::fabs(entry) < 1e100; });
}

// Heights of the rays over the plane, and their change with t.
struct Heights {
    Doubles org, dir;
    unsigned lanes; // of those that cross the plane somewhere, on their whole lines

    [[gnu::always_inline]] Heights(const StillPlane& plane, bool tame, const RaysForPlane& rays)
        : org(0.0), dir(0.0) {
        const Doubles3 o = Doubles3::of(rays.org[0], rays.org[1], rays.org[2]);
        const Doubles3 d = Doubles3::of(rays.dir[0], rays.dir[1], rays.dir[2]);
        const auto row = [&](std::size_t first, const Doubles3& v) {
            const double* const m = &plane.objectFromWorld[first];
            return Doubles(m[0]) * v.x + Doubles(m[1]) * v.y + Doubles(m[2]) * v.z;
        };
        const auto placed = [&](std::size_t first) {
            return row(first, o) + Doubles(plane.objectFromWorld[first + 3]);
        };
        org = placed(8), dir = row(8, d);
        const Doubles zero(0.0), speed = abs(dir);
        lanes = less(zero, speed) & bits(rays.traceable()) & rays.lanes;
        // Rays whose direction has no length, or an endless one, meet nothing. These have one:
        if (tame && (lanes & ~less(Doubles(1e-150), speed)) == 0) return;
        const Doubles3 from{placed(0), placed(4), org}, to{row(0, d), row(4, d), dir};
        const Doubles dd = dot(to, to), endless(kInfinity);
        lanes &= less(zero, dd) & less(dd, endless) & less(dot(from, from), endless);
    }

    // Lanes that do not leave the plane behind at t = 0.
    unsigned ahead() const {
        const Doubles zero(0.0);
        return (less(zero, org) & less(dir, zero)) | (less(org, zero) & less(zero, dir));
    }
    // Those ahead that end in front of the plane: clearly, so that rounding does not matter.
    unsigned endInFront(const Doubles& tMax) const {
        const Doubles end = org + dir * tMax, least = abs(org) * Doubles(0x1p-40), zero(0.0);
        return (less(least, end) & less(zero, org)) | (less(end, zero - least) & less(org, zero));
    }
    Doubles crossing() const { return (Doubles(-0.0) - org) / dir; }
};

// What W rays meet of a plane in front of them, whatever else there is.
struct PlaneHits {
    Floats t, lost; // lost: by rounding, as in Hit::u
    unsigned lanes = 0;

    [[gnu::always_inline]] PlaneHits(const StillPlane& plane, bool tame, const RaysForPlane& rays)
        : t(0.0f), lost(0.0f) {
        const Floats zero(0.0f);
        const Heights heights(plane, tame, rays);
        lanes = heights.lanes & (heights.ahead() | bits(rays.tMin < zero));
        if (lanes == 0) return; // most divisions are saved
        const Doubles exact = heights.crossing();
        const Floats rounded = exact.toFloats();
        lanes &= bits((rounded > rays.tMin) & (rounded < Floats(kInfinityF)));
        t = max(rounded, zero), lost = (exact - Doubles(rounded)).toFloats();
    }
};

void firstOfPlane(const StillPlane& plane, std::uint32_t number, const RaySpan& rays, Hit* hits) {
    const bool tame = isTame(plane);
    const Floats zero(0.0f);
    for (std::size_t first = 0; first < rays.size(); first += W) {
        const RaysForPlane block(rays, first);
        const PlaneHits met(plane, tame, block);
        const Mask isMet = maskOf(met.lanes & bits(met.t <= block.tMax));
        const auto put = [&](Hit* to) {
            storeRows(select(isMet, met.t, block.tMax), select(isMet, met.lost, zero), zero,
                      Ints(0u), select(isMet, Ints(number), Ints(Hit::kNoShape)), &to->t);
        };
        if (first + W <= rays.size()) {
            put(hits + first);
            continue;
        }
        std::array<Hit, W> last;
        put(last.data());
        std::copy_n(last.begin(), rays.size() - first, hits + first);
    }
}

std::size_t closestOfPlane(const StillPlane& plane, std::uint32_t number, const RaySpan& rays,
                           Hit* best, PlaneHit* asFar) {
    const bool tame = isTame(plane);
    std::size_t count = 0;
    alignas(64) float t[W], lost[W];
    for (std::size_t first = 0; first < rays.size(); first += W) {
        const PlaneHits met(plane, tame, RaysForPlane(rays, first));
        if (met.lanes == 0) continue;
        met.t.store(t), met.lost.store(lost);
        // Number by number, as the hits came: the processor waits for wider ones.
        for (unsigned rest = met.lanes; rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            Hit& hit = best[first + i];
            if (t[i] < hit.t) {
                hit.t = t[i], hit.u = lost[i], hit.v = 0;
                hit.prim = 0, hit.shape = number;
            } else if (t[i] == hit.t) {
                asFar[count++] = {static_cast<std::uint32_t>(first + i), t[i], lost[i]};
            }
        }
    }
    return count;
}

void anyOfPlane(const StillPlane& plane, const RaySpan& rays, std::uint8_t* hidden) {
    const bool tame = isTame(plane);
    for (std::size_t first = 0; first < rays.size(); first += W) {
        const RaysForPlane block(rays, first);
        const Heights heights(plane, tame, block);
        const unsigned mayMeet = (heights.ahead() & ~heights.endInFront(Doubles(block.tMax))) |
                                 bits(block.tMin < Floats(0.0f));
        unsigned met = heights.lanes & mayMeet;
        if (met == 0) continue; // most divisions are saved
        const Floats t = heights.crossing().toFloats();
        met &= bits((t > block.tMin) & (t < block.tMax));
        for (; met != 0; met &= met - 1)
            hidden[first + static_cast<std::size_t>(std::countr_zero(met))] = 1;
    }
}

LANES_END
