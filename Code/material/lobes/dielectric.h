// Dielectric: glass and water, smooth or rough: reflects and transmits by Fresnel's law.
#pragma once

#include "material/boundary_lobe.h"

LANES_BEGIN

struct Dielectric : BoundaryLobe<true> {
    static constexpr const char* kName = "dielectric";
    static constexpr std::array<LobeField, 5> kFields{{{"ior", 1, {1.5f}, 0.001f, 1000},
                                                       {"reflect_tint", 3, {1, 1, 1}, 0, 1},
                                                       {"transmit_tint", 3, {1, 1, 1}, 0, 1},
                                                       {"roughness", 1, {0}, 0, 1},
                                                       {"anisotropy", 1, {0}, -1, 1}}};

    explicit Dielectric(const LobeNumbers& n)
        : BoundaryLobe(n.eta, Ggx(n[7], n[8], Floats(0.0f)).atLeast(n.leastAlpha), n.rgb(1),
                       n.rgb(4)) {}
};

LANES_END
