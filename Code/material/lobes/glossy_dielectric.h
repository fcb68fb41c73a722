// GlossyDielectric: what a dielectric reflects, over something opaque: the specular layer of
// Principled. It is seen from outside on both sides of a surface, as in Cycles.
#pragma once

#include "material/layer_fresnel.h"
#include "material/reflecting_facets.h"

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

    explicit GlossyDielectric(const LobeNumbers& n)
        : facets_{Ggx(n[4], n[5], n[6]).atLeast(n.leastAlpha),
                  LayerFresnel(n[0], n[7] + n[7], n.rgb(1))} {}
    Floats3 below(const Floats3& toEye) const { return restOf(albedo(toEye)); }
    Floats3 albedo(const Floats3& toEye) const { return facets_.albedo(toEye); }
    Floats3 eval(const Floats3& toEye, const Floats3& toLight) const {
        return facets_.eval(toEye, toLight);
    }
    Floats pdf(const Floats3& toEye, const Floats3& toLight) const {
        return facets_.pdf(toEye, toLight);
    }
    LobeSample sample(const Floats3& toEye, Floats, Floats u, Floats v) const {
        return facets_.sample(toEye, u, v);
    }

private:
    ReflectingFacets<LayerFresnel> facets_;
};

LANES_END
