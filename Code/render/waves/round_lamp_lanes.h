// The formulas of PointLight::sample(): a lamp whose light comes from a disk that faces each point.
#pragma once

#include "light/light.h"
#include "render/waves/cone_lanes.h"
#include "render/waves/disk_lanes.h"
#include "render/waves/flat_lamp_lanes.h"
#include "render/waves/frame_lanes.h"
#include "render/waves/lamp_lanes.h"
#include "render/waves/spot_cone.h"
#include "render/waves/three_lanes.h"
#include "simd/lanes.h"

#include <cstddef>

LANES_BEGIN

// PointLight::cannotReach()
inline unsigned behindHorizon(const PointEmission& lamp, const Three& n, const Three& d,
                              Floats distance2) {
    const Floats zero(0.0f), behind = (zero - dot(n, d)) - Floats(lamp.radius);
    return bits((behind > zero) & (behind * behind > Floats(sqr(kHorizonSlack)) * distance2));
}

class RoundLamp {
public:
    static constexpr bool kHasPlaces = true;
    RoundLamp(const PointEmission& lamp, const LitBlock& block, std::size_t first)
        : toCentre_(Three::all(lamp.position.x, lamp.position.y, lamp.position.z) -
                    Three::load(block.p, first)),
          radius_(lamp.radius), constant_(lamp.attenuation.constant),
          linear_(lamp.attenuation.linear), quadratic_(lamp.attenuation.quadratic),
          intensity_(Three::all(lamp.intensity.r, lamp.intensity.g, lamp.intensity.b)),
          cone_(lamp.cone ? &*lamp.cone : nullptr) {
        const Floats distance2 = dot(toCentre_, toCentre_);
        seen_ = ~behindHorizon(lamp, Three::load(block.n, first), toCentre_, distance2) &
                bits(distance2 > Floats(0.0f));
        disk_ = framesAround(toCentre_ / sqrt(distance2));
    }

    unsigned seen() const { return seen_; }
    static void place(SquareRow& row, unsigned& unsure) { placeOnDisk(row, unsure); }
    static void placeSurely(SquareRow& row, unsigned lanes) { placeSurelyOnDisk(row, lanes); }

    void findWay(LampRow& row) const {
        const Floats x = Floats::load(row.x) * radius_, y = Floats::load(row.y) * radius_;
        const Three d = toCentre_ + disk_.x * x + disk_.y * y;
        row.distance2 = dot(d, d), row.distance = sqrt(row.distance2);
        row.toLight = d / row.distance;
    }

    Three irradiance(const LampRow& row) const {
        Floats shown = dot(row.toLight, disk_.z); // the cosine at the disk
        if (cone_) shown = coneAt(*cone_, row.toLight) * shown;
        const Floats faded = quadratic_ * row.distance2 + linear_ * row.distance + constant_;
        return intensity_ * (shown / faded);
    }

private:
    Three toCentre_;
    Frames<Three> disk_; // z is towards the lamp
    Floats radius_, constant_, linear_, quadratic_;
    Three intensity_;
    const SpotCone* cone_;
    unsigned seen_;
};

inline RoundLamp lookAt(const PointEmission& lamp, const LitBlock& block, std::size_t first) {
    return {lamp, block, first};
}

LANES_END
