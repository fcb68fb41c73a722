// The formulas of PointLight::shine() and rayFromLamp(), as in lit_lanes.h.
#pragma once

#include "light/light.h"
#include "render/waves/lamp_lanes.h"
#include "render/waves/lit_lanes.h"
#include "render/waves/spot_cone.h"
#include "render/waves/three_lanes.h"
#include "simd/lanes.h"

#include <cstddef>

LANES_BEGIN

// The W points of a block from `first` on.
class PointLampLanes {
public:
    PointLampLanes(const PointEmission& lamp, const LitBlock& block, std::size_t first)
        : lamp_(lamp), block_(block), lit_(block, {first}), first_(first),
          at_(Three::all(lamp.position.x, lamp.position.y, lamp.position.z)),
          p_(Three::load(block.p, first)), n_(Three::load(block.n, first)) {}

    // Returns the lanes that are lit.
    unsigned light(LitByLamp& out) {
        unsigned lanes = lanesOf(block_.used);
        const Floats zero(0.0f), one(1.0f);
        const Three d = at_ - p_;
        const Floats distance2 = dot(d, d);
        const Floats behind = (zero - dot(n_, d)) - Floats(lamp_.radius);
        const Mask unseen =
            (behind > zero) & (behind * behind > Floats(sqr(kHorizonSlack)) * distance2);
        lanes &= ~bits(unseen) & bits(distance2 > zero);
        if (lanes == 0) return 0;
        const Floats distance = sqrt(distance2);
        const Three toLight = d / distance;
        const Attenuation& fade = lamp_.attenuation;
        const Floats faded = Floats(fade.quadratic) * distance2 + Floats(fade.linear) * distance +
                             Floats(fade.constant);
        const Three irradiance =
            Three::all(lamp_.intensity.r, lamp_.intensity.g, lamp_.intensity.b) *
            ((lamp_.cone ? coneAt(*lamp_.cone, toLight) : one) / faded);
        lanes &= ~black(irradiance);

        lanes &= lit_.rises(toLight);
        if (lanes == 0) return 0;

        const Three reflected = lit_.reflected(n_, toLight, lanes);
        const Three light = Three::load(block_.weight, first_) * reflected * irradiance;
        light.x.store(out.light[0] + first_);
        light.y.store(out.light[1] + first_);
        light.z.store(out.light[2] + first_);
        return lanes & ~black(light);
    }

    void rays(LitByLamp& out) const {
        const Three lift = Three::load(block_.lift, first_), ng = Three::load(block_.ng, first_);
        const auto way = [](Floats p, Floats up, float lamp) {
            return (Doubles(p) + Doubles(up)) - Doubles(static_cast<double>(lamp));
        };
        const Doubles x = way(p_.x, lift.x, lamp_.position.x),
                      y = way(p_.y, lift.y, lamp_.position.y),
                      z = way(p_.z, lift.z, lamp_.position.z);
        const Doubles nx(ng.x), ny(ng.y), nz(ng.z), zero(0.0);
        const Doubles reach = sqrt((x * x + y * y) + z * z);
        const Doubles error(Floats::load(block_.error + first_));
        const Doubles alongX = nx * x, alongY = ny * y, alongZ = nz * z;
        const Doubles rounding = Doubles(0x1p-24) * ((abs(alongX) + abs(alongY)) + abs(alongZ));
        const Doubles lost = rounding + Doubles(Floats::load(block_.rayError + first_)) * reach;
        const Doubles risen = (zero - ((alongX + alongY) + alongZ)) / reach * error;
        const Doubles step = max((error + lost) - risen, zero);
        const Mask fits = maskOf(less(error, reach));
        const auto dir = [&](const Doubles& w, const Doubles& n, float* to) {
            select(fits, (w + n * step).toFloats(), w.toFloats()).store(to + first_);
        };
        dir(x, nx, out.dir[0]);
        dir(y, ny, out.dir[1]);
        dir(z, nz, out.dir[2]);
        // floatBelow(): what is rounded up is 2^-54 at least, and such a float times 1 - 2^-24 is
        // the one below it.
        const Doubles end = Doubles(1.0) - error / reach;
        const Floats nearest = end.toFloats();
        const Mask above = maskOf(less(end, Doubles(nearest)));
        const Floats below = select(above, nearest * Floats(1 - 0x1p-24f), nearest);
        select(fits, below, Floats(0.0f)).store(out.tMax + first_);
    }

    unsigned lanesOf(unsigned points) const { return lit_.lanesOf(points); }

private:
    const PointEmission& lamp_;
    const LitBlock& block_;
    LitLanes<PointsInRow> lit_;
    std::size_t first_;
    Three at_, p_, n_;
};

void lightByLamp(const PointEmission& lamp, const LitBlock& block, unsigned withRays,
                 LitByLamp& out) {
    out.lit = 0;
    for (std::size_t first = 0; first < LitBlock::kPoints; first += W) {
        PointLampLanes lanes(lamp, block, first);
        const unsigned lit = lanes.light(out);
        if ((lit & lanes.lanesOf(withRays)) != 0) lanes.rays(out);
        out.lit |= lit << first;
    }
}

LANES_END
