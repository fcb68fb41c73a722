// Stage of the path tracer: at each of sixteen points, light of one lamp that is chosen, and the
// direction in which the path goes on.
#pragma once

#include "integrate/bsdf_in_lanes.h"
#include "integrate/light_choice_in_lanes.h"
#include "integrate/shading_kernel.h"
#include "sample/power_heuristic.h"

#include <cstddef>

LANES_BEGIN

inline Floats3 loadThree(const float (*v)[PathBlock::kPoints], std::size_t first) {
    return {Floats::load(v[0] + first), Floats::load(v[1] + first), Floats::load(v[2] + first)};
}
inline void storeWhere(unsigned lanes, Floats v, float* to) {
    select(maskOf(lanes), v, Floats::load(to)).store(to);
}
inline void storeWhere(unsigned lanes, const Floats3& v, float (*to)[PathBlock::kPoints],
                       std::size_t first) {
    storeWhere(lanes, v.x, to[0] + first), storeWhere(lanes, v.y, to[1] + first),
        storeWhere(lanes, v.z, to[2] + first);
}

// The geometry of W points as it is seen from the eye.
struct SeenPoints {
    Floats3 p, ng, n, lift; // normals on the side of the eye
    Floats error, rayError;
    unsigned lifted; // lanes where the horizon of ns has a say, too
    Floats3 ns, toEye;

    SeenPoints(const PointBlock& block, std::size_t first)
        : p(loadThree(block.p, first)), ng(loadThree(block.ng, first)),
          n(loadThree(block.n, first)), lift(rgbOf(0.0f)), error(Floats::load(block.error + first)),
          rayError(Floats::load(block.rayError + first)), lifted(0), ns(ng),
          toEye(loadThree(block.toEye, first)) {
        const Mask front = maskOf(block.front >> first & kAllLanes);
        const unsigned curved = block.curved >> first & kAllLanes;
        ng = select(front, ng, negated(ng));
        if (curved == 0) return;
        const Floats3 curvedNormal = loadThree(block.ns, first);
        ns = select(maskOf(curved), select(front, curvedNormal, negated(curvedNormal)), ng);
        lift = select(maskOf(curved), loadThree(block.lift, first), lift);
        const Floats zero(0.0f);
        lifted = curved & ~bits((lift.x == zero) & (lift.y == zero) & (lift.z == zero));
    }
    // Where rays start that leave to the side of the eye, or to the other one.
    Floats3 above() const { return p + ng * error; }
    Floats3 beneath() const { return p - ng * error; }

    static constexpr unsigned kAllLanes = (1u << W) - 1;
};

// The shading frame of W points: z is the normal, and where lobes look at it x is along dp/du.
inline ShadingFrame frameOf(const LobeBlock& lobes, std::size_t first, const Floats3& n) {
    const ShadingFrame any = frameAroundZ(n);
    const unsigned turned = lobes.turned >> first & SeenPoints::kAllLanes;
    if (turned == 0) return any;
    const Floats3 t = loadThree(lobes.tangent, first), level = t - n * dot(n, t);
    const Floats length2 = dot(level, level);
    const Mask is = maskOf(turned) & (length2 > Floats(0.0f));
    const Floats3 x = select(is, level / sqrt(length2), any.x);
    return {x, select(is, cross(n, x), any.y), n};
}

// The lanes among which light from a direction arrives: above the horizon of the surface, or of the
// curve that its normals pretend, or from behind where lobes transmit.
struct Arriving {
    unsigned lanes, below;
};
inline Arriving arriving(const SeenPoints& at, const Floats3& dir, const Floats3& toLight,
                         bool transmits) {
    const Floats zero(0.0f), rise = dot(at.ng, dir);
    const unsigned up = bits(toLight.z > zero);
    unsigned above = bits(rise > zero) & up;
    if (at.lifted != 0) above |= at.lifted & bits(dot(at.ns, dir) > zero) & up;
    const unsigned below = transmits ? bits((rise < zero) & (toLight.z < zero)) : 0;
    return {above | below, below};
}
// Where shadow rays to it start.
inline Floats3 shadowOrigin(const SeenPoints& at, unsigned below) {
    return select(maskOf(below), at.beneath(), at.above() + at.lift);
}

// Shadow rays to a place that a lamp has in this direction from the point, at this distance. They
// start off the surface, and from there it is in another direction: along the old one, rays would
// end beside it, and meet a lamp that is a surface (shining_surfaces_light_as_lamps_do). They end
// some errors before it: in a ball that shines they lead along its surface (T23a).
struct ShadowRays {
    Floats3 org, dir;
    Floats end;
};
inline ShadowRays shadowRays(const SeenPoints& at, unsigned below, const Floats3& toLight,
                             Floats distance, Floats end) {
    const Floats3 org = shadowOrigin(at, below), way = toLight * distance - (org - at.p);
    const Floats far = sqrt(dot(way, way));
    const Mask isNear = distance < Floats(1e30f); // not suns and skies
    const Floats before = end * (far / distance) - Floats(8.0f) * at.error;
    return {org, select(isNear, way / far, toLight),
            select(isNear, max(before, Floats(0.0f)), end)};
}

// Calls fn(lanes, first, points as they are seen, frame, Bsdf) for each register of a block.
template <class See, class Fn>
void forEachRow(const LobeBlock& lobes, unsigned points, const LobeBlock::Lane& eta, See&& see,
                Fn&& fn) {
    for (std::size_t first = 0; first < LobeBlock::kPoints && points >> first != 0; first += W) {
        const unsigned lanes = points >> first & SeenPoints::kAllLanes;
        if (lanes == 0) continue;
        const SeenPoints at = see(first);
        const ShadingFrame frame = frameOf(lobes, first, at.n);
        Bsdf bsdf(lobes, first, frame.toLocal(at.toEye), Floats::load(eta + first));
        fn(lanes, first, at, frame, bsdf);
    }
}
template <class Fn>
void forEachRow(const PointBlock& points, const LobeBlock& lobes, const PathBlock& block, Fn&& fn) {
    forEachRow(
        lobes, block.points, block.eta,
        [&](std::size_t first) { return SeenPoints(points, first); }, fn);
}

