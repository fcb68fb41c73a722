// Ashikhmin: (n+1)/(8 pi) (n.h)^n / ((h.v) max(n.l, n.v)) n.l, a highlight about the half vector
// that never sends on more light than it gets.
#pragma once

#include "material/highlight.h"

#include <limits>

LANES_BEGIN

struct Ashikhmin {
    static constexpr const char* kName = "ashikhmin";
    static constexpr std::array<LobeField, 1> kFields{{{"exponent", 1, {50}, 0, 1e9f}}};
    static constexpr std::uint32_t kFlags = kReflects | kAnswersLights | kSpawnsRays;

    // As wide as facets of alpha are exponents of 2 / alpha^2 - 2.
    explicit Ashikhmin(const LobeNumbers& n)
        : exponent_(min(n[0], Floats(2.0f) / max(n.leastAlpha * n.leastAlpha, Floats(1e-12f)) -
                                  Floats(2.0f))) {}
    Floats3 below(const Floats3& toEye) const { return restOf(albedo(toEye)); }
    // The integral at normal incidence, which falls to 1/2 at the horizon, as a fit, right to 10 %
    // from exponent 3 on.
    Floats3 albedo(const Floats3& toEye) const {
        const Floats zero(0.0f), half(0.5f), one(1.0f), two(2.0f), z = max(toEye.z, zero);
        const Floats first = exponent_ + one, third = exponent_ + Floats(3.0f);
        const Floats q = powOf(half, first * half, (1u << W) - 1); // sqrt(1/2)^(n + 1)
        const Floats sum = two * first / third * (one - q * half) - (one - q);
        const Floats sine = sqrt(max((one - z) * (one + z), zero)), tall = z * sqrt(first);
        // 1 / (1 + 1.6 / x + 1.5 / x^2) with x = tall / sine
        const Floats fall = tall * tall /
                            max(tall * tall + sine * (Floats(1.6f) * tall + Floats(1.5f) * sine),
                                Floats(std::numeric_limits<float>::min()));
        return rgbOf(half + (sum - half) * fall);
    }
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
