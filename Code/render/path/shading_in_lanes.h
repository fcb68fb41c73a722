// Stages of Whitted pictures: the light of a lamp at sixteen points, the rays of their lobes, and
// what they make of even light.
#pragma once

#include "render/path/path_in_lanes.h"
#include "render/path/shading_kernel.h"

LANES_BEGIN

// Normals of the side whose lamps count: that of the eye, or the outside.
inline SeenPoints litPoints(const PointBlock& points, std::size_t first, unsigned litOutside) {
    SeenPoints at(points, first);
    const unsigned apart = litOutside >> first & SeenPoints::kAllLanes;
    if (apart == 0) return at;
    at.n = select(maskOf(apart), loadThree(points.litN, first), at.n);
    at.ng = select(maskOf(apart), negated(at.ng), at.ng); // it is on the side of the eye
    at.ns = select(maskOf(apart), negated(at.ns), at.ns);
    at.lift = select(maskOf(apart), rgbOf(0.0f), at.lift); // it was for the side of the eye
    at.lifted &= ~apart;
    return at;
}

void lampAtPoints(const PathLights& lights, std::uint32_t number, const PointBlock& points,
                  const LobeBlock& lobes, LampBlock& block) {
    const PathLights::Entry& entry = lights.entry(number);
    const Floats zero(0.0f);
    const bool transmits = (lobes.flags & kTransmits) != 0;
    LightColumns columns;
    for (std::size_t lane = 0; lane < W; ++lane) columns.put(entry.row, lane);
    forEachRow(
        lobes, block.points, block.eta,
        [&](std::size_t first) { return litPoints(points, first, block.litOutside); },
        [&](unsigned lanes, std::size_t first, const SeenPoints& at, const ShadingFrame& frame,
            const Bsdf& bsdf) {
            const SampledLight lamp =
                sampleOf(lights, entry, columns, at.p, Floats::load(block.u + first),
                         Floats::load(block.v + first));
            const Floats3 toLight = frame.toLocal(lamp.toLight);
            const auto [arrives, below] = arriving(at, lamp.toLight, toLight, transmits);
            lanes &= arrives & bits(maxOf(lamp.irradiance) > zero);
            if (lanes == 0) return;
            const bool isShared = block.besideRays && !entry.isOfSamplesAlone();
            const Floats pdf = isShared ? lamp.pdf * Floats(block.samples) : zero;
            const Floats3 light = loadThree(block.throughput, first) *
                                  bsdf.evalBesideRays(toLight, pdf) * lamp.irradiance *
                                  Floats(1 / block.samples);
            lanes &= bits(maxOf(light) > zero);
            storeWhere(lanes, light, block.light, first);
            storeWhere(lanes, shadowOrigin(at, below), block.org, first);
            storeWhere(lanes, lamp.toLight, block.dir, first);
            storeWhere(lanes, lamp.distance * Floats(PathLights::endOf(entry)), block.end + first);
            block.lit |= lanes << first;
        });
}

void bounceAtPoints(const PointBlock& points, const LobeBlock& lobes, std::size_t lobe,
                    bool transmits, PathBlock& block) {
    forEachRow(points, lobes, block,
               [&](unsigned lanes, std::size_t first, const SeenPoints& at,
                   const ShadingFrame& frame, const Bsdf& bsdf) {
                   const PathNumbers& u = block.numbers;
                   const LobeSample next = bsdf.sampleLobe(
                       lobe, transmits, Floats::load(u.lobe + first), Floats::load(u.bsdfU + first),
                       Floats::load(u.bsdfV + first));
                   sendRay(at, frame, {next.toLight, next.weight, next.pdf, next.single, maskOf(0)},
                           lanes, first, block);
               });
}

void ambientAtPoints(const PointBlock& points, const LobeBlock& lobes, PathBlock& block) {
    forEachRow(
        points, lobes, block,
        [&](unsigned lanes, std::size_t first, const SeenPoints&, const ShadingFrame&,
            const Bsdf& bsdf) { storeWhere(lanes, bsdf.diffuseAlbedo(), block.weight, first); });
}

constexpr ShadingKernel kShading{scatterBlock, lampAtPoints, bounceAtPoints, ambientAtPoints};

LANES_END
