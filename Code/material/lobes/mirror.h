// Mirror: a smooth mirror that reflects the same at all angles.
#pragma once

#include "material/boundary.h"

LANES_BEGIN

struct Mirror {
    static constexpr const char* kName = "mirror";
    static constexpr std::array<LobeField, 0> kFields{};
    static constexpr std::uint32_t kFlags = kReflects | kSpawnsRays;

    explicit Mirror(const LobeNumbers&) {}
    Floats3 below(const Floats3&) const { return rgbOf(0.0f); }
    Floats3 albedo(const Floats3&) const { return rgbOf(1.0f); }
    Floats3 eval(const Floats3&, const Floats3&) const { return rgbOf(0.0f); }
    Floats pdf(const Floats3&, const Floats3&) const { return Floats(0.0f); }
    LobeSample sample(const Floats3& toEye, Floats, Floats, Floats) const {
        return {mirroredAtZ(toEye), rgbOf(1.0f), Floats(1.0f), maskOf((1u << W) - 1)};
    }
};

LANES_END
