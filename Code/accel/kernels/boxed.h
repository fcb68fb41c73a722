// What rays meet of one shape that all of them were asked about, as far as it lies in its box:
// RaySetup::enters() and the choice between hits, a register of rays at a time.
#pragma once

#include "accel/kernels/ray_lanes.h"
#include "accel/kernels/solids.h"
#include "base/ray.h"
#include "simd/lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

LANES_BEGIN

std::size_t nearerInBox(const BoxedShape& shape, const RaySpan& rays, Hit* found, Hit* best,
                        std::uint32_t* asFar) {
    std::size_t count = 0;
    alignas(64) float t[W], bestT[W];
    alignas(64) std::uint32_t order[W], ray[W];
    for (std::size_t first = 0; first < rays.size(); first += W) {
        const std::size_t some = std::min<std::size_t>(W, rays.size() - first);
        // Behind the last of them it comes again.
        const auto lane = [&](std::size_t i) { return first + std::min(i, some - 1); };
        const Ints shapes = loadWords([&](std::size_t i) { return &found[lane(i)].shape; });
        unsigned met = ~bits(shapes == Ints(Hit::kNoShape)) & ((1u << some) - 1);
        if (met == 0) continue;
        Ints::from(static_cast<std::uint32_t>(first)).store(order);
        const RayLanes lanes(loadRays(rays, order, some, ray), shape.extent);
        Floats here, farthest, ignored;
        loadPairs([&](std::size_t i) { return &found[lane(i)].t; }, here, ignored);
        loadPairs([&](std::size_t i) { return &best[lane(i)].t; }, farthest, ignored);
        Floats entry;
        met &= lanes.entering(shape.box, depthCuts(Floats(1.0f) / (farthest * lanes.dz)), entry);
        const Floats nearest = max(entry / lanes.dz, here);
        nearest.store(t), farthest.store(bestT);
        for (unsigned rest = met & bits(nearest <= farthest); rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            Hit& hit = found[first + i];
            if (t[i] < bestT[i])
                best[first + i] = {t[i], hit.u, hit.v, hit.prim, shape.number};
            else
                hit.t = t[i], hit.shape = shape.number, asFar[count++] = order[i];
        }
    }
    return count;
}

LANES_END
