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
    for (std::size_t first = 0; first < LampBlock::kPoints && block.points >> first != 0;
         first += W) {
        unsigned lanes = block.points >> first & SeenPoints::kAllLanes;
        if (lanes == 0) continue;
        const SeenPoints at = litPoints(points, first, block.litOutside);
        SampledLight lamp{rgbOf(0.0f), zero, rgbOf(0.0f), zero, noLanes()};
        const Floats u = Floats::load(block.u + first), v = Floats::load(block.v + first);
        if (entry.row.kind == PathLights::kSkyKind)
            lamp = SkyEmitter(lights.skyView()).sample(at.p, u, v);
        forLight(entry.row.kind, [&]<class L> {
            const L light(columns.numbers());
            lamp = block.inCentre ? light.centre(at.p) : light.sample(at.p, u, v);
        });
        const ShadingFrame frame = frameOf(lobes, first, at.n);
        const Floats3 toLight = frame.toLocal(lamp.toLight);
        const Floats rise = dot(at.ng, lamp.toLight);
        unsigned above = bits((rise > zero) & (toLight.z > zero));
        if (at.lifted != 0)
            above |= at.lifted & bits((dot(at.ns, lamp.toLight) > zero) & (toLight.z > zero));
        const unsigned below = transmits ? bits((rise < zero) & (toLight.z < zero)) : 0;
        lanes &= (above | below) & bits(maxOf(lamp.irradiance) > zero);
        if (lanes == 0) continue;
        const Bsdf bsdf(lobes, first, frame.toLocal(at.toEye), Floats::load(block.eta + first));
        const Floats pdf = entry.isOpen ? zero : lamp.pdf * Floats(block.samples);
        const Floats3 light = loadThree(block.throughput, first) *
                              bsdf.evalBesideRays(toLight, pdf) * lamp.irradiance *
                              Floats(1 / block.samples);
        lanes &= bits(maxOf(light) > zero);
        storeWhere(lanes, light, block.light, first);
        const Floats3 org = select(maskOf(below), at.beneath(), at.above() + at.lift);
        storeWhere(lanes, org, block.org, first);
        storeWhere(lanes, lamp.toLight, block.dir, first);
        storeWhere(lanes, lamp.distance * Floats(entry.isSurface ? 1 - 0x1p-15f : 1 - 0x1p-20f),
                   block.end + first);
        block.lit |= lanes << first;
    }
}

void bounceAtPoints(const PointBlock& points, const LobeBlock& lobes, std::size_t lobe,
                    bool transmits, PathBlock& block) {
    const Floats zero(0.0f);
    for (std::size_t first = 0; first < PathBlock::kPoints && block.points >> first != 0;
         first += W) {
        const unsigned lanes = block.points >> first & SeenPoints::kAllLanes;
        if (lanes == 0) continue;
        const SeenPoints at(points, first);
        const ShadingFrame frame = frameOf(lobes, first, at.n);
        const Bsdf bsdf(lobes, first, frame.toLocal(at.toEye), Floats::load(block.eta + first));
        const LobeSample next = bsdf.sampleLobe(
            lobe, transmits, Floats::load(block.numbers.lobe + first),
            Floats::load(block.numbers.bsdfU + first), Floats::load(block.numbers.bsdfV + first));
        sendRay(at, frame, {next.toLight, next.weight, next.pdf, next.single, maskOf(0)}, lanes,
                first, block);
    }
}

void ambientAtPoints(const PointBlock& points, const LobeBlock& lobes, PathBlock& block) {
    for (std::size_t first = 0; first < PathBlock::kPoints && block.points >> first != 0;
         first += W) {
        const unsigned lanes = block.points >> first & SeenPoints::kAllLanes;
        if (lanes == 0) continue;
        const SeenPoints at(points, first);
        const ShadingFrame frame = frameOf(lobes, first, at.n);
        const Bsdf bsdf(lobes, first, frame.toLocal(at.toEye), Floats::load(block.eta + first));
        storeWhere(lanes, bsdf.diffuseAlbedo(), block.weight, first);
    }
}

constexpr ShadingKernel kShading{scatterBlock, lampAtPoints, bounceAtPoints, ambientAtPoints};

LANES_END
