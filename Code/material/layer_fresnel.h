// What a clear layer over something opaque reflects, seen from outside.
#pragma once

#include "material/energy.h"

LANES_BEGIN

// A dielectric of index ior in air, of which `scale` multiplies the reflectance at normal
// incidence, as a lower or higher index would (Principled's specular level times 2), and `tint`
// colours it there, while grazing light stays white: F0 tint (1 - s) + s, s = (F - F0) / (1 - F0),
// as Cycles 4.
struct LayerFresnel {
    Floats eta, f0;
    Floats3 tint;

    LayerFresnel(Floats ior, Floats scale, const Floats3& tint_) : tint(tint_) {
        const Floats one(1.0f), root = (ior - one) / (ior + one);
        f0 = min(max(root * root * scale, Floats(0.0f)), Floats(0.99f)); // the bound of Cycles
        const Floats scaled = sqrt(f0);
        eta = (one - scaled) / (one + scaled);
    }
    Floats3 at(Floats cosIn) const { return of(Floats(1.0f), boundaryAt(cosIn, eta).reflected); }
    Floats3 mean() const { return of(Floats(1.0f), BoundarySlices(eta).mean()); }
    Floats3 all(const FacetEnergy& energy, const Ggx& facets, const Floats3& toEye) const {
        const Floats e = energy.all();
        return of(e, e * BoundaryEnergy(facets, eta).reflected(toEye.z));
    }

private:
    // `reflected`: the untinted part of `all` light.
    Floats3 of(Floats all, Floats reflected) const {
        const Floats rise = max(reflected - f0 * all, Floats(0.0f)) / (Floats(1.0f) - f0);
        return tint * (f0 * (all - rise)) + rgbOf(rise);
    }
};

LANES_END
