// Coat: a clear layer that reflects white light and colours what comes through it, the more the
// longer the way through it is (Cycles 4).
#pragma once

#include "material/layer_fresnel.h"
#include "material/reflecting_facets.h"
#include "simd/pow_lanes.h"

LANES_BEGIN

struct Coat {
    static constexpr const char* kName = "coat";
    static constexpr std::array<LobeField, 3> kFields{{{"ior", 1, {1.5f}, 1, 1000},
                                                       {"tint", 3, {1, 1, 1}, 0, 1},
                                                       {"roughness", 1, {0.03f}, 0, 1}}};
    static constexpr std::uint32_t kFlags = kReflects | kAnswersLights | kSpawnsRays;

    explicit Coat(const LobeNumbers& n)
        : facets_{Ggx(n[4]).atLeast(n.leastAlpha), LayerFresnel(n[0], Floats(1.0f), rgbOf(1.0f))},
          tint_(n.rgb(1)) {}
    Floats3 below(const Floats3& toEye) const {
        const Floats ways = Floats(1.0f) / boundaryAt(toEye.z, facets_.fresnel.eta).cosOut;
        const auto through = [&](Floats tint) { return powOf(tint, ways, (1u << W) - 1); };
        const Floats3 absorbed{through(tint_.x), through(tint_.y), through(tint_.z)};
        return restOf(albedo(toEye)) * absorbed;
    }
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
    Floats3 tint_;
};

LANES_END
