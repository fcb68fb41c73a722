// Stage of Whitted pictures at sixteen points: the rays of their lobes, what they make of even
// light, and the samples of lamps; and the table of all stages.
#pragma once

#include "integrate/lamp_rays_in_lanes.h"
#include "integrate/point_lanes.h"
#include "integrate/shading_kernel.h"
#include "integrate/sky_in_lanes.h"

LANES_BEGIN

// The rays that the lobes of some points send.
inline void sendRays(const WhittedBlock& block, const SeenPoints& at, const ShadingFrame& frame,
                     const Bsdf& bsdf, unsigned lanes, std::size_t first, BounceQueue& out) {
    const Floats pick = Floats::load(block.choice.v + first),
                 u = Floats::load(block.direction.u + first),
                 v = Floats::load(block.direction.v + first);
    bsdf.forEachBranch([&](std::size_t lobe, bool transmits) {
        const LobeSample next = bsdf.sampleLobe(lobe, transmits, pick, u, v);
        const SentRays ray =
            raysOf(at, frame, next.toLight, next.weight, next.pdf, next.single, lanes);
        storeChosen(ray.lanes, ray.org, out.org + out.rays);
        storeChosen(ray.lanes, ray.dir, out.dir + out.rays);
        storeChosen(ray.lanes, next.weight, out.weight + out.rays);
        storeChosenFloats(ray.lanes, select(next.single, Floats(0.0f), next.pdf),
                          out.pdf + out.rays);
        const unsigned below = bits(ray.isBelow);
        for (unsigned rest = ray.lanes; rest != 0; rest &= rest - 1) {
            const auto lane = static_cast<std::size_t>(std::countr_zero(rest));
            out.point[out.rays] = static_cast<std::uint8_t>(first + lane);
            out.branch[out.rays] = static_cast<std::uint8_t>(1 + 2 * lobe + transmits);
            out.isBelow[out.rays++] = (below >> lane & 1) != 0;
        }
    });
}

void whittedAtPoints(const PathLights& lights, std::span<LampQueue> lamps, const PointBlock& points,
                     const LobeBlock& lobes, WhittedBlock& block, BounceQueue& out) {
    out.rays = 0;
    const bool transmits = (lobes.flags & kTransmits) != 0;
    const auto sendToLamps = [&](unsigned lanes, std::size_t first, const SeenPoints& at,
                                 const ShadingFrame& frame, const Bsdf& bsdf) {
        for (LampQueue& lamp : lamps) {
            const PathLights::Entry& entry = lights.entry(lamp.light);
            withLights(lights, entry, {entry.row.numbers.data(), 1}, [&](const auto& light) {
                for (std::size_t s = 0; s < lamp.samples; ++s) {
                    Floats u(0.0f), v(0.0f);
                    if (lamp.places != nullptr) {
                        u = Floats::load(lamp.places[s].u + first);
                        v = Floats::load(lamp.places[s].v + first);
                    }
                    sendToLamp(light, entry, lamp, block, at, frame, bsdf, transmits, u, v, lanes,
                               first);
                }
            });
        }
    };
    const auto see = [&](std::size_t first) { return SeenPoints(points, first); };
    forEachRow(lobes, block.points, block.eta, see,
               [&](unsigned lanes, std::size_t first, const SeenPoints& at,
                   const ShadingFrame& frame, const Bsdf& bsdf) {
                   if (block.takesEvenLight)
                       store(loadThree(block.throughput, first) * bsdf.diffuseAlbedo(),
                             block.evenLight, first);
                   if (block.sendsRays) sendRays(block, at, frame, bsdf, lanes, first, out);
                   if (block.litOutside == 0) sendToLamps(lanes, first, at, frame, bsdf);
               });
    if (block.litOutside != 0)
        forEachRow(
            lobes, block.points, block.eta,
            [&](std::size_t first) { return litPoints(points, first, block.litOutside); },
            sendToLamps);
}

inline constexpr ShadingKernel kShading{seePoints, scatterBlock, whittedAtPoints, skyParts};

LANES_END
