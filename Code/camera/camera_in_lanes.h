// Rays of a camera through places of the picture; Camera::ray() is the one lane of it.
#pragma once

#include "base/vec.h"
#include "camera/camera_lanes.h"
#include "sample/filter_in_lanes.h"
#include "sample/pairs_in_lanes.h"
#include "sample/warps.h"
#include "simd/lanes.h"
#include "simd/vectors3.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

LANES_BEGIN

struct CameraAxes {
    Doubles3 right, up, forward, eye;
};
inline CameraAxes forAll(const Camera::Axes& axes) {
    return {forAll(axes.right), forAll(axes.up), forAll(axes.forward), forAll(axes.eye)};
}
// Returns the axes at each of some times; lanes behind the last have those of the last.
inline CameraAxes axesAt(const Camera& camera, std::span<const float> time) {
    alignas(64) double number[12][W];
    for (std::size_t i = 0; i < W; ++i) {
        const Camera::Axes axes = camera.axesAt(time[std::min(i, time.size() - 1)]);
        std::size_t row = 0;
        for (const Vec3d& v : {axes.right, axes.up, axes.forward, axes.eye})
            for (std::size_t c = 0; c < 3; ++c) number[row++][i] = v[c];
    }
    const auto vector = [&](std::size_t row) {
        return Doubles3{Doubles::load(number[row]), Doubles::load(number[row + 1]),
                        Doubles::load(number[row + 2])};
    };
    return {vector(0), vector(3), vector(6), vector(9)};
}

// Lines of any length through the middle of the lens.
struct CameraLines {
    Doubles3 org, dir;
};
inline CameraLines linesThrough(const Camera::Optics& optics, const CameraAxes& axes,
                                const Doubles& x, const Doubles& y) {
    const Doubles3 across = axes.right * (Doubles(optics.topLeft.x) + x * Doubles(optics.step.x)) +
                            axes.up * (Doubles(optics.topLeft.y) - y * Doubles(optics.step.y));
    if (optics.isPerspective) return {axes.eye, across + axes.forward};
    return {axes.eye + across, axes.forward};
}

struct CameraRayLanes {
    Floats3 org, dir;
    Floats tMin;
};
// x, y: pixels from the left and the top edge; u, v: the place on the lens, in the unit square.
inline CameraRayLanes raysThrough(const Camera::Optics& optics, const CameraAxes& axes,
                                  const Doubles& x, const Doubles& y, Floats u, Floats v) {
    CameraLines line = linesThrough(optics, axes, x, y);
    if (optics.hasLens) {
        // The depth of a direction is 1 unless the camera's axes are skewed.
        const Doubles3 sharp =
            line.org + line.dir * (Doubles(optics.focusDistance) / dot(line.dir, axes.forward));
        const Floats2 place = optics.blades != 0
                                  ? polygonFromSquare(optics.corners, optics.blades, u, v)
                                  : diskFromSquare(u, v);
        const Doubles3 onLens = axes.right * (Doubles(place.x) / Doubles(optics.apertureRatio)) +
                                axes.up * Doubles(place.y);
        line.org = line.org + onLens * Doubles(optics.apertureRadius);
        // From the rounded origin, so that all rays of a pixel meet in the sharp plane.
        const Floats3 org = Floats3::of(line.org);
        line.dir = sharp - Doubles3::of(org.x, org.y, org.z);
    }
    const Doubles3 unit = line.dir / sqrt(dot(line.dir, line.dir));
    return {Floats3::of(line.org), Floats3::of(unit),
            (Doubles(optics.clipStart) / dot(unit, axes.forward)).toFloats()};
}

// Stores W rays from the first ones on, or as many as there is room for.
inline void store(const CameraRayLanes& rays, const RaySpans& to, std::size_t first) {
    const auto storeAt = [&](Vec3* org, Vec3* dir, float* tMin) {
        constexpr unsigned kAll = (1u << W) - 1;
        storeChosenVectors(kAll, rays.org.x, rays.org.y, rays.org.z, &org->x);
        storeChosenVectors(kAll, rays.dir.x, rays.dir.y, rays.dir.z, &dir->x);
        storeChosenFloats(kAll, rays.tMin, tMin);
    };
    const std::size_t count = std::min<std::size_t>(W, to.dir.size() - first);
    if (count == W) return storeAt(&to.org[first], &to.dir[first], &to.tMin[first]);
    std::array<Vec3, W> org, dir;
    std::array<float, W> tMin;
    storeAt(org.data(), dir.data(), tMin.data());
    std::copy_n(org.data(), count, &to.org[first]);
    std::copy_n(dir.data(), count, &to.dir[first]);
    std::copy_n(tMin.data(), count, &to.tMin[first]);
}

inline void cameraRays(const Camera& camera, const PlaceBlock& places, const RaySpans& to) {
    const Camera::Optics optics = camera.optics();
    CameraAxes axes = forAll(camera.axesAt(0));
    for (std::size_t first = 0; first < to.dir.size(); first += W) {
        if (camera.isMoving()) axes = axesAt(camera, to.time.subspan(first));
        const Doubles x = Doubles::load(places.x + first), y = Doubles::load(places.y + first);
        const Floats u = Floats::load(places.u + first), v = Floats::load(places.v + first);
        store(raysThrough(optics, axes, x, y, u, v), to, first);
    }
}

inline void spreadPlaces(const Filter::Spread& filter, const PairBlock& pairs, PlaceBlock& places) {
    const auto move = [&](const float* u, double* to) {
        for (std::size_t i = 0; i < PairBlock::kPairs; i += W)
            (Doubles::load(to + i) + Doubles(offsetOf(filter, Floats::load(u + i)))).store(to + i);
    };
    move(pairs.u, places.x), move(pairs.v, places.y);
}

inline constexpr CameraLanes kCamera{pairSeeds,   zPairSeeds,   sobolPairs,
                                     zSobolPairs, spreadPlaces, cameraRays};

LANES_END
