// The formulas of SphereLight::sample(). Points inside of the lamp ask it one by one.
#pragma once

#include "base/math.h"
#include "base/vec.h"
#include "light/area_light.h"
#include "light/light.h"
#include "render/waves/cone_lanes.h"
#include "render/waves/disk_lanes.h"
#include "render/waves/flat_lamp_lanes.h"
#include "render/waves/frame_lanes.h"
#include "render/waves/lamp_lanes.h"
#include "render/waves/round_lamp_lanes.h"
#include "render/waves/three_lanes.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>

LANES_BEGIN

class SphereLamp {
public:
    static constexpr bool kHasPlaces = true;
    SphereLamp(const SphereEmission& lamp, const LitBlock& block, std::size_t first)
        : lamp_(lamp), p_(Three::load(block.p, first)),
          radiance_(Three::all(lamp.radiance.r, lamp.radiance.g, lamp.radiance.b)),
          x_(way(lamp.centre.x, p_.x)), y_(way(lamp.centre.y, p_.y)), z_(way(lamp.centre.z, p_.z)),
          r2_(sqr(static_cast<double>(lamp.radius))), d2_((x_ * x_ + y_ * y_) + z_ * z_) {
        constexpr unsigned kAll = (1u << W) - 1;
        inside_ = ~less(r2_, d2_) & kAll;
        const Doubles one(1.0), sin2 = r2_ / d2_, distance = sqrt(d2_);
        const Doubles oneMinusCos = sin2 / (one + sqrt(one - sin2));
        unfit_ = inside_ | (~less(Doubles(kNarrowestCone), oneMinusCos) & kAll);
        oneMinusCos.store(oneMinusCos_);
        frame_ = framesAround(Three{(x_ / distance).toFloats(), (y_ / distance).toFloats(),
                                    (z_ / distance).toFloats()});
        irradiance_ = radiance_ * (Doubles(kTwoPi) * oneMinusCos).toFloats();
        const Vec3 c = lamp.centre;
        const Three d = Three::all(c.x, c.y, c.z) - p_;
        const Floats slack =
            Floats(kHorizonSlack) * (max(max(abs(d.x), abs(d.y)), abs(d.z)) + Floats(lamp.radius));
        seen_ =
            ~bits(dot(Three::load(block.n, first), d) + Floats(lamp.radius) < Floats(0.0f) - slack);
    }

    unsigned seen() const { return seen_; }

    void place(SquareRow& row, unsigned& unsure) const {
        placeOnCone(row, Doubles::load(oneMinusCos_), unsure);
        unsure |= unfit_;
    }
    void placeSurely(SquareRow& row, unsigned lanes) const {
        placeSurelyOnCone(row, oneMinusCos_, lanes & ~inside_);
    }

    void findWay(LampRow& row) const {
        const Three way = frame_.toWorld(Floats::load(row.x), Floats::load(row.y),
                                         zOnCone(row, Doubles::load(oneMinusCos_)));
        row.toLight = way / sqrt(dot(way, way));
        const Doubles along = (Doubles(row.toLight.x) * x_ + Doubles(row.toLight.y) * y_) +
                              Doubles(row.toLight.z) * z_;
        row.distance = (along - sqrt(max(along * along - d2_ + r2_, Doubles(0.0)))).toFloats();
        if (inside_ != 0) findWayInside(row);
    }

    Three irradiance(const LampRow&) const {
        if (inside_ == 0) return irradiance_;
        return select(maskOf(inside_), radiance_ * Floats(static_cast<float>(4 * kPi)),
                      irradiance_);
    }

private:
    static Doubles way(float centre, Floats p) {
        return Doubles(static_cast<double>(centre)) - Doubles(p);
    }

    [[gnu::noinline]] void findWayInside(LampRow& row) const {
        const SphereLight lamp(lamp_.centre, lamp_.radius, lamp_.radiance, false);
        alignas(64) float p[3][W], way[3][W], distance[W];
        p_.x.store(p[0]), p_.y.store(p[1]), p_.z.store(p[2]);
        row.toLight.x.store(way[0]), row.toLight.y.store(way[1]), row.toLight.z.store(way[2]);
        row.distance.store(distance);
        for (unsigned lanes = inside_; lanes != 0; lanes &= lanes - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
            const LightSample at = lamp.sample({p[0][i], p[1][i], p[2][i]}, {row.u[i], row.v[i]});
            way[0][i] = at.toLight.x, way[1][i] = at.toLight.y, way[2][i] = at.toLight.z;
            distance[i] = at.distance;
        }
        row.toLight = {Floats::load(way[0]), Floats::load(way[1]), Floats::load(way[2])};
        row.distance = Floats::load(distance);
    }

    const SphereEmission& lamp_;
    Three p_, radiance_, irradiance_;
    Doubles x_, y_, z_, r2_, d2_;       // to the centre; squares of the radius and of this way
    alignas(64) double oneMinusCos_[W]; // of the cone that the lamp fills
    Frames<Three> frame_;
    unsigned seen_, inside_, unfit_;
};

inline SphereLamp lookAt(const SphereEmission& lamp, const LitBlock& block, std::size_t first) {
    return {lamp, block, first};
}

LANES_END
