// Stages of Whitted pictures at sixteen points: the rays of their lobes, and what they make of even
// light; and the table of all stages.
#pragma once

#include "render/path/lamp_rays_in_lanes.h"
#include "render/path/shading_kernel.h"
#include "render/waves/see_in_lanes.h"

LANES_BEGIN

void bounceAtPoints(const PointBlock& points, const LobeBlock& lobes, const PathBlock& block,
                    BounceQueue& out) {
    out.rays = 0;
    const PathNumbers& numbers = block.numbers;
    forEachRow(points, lobes, block,
               [&](unsigned lanes, std::size_t first, const SeenPoints& at,
                   const ShadingFrame& frame, const Bsdf& bsdf) {
                   const Floats pick = Floats::load(numbers.choice.v + first),
                                u = Floats::load(numbers.direction.u + first),
                                v = Floats::load(numbers.direction.v + first);
                   bsdf.forEachBranch([&](std::size_t lobe, bool transmits) {
                       const LobeSample next = bsdf.sampleLobe(lobe, transmits, pick, u, v);
                       const SentRays ray = raysOf(at, frame, next.toLight, next.weight, next.pdf,
                                                   next.single, lanes);
                       storeChosen(ray.lanes, ray.org, out.org + out.rays);
                       storeChosen(ray.lanes, ray.dir, out.dir + out.rays);
                       storeChosen(ray.lanes, next.weight, out.weight + out.rays);
                       storeChosenFloats(ray.lanes, select(next.single, Floats(0.0f), next.pdf),
                                         out.pdf + out.rays);
                       const unsigned below = bits(ray.isBelow);
                       for (unsigned rest = ray.lanes; rest != 0; rest &= rest - 1) {
                           const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
                           out.point[out.rays] = static_cast<std::uint8_t>(first + lane);
                           out.branch[out.rays] =
                               static_cast<std::uint8_t>(1 + 2 * lobe + transmits);
                           out.isBelow[out.rays++] = (below >> lane & 1) != 0;
                       }
                   });
               });
}

void ambientAtPoints(const PointBlock& points, const LobeBlock& lobes, PathBlock& block) {
    forEachRow(
        points, lobes, block,
        [&](unsigned lanes, std::size_t first, const SeenPoints&, const ShadingFrame&,
            const Bsdf& bsdf) { storeWhere(lanes, bsdf.diffuseAlbedo(), block.weight, first); });
}

constexpr ShadingKernel kShading{seePoints, scatterBlock, lampsAtPoints, bounceAtPoints,
                                 ambientAtPoints};

LANES_END
