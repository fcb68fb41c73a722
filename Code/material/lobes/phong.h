// Phong: an unnormalised highlight about the mirrored direction, (r.v)^exponent, without a cosine.
#pragma once

#include "material/highlight.h"

LANES_BEGIN

struct Phong {
    static constexpr const char* kName = "phong";
    static constexpr std::array<LobeField, 1> kFields{{{"exponent", 1, {50}, 0, 1e9f}}};
    static constexpr std::uint32_t kFlags = kReflects | kAnswersLights;

    explicit Phong(const LobeNumbers& n) : exponent_(n[0]) {}
    Floats3 below(const Floats3& toEye) const { return restOf(albedo(toEye)); }
    Floats3 albedo(const Floats3&) const {
        const Floats one(1.0f);
        return rgbOf(min(Floats(static_cast<float>(2 * kPi)) / (exponent_ + one), one));
    }
    Floats3 eval(const Floats3& toEye, const Floats3& toLight) const {
        const Floats zero(0.0f), one(1.0f), twice = toLight.z * toEye.z;
        // r.v with r = 2 (n.l) n - l, in a form that eye and light enter alike
        const Floats cosMirror = min((twice + twice) - dot(toLight, toEye), one);
        const Mask is = (toLight.z > zero) & (cosMirror > zero);
        return rgbOf(powerWhere(is, cosMirror, exponent_));
    }

private:
    Floats exponent_;
};

LANES_END
