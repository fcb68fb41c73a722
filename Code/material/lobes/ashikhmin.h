// Ashikhmin: (n+1)/(8 pi) (n.h)^n / ((h.v) max(n.l, n.v)) n.l, a highlight about the half vector
// that never sends on more light than it gets.
#pragma once

#include "material/highlight.h"

LANES_BEGIN

struct Ashikhmin {
    static constexpr const char* kName = "ashikhmin";
    static constexpr std::array<LobeField, 1> kFields{{{"exponent", 1, {50}, 0, 1e9f}}};
    static constexpr std::uint32_t kFlags = kReflects | kAnswersLights | kSpawnsRays;

    explicit Ashikhmin(const LobeNumbers& n) : exponent_(n[0]) {}
    Floats3 below(const Floats3& toEye) const { return restOf(albedo(toEye)); }
    // At normal incidence; near the horizon less.
    Floats3 albedo(const Floats3&) const { return rgbOf(Floats(1.0f)); }
    Floats3 eval(const Floats3& toEye, const Floats3& toLight) const {
        const Floats zero(0.0f);
        const Floats z = max(toLight.z, zero);
        return rgbOf(pdf(toEye, toLight) * ratio(toEye, z));
    }
    Floats pdf(const Floats3& toEye, const Floats3& toLight) const {
        const HalfVector half(toEye, toLight);
        return (exponent_ + Floats(1.0f)) * Floats(static_cast<float>(kInvPi / 8)) *
               half.power(exponent_) / half.cosEye;
    }
    LobeSample sample(const Floats3& toEye, Floats, Floats u, Floats v) const {
        const Floats3 h = cosinePowerFromSquare(u, v, exponent_);
        const Floats cosIn = dot(h, toEye), zero(0.0f);
        const Floats3 toLight = normalize(mirroredBy(h, toEye, cosIn));
        const Mask is = (cosIn > zero) & (toLight.z > zero);
        const Floats density = select(is, pdf(toEye, toLight), zero);
        return {toLight, rgbOf(select(density > zero, ratio(toEye, toLight.z), zero)), density,
                maskOf(0)};
    }

private:
    static Floats ratio(const Floats3& toEye, Floats z) {
        return z / max(max(z, toEye.z), Floats(std::numeric_limits<float>::min()));
    }

    Floats exponent_;
};

LANES_END
