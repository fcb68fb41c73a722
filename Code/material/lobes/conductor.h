// Conductor: metal, GGX, by its colour at normal incidence and a tint of it near the edge (82
// degrees), with the energy that facets would send to each other.
#pragma once

#include "material/reflecting_facets.h"

LANES_BEGIN

struct Conductor {
    static constexpr const char* kName = "conductor";
    static constexpr std::array<LobeField, 5> kFields{{{"color", 3, {0.8f, 0.8f, 0.8f}, 0, 1},
                                                       {"edge_tint", 3, {1, 1, 1}, 0, 1},
                                                       {"roughness", 1, {0.5f}, 0, 1},
                                                       {"anisotropy", 1, {0}, -1, 1},
                                                       {"rotation", 1, {0}, -1e6f, 1e6f}}};
    static constexpr std::uint32_t kFlags = kReflects | kAnswersLights | kSpawnsRays | kHasTangent;

    explicit Conductor(const LobeNumbers& n)
        : facets_{Ggx(n[6], n[7], n[8]).atLeast(n.leastAlpha), Metal(n.rgb(0), n.rgb(3))} {}
    Floats3 below(const Floats3&) const { return rgbOf(0.0f); }
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
    struct Metal : MetalFresnel {
        using MetalFresnel::MetalFresnel;
        Floats3 all(const FacetEnergy& energy, const Ggx&, const Floats3&) const {
            return of(energy.all(), energy.rise(), energy.bend());
        }
    };

    ReflectingFacets<Metal> facets_;
};

LANES_END
