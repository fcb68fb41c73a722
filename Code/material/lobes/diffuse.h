// Diffuse: Lambert's law, radiance that is the same in all directions.
#pragma once

#include "material/lobe.h"

LANES_BEGIN

struct Diffuse {
    static constexpr const char* kName = "diffuse";
    static constexpr std::array<LobeField, 0> kFields{};
    static constexpr std::uint32_t kFlags = kReflects | kAnswersLights | kSpawnsRays | kDiffuse;

    explicit Diffuse(const LobeNumbers&) {}
    Floats3 below(const Floats3&) const { return rgbOf(0.0f); }
    Floats3 albedo(const Floats3&) const { return rgbOf(1.0f); }
    Floats3 eval(const Floats3&, const Floats3& toLight) const {
        return rgbOf(max(toLight.z, Floats(0.0f)) * Floats(static_cast<float>(kInvPi)));
    }
    Floats pdf(const Floats3&, const Floats3& toLight) const {
        return max(toLight.z, Floats(0.0f)) * Floats(static_cast<float>(kInvPi));
    }
    LobeSample sample(const Floats3& toEye, Floats, Floats u, Floats v) const {
        const Floats3 toLight = cosineHemisphereFromSquare(u, v);
        return {toLight, rgbOf(1.0f), pdf(toEye, toLight), maskOf(0)};
    }
};

LANES_END
