// What lobes that reflect and transmit at a boundary have in common, smooth or rough (GGX). What
// facets lose is scaled away where Fresnel's law divides the light, so that white tints keep all of
// it. Radiance is not scaled by eta^2 on its way through, as in Cycles.
#pragma once

#include "material/energy.h"

LANES_BEGIN

// kHasFresnel: light is divided by Fresnel's law. Else all of it goes through, but for total
// internal reflection.
template <bool kHasFresnel> struct BoundaryLobe {
    static constexpr std::uint32_t kFlags =
        kReflects | kTransmits | kAnswersLights | kSpawnsRays | kHasSides | kHasTangent;

    BoundaryLobe(Floats eta, const Ggx& facets, const Floats3& reflects, const Floats3& transmits)
        : eta_(eta), facets_(facets), reflects_(reflects), transmits_(transmits) {
        // Facets turn light that goes through by less than floats resolve: it goes straight on.
        const Mask isStraight = facets_.alpha * abs(Floats(1.0f) - eta_) <= Floats(Ggx::kSmooth);
        facets_.smooth = facets_.smooth | isStraight;
    }
    Floats3 below(const Floats3&) const { return rgbOf(0.0f); }
    Floats3 albedo(const Floats3& toEye) const {
        const Floats one(1.0f);
        const Boundary at = boundary(toEye.z);
        Floats part = at.reflected;
        if (kHasFresnel && !isSmooth()) {
            const Ggx narrow = facets_.narrowed();
            const BoundaryEnergy energy(narrow, eta_);
            const Floats reflected = FacetEnergy(facets_, toEye, facets_.lossyRoughness()).all() *
                                     energy.reflected(toEye.z) / energy.all(narrow, toEye);
            part = select(facets_.smooth, part, min(reflected, one));
        }
        return select(facets_.smooth, reflectedAt(at), reflects_ * part) +
               transmits_ * (one - part);
    }
    Floats3 eval(const Floats3& toEye, const Floats3& toLight) const {
        if (isSmooth()) return rgbOf(0.0f);
        const FacetPair pair = facets_.pairOf(toEye, toLight, eta_);
        const Split split(*this, pair.cosIn);
        // Where nothing arrives the scale may be no number.
        const Floats zero(0.0f), sent = pair.pdf * pair.ratio;
        return split.part(isReflected(toLight)) * select(sent > zero, sent * scale(toEye), zero);
    }
    Floats pdf(const Floats3& toEye, const Floats3& toLight) const {
        if (isSmooth()) return Floats(0.0f);
        const FacetPair pair = facets_.pairOf(toEye, toLight, eta_);
        return pair.pdf * Split(*this, pair.cosIn).chance(isReflected(toLight));
    }
    // The density of branch().
    Floats branchPdf(const Floats3& toEye, const Floats3& toLight) const {
        return isSmooth() ? Floats(0.0f) : facets_.pairOf(toEye, toLight, eta_).pdf;
    }
    LobeSample sample(const Floats3& toEye, Floats pick, Floats u, Floats v) const {
        const Floats3 h = facet(toEye, u, v);
        const Floats cosIn = dot(toEye, h);
        const Split split(*this, cosIn);
        const Mask reflects = pick < split.reflects;
        return sent(toEye, h, cosIn, split.boundary.cosOut, reflects, true);
    }
    LobeSample branch(const Floats3& toEye, bool transmits, Floats u, Floats v) const {
        const Floats3 h = facet(toEye, u, v);
        const Floats cosIn = dot(toEye, h);
        const Mask reflects = maskOf(transmits ? 0 : (1u << W) - 1);
        return sent(toEye, h, cosIn, boundary(cosIn).cosOut, reflects, false);
    }

private:
    // What happens at a facet: what it reflects and transmits, and how likely a sample is
    // reflected.
    struct Split {
        Boundary boundary;
        Floats3 reflected, transmitted;
        Floats reflects;
        Split(const BoundaryLobe& of, Floats cosIn)
            : boundary(of.boundary(cosIn)), reflected(of.reflectedAt(boundary)),
              transmitted(of.transmits_ * (Floats(1.0f) - boundary.reflected)) {
            const Floats most = maxOf(reflected), all = most + maxOf(transmitted);
            reflects = select(all > Floats(0.0f), most / all, Floats(0.0f));
        }
        Floats3 part(Mask isReflected) const { return select(isReflected, reflected, transmitted); }
        Floats chance(Mask isReflected) const {
            return select(isReflected, reflects, Floats(1.0f) - reflects);
        }
    };

    // Total reflection keeps what would have gone through, too.
    Floats3 reflectedAt(const Boundary& at) const {
        const Floats3 all{max(reflects_.x, transmits_.x), max(reflects_.y, transmits_.y),
                          max(reflects_.z, transmits_.z)};
        return select(at.reflected >= Floats(1.0f), all, reflects_ * at.reflected);
    }
    bool isSmooth() const { return bits(facets_.smooth) == (1u << W) - 1; }
    static Mask isReflected(const Floats3& toLight) { return toLight.z >= Floats(0.0f); }
    Boundary boundary(Floats cosIn) const {
        Boundary at = boundaryAt(cosIn, eta_);
        const Floats one(1.0f);
        if (!kHasFresnel) at.reflected = select(at.reflected >= one, one, Floats(0.0f));
        return at;
    }
    Floats scale(const Floats3& toEye) const {
        if (!kHasFresnel) return Floats(1.0f);
        // Facets of two widths lose at least as much light as those of the narrower one, so that
        // nothing is gained.
        const Ggx narrow = facets_.narrowed();
        return Floats(1.0f) / BoundaryEnergy(narrow, eta_).all(narrow, toEye);
    }
    Floats3 facet(const Floats3& toEye, Floats u, Floats v) const {
        const Floats3 up{Floats(0.0f), Floats(0.0f), Floats(1.0f)};
        return isSmooth() ? up : select(facets_.smooth, up, facets_.visibleNormal(toEye, u, v));
    }

    // The light of one facet, whose choice of a side counts in weight and pdf if it `isChosen`.
    LobeSample sent(const Floats3& toEye, const Floats3& h, Floats cosIn, Floats cosOut,
                    Mask reflects, bool isChosen) const {
        const Floats zero(0.0f), one(1.0f);
        const Floats3 straight{zero - eta_ * toEye.x, zero - eta_ * toEye.y, zero - cosOut};
        const Floats3 bent =
            normalize(select(cosOut > zero, refractedBy(h, toEye, cosIn, cosOut, eta_), h));
        const Floats3 toLight =
            select(reflects, mirroredBy(h, toEye, cosIn), select(facets_.smooth, straight, bent));
        // A reflected direction below the surface, or a transmitted one above it, is lost.
        const Floats side = select(reflects, toLight.z, zero - toLight.z);
        Mask is = side > zero;
        Floats cosPair = cosIn, density = one, ratio = one;
        if (!isSmooth()) {
            const FacetPair pair = facets_.pairOf(toEye, toLight, eta_);
            cosPair = select(facets_.smooth, cosIn, pair.cosIn);
            density = select(facets_.smooth, one, pair.pdf);
            ratio = select(facets_.smooth, one, pair.ratio * scale(toEye));
        }
        const Split split(*this, cosPair);
        const Floats chance = isChosen ? split.chance(reflects) : one;
        // Total internal reflection transmits nothing.
        is = is & (chance > zero) & (density > zero) &
             (select(reflects, one, one - split.boundary.reflected) > zero);
        const Floats3 weight = split.part(reflects) * (ratio / select(is, chance, one));
        return {toLight, select(is, weight, rgbOf(0.0f)), select(is, density * chance, zero),
                facets_.smooth};
    }

    Floats eta_;
    Ggx facets_;
    Floats3 reflects_, transmits_;
};

LANES_END
