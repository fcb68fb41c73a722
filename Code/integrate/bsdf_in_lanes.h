// Bsdf: all lobes of W points together, as one function that scatters light: eval(), pdf() and
// sample() of their weighted sum. Directions are in the shading frame (material/lobe.h).
#pragma once

#include "integrate/lobe_block.h"
#include "material/lobes.h"
#include "sample/power_heuristic.h"

#include <cstddef>

LANES_BEGIN

// What a sampled direction continues as.
struct BsdfSample {
    Floats3 toLight;
    Floats3 weight;       // what throughput is multiplied by
    Floats pdf;           // per steradian; 0: nothing was sampled
    Mask single, diffuse; // by a lobe of single directions; by a diffuse one
};

class Bsdf {
public:
    // Points `first` to first + W - 1 of a block.
    Bsdf(const LobeBlock& block, std::size_t first, const Floats3& toEye, Floats eta)
        : block_(block), first_(first), toEye_(toEye), eta_(eta) {
        Floats3 arrives = rgbOf(1.0f);
        for (std::size_t l = 0; l < block.count; ++l) {
            const LobeBlock::Column& column = block.lobe[l];
            const Floats3 w = rgbAt(column.value);
            weight_[l] = w * arrives;
            if (column.covers)
                forLobe(column.kind, [&]<class L> {
                    arrives = arrives * (rgbOf(1.0f) - w + w * L(numbers(l)).below(toEye_));
                });
        }
    }
    // Finds how likely each lobe is chosen, which eval() of all lobes and sample() ask for.
    void choose() {
        const Floats zero(0.0f);
        Floats sum = zero;
        for (std::size_t l = 0; l < block_.count; ++l) {
            share_[l] = zero;
            forLobe(block_.lobe[l].kind, [&]<class L> {
                if constexpr ((L::kFlags & kSpawnsRays) != 0)
                    share_[l] = maxOf(weight_[l] * L(numbers(l)).albedo(toEye_));
            });
            sum = sum + share_[l];
        }
        const Floats scale = select(sum > zero, Floats(1.0f) / sum, zero);
        for (std::size_t l = 0; l < block_.count; ++l) share_[l] = share_[l] * scale;
    }

    struct Value {
        Floats3 f;  // f |cos|
        Floats pdf; // per steradian
    };
    Value eval(const Floats3& toLight) const {
        Value value{rgbOf(0.0f), Floats(0.0f)};
        for (std::size_t l = 0; l < block_.count; ++l)
            forLobe(block_.lobe[l].kind, [&]<class L> {
                if constexpr ((L::kFlags & kAnswersLights) != 0) {
                    const L lobe(numbers(l));
                    value.f = value.f + weight_[l] * lobe.eval(toEye_, toLight);
                    if constexpr ((L::kFlags & kSpawnsRays) != 0)
                        value.pdf = value.pdf + share_[l] * lobe.pdf(toEye_, toLight);
                }
            });
        return value;
    }

