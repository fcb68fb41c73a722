// The formulas of SunLight::sample() and centre().
#pragma once

#include "base/math.h"
#include "base/vec.h"
#include "light/light.h"
#include "render/waves/cone_lanes.h"
#include "render/waves/disk_lanes.h"
#include "render/waves/flat_lamp_lanes.h"
#include "render/waves/frame_lanes.h"
#include "render/waves/lamp_lanes.h"
#include "render/waves/round_lamp_lanes.h"
#include "render/waves/sphere_lamp_lanes.h"
#include "render/waves/three_lanes.h"
#include "sample/warp.h"
#include "simd/lanes.h"

#include <algorithm>
#include <cstddef>

LANES_BEGIN

// By those whose horizon it is not behind.
inline unsigned sunSeen(const LitBlock& block, std::size_t first, const Three& toSun, float sine) {
    return ~bits(dot(Three::load(block.n, first), toSun) < Floats(-(sine + kHorizonSlack)));
}

class SunInLanes {
public:
    static constexpr bool kHasPlaces = true;
    SunInLanes(const SunEmission& sun, const LitBlock& block, std::size_t first)
        : oneMinusCos_(sun.oneMinusCos) {
        const auto all = [](Vec3 v) { return Three::all(v.x, v.y, v.z); };
        const Frame frame = frameAround(sun.toSun);
        frame_ = {all(frame.x), all(frame.y), all(frame.z)};
        const Rgb light = sun.ofSample();
        irradiance_ = Three::all(light.r, light.g, light.b);
        seen_ = sunSeen(block, first, frame_.z, sun.sinHalfAngle);
    }

    unsigned seen() const { return seen_; }

    void place(SquareRow& row, unsigned& unsure) const {
        placeOnCone(row, Doubles(oneMinusCos_), unsure);
    }
    void placeSurely(SquareRow& row, unsigned lanes) const {
        alignas(64) double all[W];
        std::fill_n(all, W, oneMinusCos_);
        placeSurelyOnCone(row, all, lanes);
    }

    void findWay(LampRow& row) const {
        const Three way = frame_.toWorld(Floats::load(row.x), Floats::load(row.y),
                                         zOnCone(row, Doubles(oneMinusCos_)));
        row.toLight = way / sqrt(dot(way, way));
        row.distance = Floats(kInfinityF);
    }

    Three irradiance(const LampRow&) const { return irradiance_; }

private:
    double oneMinusCos_;
    Frames<Three> frame_;
    Three irradiance_;
    unsigned seen_;
};

inline SunInLanes lookAt(const SunEmission& sun, const LitBlock& block, std::size_t first) {
    return {sun, block, first};
}

// Without places: there is one.
class ParallelLight {
public:
    static constexpr bool kHasPlaces = false;
    ParallelLight(const ParallelEmission& sun, const LitBlock& block, std::size_t first)
        : toSun_(Three::all(sun.toSun.x, sun.toSun.y, sun.toSun.z)),
          irradiance_(Three::all(sun.irradiance.r, sun.irradiance.g, sun.irradiance.b)),
          seen_(sunSeen(block, first, toSun_, sun.sinHalfAngle)) {}

    unsigned seen() const { return seen_; }
    void findWay(LampRow& row) const { row.toLight = toSun_, row.distance = Floats(kInfinityF); }
    Three irradiance(const LampRow&) const { return irradiance_; }

private:
    Three toSun_, irradiance_;
    unsigned seen_;
};

inline ParallelLight lookAt(const ParallelEmission& sun, const LitBlock& block, std::size_t first) {
    return {sun, block, first};
}

LANES_END
