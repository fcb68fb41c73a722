// Phong: a highlight about the mirrored direction.
#pragma once

#include "material/lobe.h"

LANES_BEGIN

struct Phong {
    static constexpr const char* kName = "phong";
    static constexpr std::array<LobeField, 1> kFields{{{"exponent", 1, {50}, 0, 1e9f}}};
    static constexpr std::uint32_t kFlags = kReflects | kAnswersLights;

    explicit Phong(const LobeNumbers&) {}
    Floats3 below(const Floats3&) const { return rgbOf(0.0f); }
    Floats3 albedo(const Floats3&) const { return rgbOf(1.0f); }
    Floats3 eval(const Floats3&, const Floats3&) const { return rgbOf(0.0f); }
};

LANES_END
