// Sheen: fibres that stand on a cloth.
#pragma once

#include "material/lobe.h"

LANES_BEGIN

struct Sheen {
    static constexpr const char* kName = "sheen";
    static constexpr std::array<LobeField, 1> kFields{{{"roughness", 1, {0.5f}, 0, 1}}};
    static constexpr std::uint32_t kFlags = kReflects | kAnswersLights | kSpawnsRays | kDiffuse;

    explicit Sheen(const LobeNumbers&) {}
    Floats3 below(const Floats3&) const { return rgbOf(0.0f); }
    Floats3 albedo(const Floats3&) const { return rgbOf(1.0f); }
    Floats3 eval(const Floats3&, const Floats3&) const { return rgbOf(0.0f); }
    Floats pdf(const Floats3&, const Floats3&) const { return Floats(0.0f); }
    LobeSample sample(const Floats3& toEye, Floats, Floats, Floats) const {
        return {toEye, rgbOf(0.0f), Floats(0.0f), maskOf(0)};
    }
};

LANES_END
