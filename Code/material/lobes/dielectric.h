// Dielectric: glass, smooth or rough.
#pragma once

#include "material/lobe.h"

LANES_BEGIN

struct Dielectric {
    static constexpr const char* kName = "dielectric";
    static constexpr std::array<LobeField, 5> kFields{{{"ior", 1, {1.5f}, 0.001f, 1000},
                                                       {"reflect_tint", 3, {1, 1, 1}, 0, 1},
                                                       {"transmit_tint", 3, {1, 1, 1}, 0, 1},
                                                       {"roughness", 1, {0}, 0, 1},
                                                       {"anisotropy", 1, {0}, -1, 1}}};
    static constexpr std::uint32_t kFlags =
        kReflects | kTransmits | kAnswersLights | kSpawnsRays | kHasSides | kHasTangent;

    explicit Dielectric(const LobeNumbers&) {}
    Floats3 below(const Floats3&) const { return rgbOf(0.0f); }
    Floats3 albedo(const Floats3&) const { return rgbOf(1.0f); }
    Floats3 eval(const Floats3&, const Floats3&) const { return rgbOf(0.0f); }
    Floats pdf(const Floats3&, const Floats3&) const { return Floats(0.0f); }
    LobeSample sample(const Floats3& toEye, Floats, Floats, Floats) const {
        return {toEye, rgbOf(0.0f), Floats(0.0f), maskOf(0)};
    }
    LobeSample branch(const Floats3& toEye, bool, Floats, Floats) const {
        return {toEye, rgbOf(0.0f), Floats(0.0f), maskOf(0)};
    }
};

LANES_END