// Light of one lamp, for points whose bits are set.
inline void sendLight(const PathLights& lights, const SeenPoints& at, const ShadingFrame& frame,
                      const Bsdf& bsdf, bool transmits, unsigned lanes, std::size_t first,
                      PathBlock& block) {
    const Floats zero(0.0f);
    const PathNumbers& u = block.numbers;
    const ChosenLight chosen =
        chooseLight(lights, at.p, transmits ? rgbOf(0.0f) : at.n, Floats::load(u.choice.u + first),
                    Floats::load(u.goesOn.u + first), Floats::load(u.onLight.u + first),
                    Floats::load(u.onLight.v + first), lanes);
    const SampledLight& lamp = chosen.sample;
    const Floats3 toLight = frame.toLocal(lamp.toLight);
    const auto [arrives, below] = arriving(at, lamp.toLight, toLight, transmits);
    lanes &= arrives & bits(maxOf(lamp.irradiance) > zero);
    if (lanes == 0) return;
    const Bsdf::Value value = bsdf.eval(toLight);
    const Floats pdf = lamp.pdf * chosen.probability;
    const Floats part = select(maskOf(bits(lamp.single) | ~chosen.met), Floats(1.0f),
                               powerHeuristic(pdf, value.pdf));
    const Floats3 light = loadThree(block.throughput, first) * value.f * lamp.irradiance *
                          (part / chosen.probability);
    lanes &= bits(maxOf(light) > zero);
    if (lanes == 0) return;
    storeWhere(lanes, light, block.fromLamp, first);
    const ShadowRays rays = shadowRays(at, below, lamp.toLight, lamp.distance, chosen.end);
    storeWhere(lanes, rays.dir, block.toLamp, first);
    storeWhere(lanes, rays.end, block.lampEnd + first);
    storeWhere(lanes, rays.org, block.lampOrg, first);
    block.lit |= lanes << first, block.open |= (lanes & chosen.open) << first;
}

// Rays of sampled directions: from which side of the surface they leave.
struct SentRays {
    unsigned lanes;
    Floats3 org, dir;
    Mask isBelow;
};
// Sampled directions as rays, in the lanes where they are on the right side of the surface.
inline SentRays raysOf(const SeenPoints& at, const ShadingFrame& frame, const Floats3& toLight,
                       const Floats3& weight, Floats pdf, Mask single, unsigned lanes) {
    const Floats zero(0.0f);
    Floats3 dir = normalize(frame.toWorld(toLight));
    const Mask transmitted = toLight.z < zero;
    Floats rise = dot(at.ng, dir);
    // A mirrored direction that bent normals lead below the surface is mirrored by the surface.
    const unsigned sunk = bits(single) & ~bits(transmitted) & ~bits(rise > zero);
    if ((sunk & lanes) != 0) {
        const Floats3 toEye = at.toEye;
        const Floats3 flat = normalize(at.ng * (Floats(2.0f) * dot(at.ng, toEye)) - toEye);
        dir = select(maskOf(sunk), flat, dir), rise = dot(at.ng, dir);
    }
    const Mask isBelow = rise < zero;
    const unsigned rightSide =
        (bits(transmitted) & bits(isBelow)) | (~bits(transmitted) & bits(rise > zero));
    lanes &= rightSide & bits((pdf > zero) & (maxOf(weight) > zero));
    return {lanes, select(isBelow, at.beneath(), at.above()), dir, isBelow};
}

inline void sendRay(const SeenPoints& at, const ShadingFrame& frame, const BsdfSample& next,
                    unsigned lanes, std::size_t first, PathBlock& block) {
    const SentRays ray = raysOf(at, frame, next.toLight, next.weight, next.pdf, next.single, lanes);
    if (ray.lanes == 0) return;
    storeWhere(ray.lanes, ray.dir, block.dir, first);
    storeWhere(ray.lanes, ray.org, block.org, first);
    storeWhere(ray.lanes, next.weight, block.weight, first);
    storeWhere(ray.lanes, select(next.single, Floats(0.0f), next.pdf), block.pdf + first);
    block.scattered |= ray.lanes << first;
    block.single |= (ray.lanes & bits(next.single)) << first;
    block.diffuse |= (ray.lanes & bits(next.diffuse)) << first;
    block.transmitted |= (ray.lanes & bits(ray.isBelow)) << first;
}

void scatterBlock(const PathLights& lights, const PointBlock& points, const LobeBlock& lobes,
                  PathBlock& block) {
    forEachRow(points, lobes, block,
               [&](unsigned lanes, std::size_t first, const SeenPoints& at,
                   const ShadingFrame& frame, Bsdf& bsdf) {
                   bsdf.choose();
                   if ((lobes.flags & kAnswersLights) != 0 && !lights.isEmpty())
                       sendLight(lights, at, frame, bsdf, (lobes.flags & kTransmits) != 0, lanes,
                                 first, block);
                   if ((lobes.flags & kSpawnsRays) == 0) return;
                   const PathNumbers& u = block.numbers;
                   sendRay(at, frame,
                           bsdf.sample(Floats::load(u.choice.v + first),
                                       Floats::load(u.direction.u + first),
                                       Floats::load(u.direction.v + first)),
                           lanes, first, block);
               });
}

LANES_END
