// SchlickMirror: a smooth mirror by Schlick's formula, with a colour at normal incidence.
#pragma once

#include "material/boundary.h"

LANES_BEGIN

struct SchlickMirror {
    static constexpr const char* kName = "schlick_mirror";
    static constexpr std::array<LobeField, 1> kFields{{{"color", 3, {0.04f, 0.04f, 0.04f}, 0, 1}}};
    static constexpr std::uint32_t kFlags = kReflects | kSpawnsRays;

    explicit SchlickMirror(const LobeNumbers& n) : color_(n.rgb(0)) {}
    Floats3 below(const Floats3& toEye) const { return restOf(albedo(toEye)); }
    Floats3 albedo(const Floats3& toEye) const {
        return schlickReflected(color_, schlickPart(toEye.z));
    }
    Floats3 eval(const Floats3&, const Floats3&) const { return rgbOf(0.0f); }
    Floats pdf(const Floats3&, const Floats3&) const { return Floats(0.0f); }
    LobeSample sample(const Floats3& toEye, Floats, Floats, Floats) const {
        return {mirroredAtZ(toEye), albedo(toEye), Floats(1.0f), maskOf((1u << W) - 1)};
    }

private:
    Floats3 color_;
};

LANES_END
