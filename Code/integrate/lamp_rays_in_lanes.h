// Shadow rays of Whitted pictures, with the light that arrives if nothing is in between.
#pragma once

#include "integrate/path_in_lanes.h"
#include "integrate/point_lanes.h"
#include "integrate/ray_from_lamp.h"
#include "integrate/shading_kernel.h"

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

// The rays of one sample of a lamp, by two numbers.
template <class L>
void sendToLamp(const L& emitter, const PathLights::Entry& entry, LampQueue& lamp,
                const WhittedBlock& block, const SeenPoints& at, const ShadingFrame& frame,
                const Bsdf& bsdf, bool transmits, Floats u, Floats v, unsigned lanes,
                std::size_t first) {
    const SampledLight light = sampleOf(emitter, entry, at.p, u, v);
    const Floats3 toLight = frame.toLocal(light.toLight);
    const auto [arrives, below] = arriving(at, light.toLight, toLight, transmits);
    const Floats zero(0.0f);
    lanes &= arrives & bits(maxOf(light.irradiance) > zero);
    if (lanes == 0) return;
    const bool isShared = block.besideRays && !entry.isOfSamplesAlone();
    const Floats pdf = isShared ? light.pdf * Floats(static_cast<float>(lamp.samples)) : zero;
    const Floats3 sent = loadThree(block.throughput, first) * bsdf.evalBesideRays(toLight, pdf) *
                         light.irradiance * Floats(lamp.share);
    lanes &= bits(maxOf(sent) > zero);
    if (lanes == 0) return;
    auto& to = lamp.to;
    if (entry.isPlace) {
        const Mask isBelow = maskOf(below);
        const RayFromLamp ray =
            rayFromLamp(at.p, select(isBelow, rgbOf(0.0f), at.lift),
                        select(isBelow, negated(at.ng), at.ng), at.error, at.rayError, entry.place);
        storeChosen(lanes, ray.dir, to.dir + lamp.rays);
        storeChosenFloats(lanes, ray.end, to.end + lamp.rays);
    } else {
        const Floats end = light.distance * Floats(PathLights::endOf(entry));
        const ShadowRays rays = entry.isSurface
                                    ? shadowRays(at, below, light.toLight, light.distance, end)
                                    : ShadowRays{shadowOrigin(at, below), light.toLight, end};
        storeChosen(lanes, rays.org, to.org + lamp.rays);
        storeChosen(lanes, rays.dir, to.dir + lamp.rays);
        storeChosenFloats(lanes, rays.end, to.end + lamp.rays);
    }
    storeChosen(lanes, sent, to.light + lamp.rays);
    for (; lanes != 0; lanes &= lanes - 1)
        to.point[lamp.rays++] =
            block.number[first + static_cast<std::size_t>(std::countr_zero(lanes))];
}

LANES_END
