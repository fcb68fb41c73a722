// Translucent: light that comes out on the other side, the same in all directions.
#pragma once

#include "material/lobe.h"

LANES_BEGIN

struct Translucent {
    static constexpr const char* kName = "translucent";
    static constexpr std::array<LobeField, 0> kFields{};
    static constexpr std::uint32_t kFlags = kTransmits | kAnswersLights | kSpawnsRays | kDiffuse;

    explicit Translucent(const LobeNumbers&) {}
    Floats3 below(const Floats3&) const { return rgbOf(0.0f); }
    Floats3 albedo(const Floats3&) const { return rgbOf(1.0f); }
    Floats3 eval(const Floats3&, const Floats3&) const { return rgbOf(0.0f); }
    Floats pdf(const Floats3&, const Floats3&) const { return Floats(0.0f); }
    LobeSample sample(const Floats3& toEye, Floats, Floats, Floats) const {
        return {toEye, rgbOf(0.0f), Floats(0.0f), maskOf(0)};
    }
};

LANES_END
