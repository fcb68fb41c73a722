// GlossyDielectric: what a dielectric reflects, over something opaque.
#pragma once

#include "material/lobe.h"

LANES_BEGIN

struct GlossyDielectric {
    static constexpr const char* kName = "glossy_dielectric";
    static constexpr std::array<LobeField, 6> kFields{{{"ior", 1, {1.5f}, 1, 1000},
                                                       {"tint", 3, {1, 1, 1}, 0, 1},
                                                       {"roughness", 1, {0.5f}, 0, 1},
                                                       {"anisotropy", 1, {0}, -1, 1},
                                                       {"rotation", 1, {0}, -1e6f, 1e6f},
                                                       {"specular", 1, {0.5f}, 0, 1}}};
    static constexpr std::uint32_t kFlags = kReflects | kAnswersLights | kSpawnsRays | kHasTangent;

    explicit GlossyDielectric(const LobeNumbers&) {}
    Floats3 below(const Floats3&) const { return rgbOf(0.0f); }
    Floats3 albedo(const Floats3&) const { return rgbOf(1.0f); }
    Floats3 eval(const Floats3&, const Floats3&) const { return rgbOf(0.0f); }
    Floats pdf(const Floats3&, const Floats3&) const { return Floats(0.0f); }
    LobeSample sample(const Floats3& toEye, Floats, Floats, Floats) const {
        return {toEye, rgbOf(0.0f), Floats(0.0f), maskOf(0)};
    }
};

LANES_END
