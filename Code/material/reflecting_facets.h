// Facets that only reflect, by some Fresnel: what conductor, glossy_dielectric and coat are.
#pragma once

#include "material/energy.h"
#include "material/ggx.h"

LANES_BEGIN

// A Fresnel F has
//   Floats3 at(Floats cosIn) const;   what a facet reflects
//   Floats3 mean() const;             over the hemisphere, weighted by the cosine; white is 1
//   Floats3 all(const FacetEnergy&, const Ggx&, const Floats3& toEye) const;
//                                     what facets seen from there reflect in one bounce
template <class F> struct ReflectingFacets {
    Ggx facets;
    F fresnel;

    Floats3 albedo(const Floats3& toEye) const {
        const Floats3 v = facets.inward(toEye), ofMirror = fresnel.at(v.z);
        if (areAll(facets.smooth)) return ofMirror;
        const FacetEnergy once(facets, v, facets.lossyRoughness());
        return select(facets.smooth, ofMirror, fresnel.all(once, facets, v) * scale(v));
    }
    Floats3 eval(const Floats3& toEye, const Floats3& toLight) const {
        if (areAll(facets.smooth)) return rgbOf(0.0f);
        const Floats3 v = facets.inward(toEye);
        const FacetPair pair = pairOf(v, facets.inward(toLight));
        return sent(v, pair) * pair.pdf;
    }
    Floats pdf(const Floats3& toEye, const Floats3& toLight) const {
        if (areAll(facets.smooth)) return Floats(0.0f);
        return pairOf(facets.inward(toEye), facets.inward(toLight)).pdf;
    }
    LobeSample sample(const Floats3& toEye, Floats u, Floats w) const {
        const Floats3 mirror = mirroredAtZ(toEye);
        const LobeSample single{mirror, fresnel.at(toEye.z), Floats(1.0f), facets.smooth};
        if (areAll(facets.smooth)) return single;
        const Floats3 v = facets.inward(toEye), h = facets.visibleNormal(v, u, w);
        const Floats3 toLight = facets.outward(mirroredBy(h, v, dot(v, h)));
        const FacetPair pair = pairOf(v, facets.inward(toLight));
        return {select(facets.smooth, mirror, toLight),
                select(facets.smooth, single.weight, sent(v, pair)),
                select(facets.smooth, single.pdf, pair.pdf), facets.smooth};
    }

private:
    static bool areAll(Mask m) { return bits(m) == (1u << W) - 1; }
    FacetPair pairOf(const Floats3& v, const Floats3& toLight) const {
        FacetPair pair = facets.pairOf(v, toLight, Floats(1.0f));
        const Mask isInFront = toLight.z > Floats(0.0f);
        pair.pdf = select(isInFront, pair.pdf, Floats(0.0f));
        pair.ratio = select(isInFront, pair.ratio, Floats(0.0f));
        return pair;
    }
    Floats3 sent(const Floats3& v, const FacetPair& pair) const {
        // Where nothing arrives the scale may be no number.
        const Floats zero(0.0f);
        return select(pair.ratio > zero, fresnel.at(pair.cosIn) * scale(v) * pair.ratio,
                      rgbOf(zero));
    }
    Floats3 scale(const Floats3& v) const {
        return FacetEnergy(facets, v, facets.meanRoughness()).scale(fresnel.mean());
    }
};

LANES_END
