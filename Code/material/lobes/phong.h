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
    // The sum of the whole lobe, times the part of it that is in front of the surface, as a fit,
    // right to 10 % from exponent 3 on; all of the light where there is more.
    Floats3 albedo(const Floats3& toEye) const {
        const Floats one(1.0f), half(0.5f), z2 = toEye.z * toEye.z, narrow = exponent_ + one;
        const Floats off = toEye.z / sqrt(z2 + Floats(static_cast<float>(kHalfPi)) / narrow);
        const Floats sum = Floats(static_cast<float>(2 * kPi)) / narrow;
        return rgbOf(min(sum * (half + half * off), one));
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