    // f |cos| where lobes that spawn rays of their own, and are not diffuse, each take part in the
    // light of a lamp that is sampled with `lampPdf` per steradian (power heuristic). 0: they
    // don't.
    Floats3 evalBesideRays(const Floats3& toLight, Floats lampPdf) const {
        Floats3 f = rgbOf(0.0f);
        const Floats zero(0.0f), one(1.0f);
        const bool isShared = bits(lampPdf > zero) != 0;
        for (std::size_t l = 0; l < block_.count; ++l)
            forLobe(block_.lobe[l].kind, [&]<class L> {
                if constexpr ((L::kFlags & kAnswersLights) != 0) {
                    const L lobe(numbers(l));
                    Floats3 value = weight_[l] * lobe.eval(toEye_, toLight);
                    if constexpr (spawnsInWhitted(L::kFlags))
                        if (isShared && !block_.lobe[l].isHighlight) {
                            const Floats pdf = branchPdf(lobe, toEye_, toLight);
                            value =
                                value * select(lampPdf > zero, powerHeuristic(lampPdf, pdf), one);
                        }
                    f = f + value;
                }
            });
        return f;
    }
    // What part of even light from everywhere the diffuse lobes send on.
    Floats3 diffuseAlbedo() const {
        Floats3 sum = rgbOf(0.0f);
        for (std::size_t l = 0; l < block_.count; ++l)
            forLobe(block_.lobe[l].kind, [&]<class L> {
                if constexpr ((L::kFlags & kDiffuse) != 0)
                    sum = sum + weight_[l] * L(numbers(l)).albedo(toEye_);
            });
        return sum;
    }
    // Calls fn(lobe, transmits) for all that Whitted pictures follow rays of: each lobe, or its
    // reflection and its transmission apart.
    template <class Fn> void forEachBranch(const Fn& fn) const {
        for (std::size_t l = 0; l < block_.count; ++l)
            forLobe(block_.lobe[l].kind, [&]<class L> {
                if constexpr (spawnsInWhitted(L::kFlags)) {
                    if (block_.lobe[l].isHighlight) return;
                    fn(l, false);
                    if constexpr ((L::kFlags & kReflects) != 0 && (L::kFlags & kTransmits) != 0)
                        fn(l, true);
                }
            });
    }
    // A sample of one lobe, of its reflection or transmission if it has both. Its weight is all
    // that the lobe adds.
    LobeSample sampleLobe(std::size_t l, bool transmits, Floats pick, Floats u, Floats v) const {
        const Floats zero(0.0f);
        LobeSample out{rgbOf(0.0f), rgbOf(0.0f), zero, maskOf(0)};
        forLobe(block_.lobe[l].kind, [&]<class L> {
            if constexpr (spawnsInWhitted(L::kFlags)) {
                const L lobe(numbers(l));
                if constexpr ((L::kFlags & kReflects) != 0 && (L::kFlags & kTransmits) != 0)
                    out = lobe.branch(toEye_, transmits, u, v);
                else
                    out = lobe.sample(toEye_, pick, u, v);
                out.weight = weight_[l] * out.weight;
            }
        });
        return out;
    }

    // By three numbers in [0,1); after choose().
    BsdfSample sample(Floats pick, Floats u, Floats v) const {
        const Floats zero(0.0f), one(1.0f);
        BsdfSample out{{zero, zero, one}, rgbOf(0.0f), zero, maskOf(0), maskOf(0)};
        Floats from = zero;
        for (std::size_t l = 0; l < block_.count; ++l) {
            const Floats share = share_[l], to = from + share;
            const Mask chosen = (pick >= from) & (pick < to);
            if (bits(chosen) != 0)
                forLobe(block_.lobe[l].kind, [&]<class L> {
                    if constexpr ((L::kFlags & kSpawnsRays) != 0) {
                        const Floats again =
                            min((pick - from) / share, Floats(kOneMinusUlp)); // is in [0,1) again
                        const LobeSample s = L(numbers(l)).sample(toEye_, again, u, v);
                        out.toLight = select(chosen, s.toLight, out.toLight);
                        out.weight = select(chosen, weight_[l] * s.weight / share, out.weight);
                        out.pdf = select(chosen, s.pdf * share, out.pdf);
                        out.single = out.single | (chosen & s.single);
                        if constexpr ((L::kFlags & kDiffuse) != 0)
                            out.diffuse = out.diffuse | chosen;
                    }
                });
            from = to;
        }
        if (block_.count == 1) return out;
        // All lobes together could have given the direction.
        const Mask together = maskOf(bits(out.pdf > zero) & ~bits(out.single));
        if (bits(together) == 0) return out;
        const Value value = eval(out.toLight);
        out.weight = select(together, value.f / value.pdf, out.weight);
        out.pdf = select(together, value.pdf, out.pdf);
        return out;
    }

private:
    // The density with which Whitted pictures send a ray of the lobe there.
    template <class L>
    static Floats branchPdf(const L& lobe, const Floats3& toEye, const Floats3& toLight) {
        if constexpr ((L::kFlags & kReflects) != 0 && (L::kFlags & kTransmits) != 0)
            return lobe.branchPdf(toEye, toLight);
        else
            return lobe.pdf(toEye, toLight);
    }
    LobeNumbers numbers(std::size_t l) const {
        return {block_.lobe[l].value[3] + first_, LobeBlock::kPoints, eta_,
                Floats::load(block_.leastAlpha + first_)};
    }
    Floats3 rgbAt(const LobeBlock::Lane* value) const {
        return {Floats::load(value[0] + first_), Floats::load(value[1] + first_),
                Floats::load(value[2] + first_)};
    }

    const LobeBlock& block_;
    std::size_t first_;
    Floats3 toEye_;
    Floats eta_;
    Floats3 weight_[LobeBlock::kMost]; // with what lies on them
    Floats share_[LobeBlock::kMost];   // probability to be chosen
};

LANES_END
