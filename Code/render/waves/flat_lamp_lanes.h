// The formulas of FlatLight::sample().
#pragma once

#include "base/vec.h"
#include "light/light.h"
#include "render/waves/cone_lanes.h"
#include "render/waves/disk_lanes.h"
#include "render/waves/lamp_lanes.h"
#include "render/waves/three_lanes.h"
#include "simd/lanes.h"

#include <cstddef>

LANES_BEGIN

class FlatLamp {
public:
    static constexpr bool kHasPlaces = true;
    FlatLamp(const FlatEmission& lamp, const LitBlock& block, std::size_t first)
        : lamp_(lamp), p_(Three::load(block.p, first)), seen_(~cannotReach(block, first)) {}

    unsigned seen() const { return seen_; }

    void place(SquareRow& row, unsigned& unsure) const {
        if (lamp_.isEllipse) return placeOnDisk(row, unsure);
        const Floats two(2.0f), one(1.0f);
        (two * Floats::load(row.u) - one).store(row.x);
        (two * Floats::load(row.v) - one).store(row.y);
    }
    static void placeSurely(SquareRow& row, unsigned lanes) { placeSurelyOnDisk(row, lanes); }

    void findWay(LampRow& row) const {
        const Three d = all(lamp_.centre) + all(lamp_.halfX) * Floats::load(row.x) +
                        all(lamp_.halfY) * Floats::load(row.y) - p_;
        row.distance2 = dot(d, d), row.distance = sqrt(row.distance2);
        row.toLight = d / row.distance;
    }

    Three irradiance(const LampRow& row) const {
        const Floats zero(0.0f), one(1.0f);
        const Floats cosAtLight = flipSign(dot(row.toLight, all(lamp_.normal)), Floats(-0.0f));
        Floats shown = cosAtLight;
        if (lamp_.spreads) {
            const Floats tangent = sqrt(max(one - cosAtLight * cosAtLight, zero)) / cosAtLight;
            shown = max((Floats(lamp_.tanSpread) - tangent) * Floats(lamp_.spreadNorm), zero) *
                    cosAtLight;
        }
        const Three light =
            Three::all(lamp_.power.r, lamp_.power.g, lamp_.power.b) * (shown / row.distance2);
        return select((cosAtLight > zero) & (row.distance2 > zero), light, Three::all(0, 0, 0));
    }

private:
    static Three all(Vec3 v) { return Three::all(v.x, v.y, v.z); }

    unsigned cannotReach(const LitBlock& block, std::size_t first) const {
        const Three n = Three::load(block.n, first), d = all(lamp_.centre) - p_;
        const Floats most = max(max(abs(p_.x), abs(p_.y)), abs(p_.z));
        const Floats slack =
            Floats(kHorizonSlack) * (most + Floats(maxAbs(lamp_.centre)) +
                                     Floats(maxAbs(lamp_.halfX)) + Floats(maxAbs(lamp_.halfY)));
        const Floats highest =
            dot(n, d) + abs(dot(n, all(lamp_.halfX))) + abs(dot(n, all(lamp_.halfY)));
        return bits(highest < Floats(0.0f) - slack) | bits(dot(all(lamp_.normal), d) > slack);
    }

    const FlatEmission& lamp_;
    Three p_;
    unsigned seen_;
};

inline FlatLamp lookAt(const FlatEmission& lamp, const LitBlock& block, std::size_t first) {
    return {lamp, block, first};
}

LANES_END
