// Blinn: an unnormalised highlight about the half vector, (n.h)^exponent, without a cosine.
#pragma once

#include "material/highlight.h"

LANES_BEGIN

struct Blinn {
    static constexpr const char* kName = "blinn";
    static constexpr std::array<LobeField, 1> kFields{{{"exponent", 1, {50}, 0, 1e9f}}};
    static constexpr std::uint32_t kFlags = kReflects | kAnswersLights;

    explicit Blinn(const LobeNumbers& n) : exponent_(n[0]) {}
    Floats3 below(const Floats3& toEye) const { return restOf(albedo(toEye)); }
    // The sum at normal incidence times the mean cosine of the half vectors to the eye, as a fit,
    // right to 10 %; all of the light where there is more.
    Floats3 albedo(const Floats3& toEye) const {
        const Floats wide2 = Floats(1.0f) / (exponent_ + Floats(2.0f));
        const Floats spread2 = (Floats(0.2f) + Floats(0.5f) * wide2) * wide2;
        const Floats cosine = sqrt(toEye.z * toEye.z + spread2);
        return rgbOf(min(halfVectorSum(exponent_) * cosine, Floats(1.0f)));
    }
    Floats3 eval(const Floats3& toEye, const Floats3& toLight) const {
        return rgbOf(HalfVector(toEye, toLight).power(exponent_));
    }

private:
    Floats exponent_;
};

LANES_END
