// Translucent: light that comes out on the other side, the same in all directions there.
#pragma once

#include "material/lobes/diffuse.h"

LANES_BEGIN

struct Translucent {
    static constexpr const char* kName = "translucent";
    static constexpr std::array<LobeField, 0> kFields{};
    static constexpr std::uint32_t kFlags = kTransmits | kAnswersLights | kSpawnsRays | kDiffuse;

    explicit Translucent(const LobeNumbers& n) : inFront_(n) {}
    Floats3 below(const Floats3&) const { return rgbOf(0.0f); }
    Floats3 albedo(const Floats3&) const { return rgbOf(1.0f); }
    Floats3 eval(const Floats3& toEye, const Floats3& toLight) const {
        return inFront_.eval(toEye, behind(toLight));
    }
    Floats pdf(const Floats3& toEye, const Floats3& toLight) const {
        return inFront_.pdf(toEye, behind(toLight));
    }
    LobeSample sample(const Floats3& toEye, Floats pick, Floats u, Floats v) const {
        LobeSample s = inFront_.sample(toEye, pick, u, v);
        s.toLight = behind(s.toLight);
        return s;
    }

private:
    static Floats3 behind(const Floats3& v) { return {v.x, v.y, Floats(0.0f) - v.z}; }

    Diffuse inFront_;
};

LANES_END
