// Refraction: a boundary that all light goes through, as Blender's Refraction BSDF; what is totally
// reflected stays on its side.
#pragma once

#include "material/boundary_lobe.h"

LANES_BEGIN

struct Refraction : BoundaryLobe<false> {
    static constexpr const char* kName = "refraction";
    static constexpr std::array<LobeField, 2> kFields{
        {{"ior", 1, {1.5f}, 0.001f, 1000}, {"roughness", 1, {0}, 0, 1}}};

    explicit Refraction(const LobeNumbers& n)
        : BoundaryLobe(n.eta, Ggx(n[1]).atLeast(n.leastAlpha), rgbOf(1.0f), rgbOf(1.0f)) {}
};

LANES_END
