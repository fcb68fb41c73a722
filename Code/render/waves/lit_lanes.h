// What W points of a block answer to light: the formulas of reflectedLight() and rises(), lane by
// lane and in their order. Where those return early, lanes go on with numbers that nobody takes.
#pragma once

#include "simd/pow_lanes.h"
#include "base/math.h"
#include "render/waves/lamp_lanes.h"
#include "render/waves/three_lanes.h"
#include "simd/lanes.h"

#include <cstddef>

LANES_BEGIN

// Which point of a block each lane is: those from `first` on.
struct PointsInRow {
    std::size_t first;
    Floats each(const float (&v)[LitBlock::kPoints]) const { return Floats::load(v + first); }
    unsigned lanesOf(unsigned points) const { return points >> first & ((1u << W) - 1); }
    std::size_t point(std::size_t lane) const { return first + lane; }
};
template <class Points> class LitLanes {
public:
    LitLanes(const LitBlock& block, const Points& points) : block_(block), points_(points) {}

    Three three(const float (&v)[3][LitBlock::kPoints]) const {
        return {points_.each(v[0]), points_.each(v[1]), points_.each(v[2])};
    }
    Floats each(const float (&v)[LitBlock::kPoints]) const { return points_.each(v); }
    unsigned lanesOf(unsigned points) const { return points_.lanesOf(points); }

    unsigned rises(const Three& toLight) const {
        unsigned lanes = bits(dot(three(block_.ng), toLight) > Floats(0.0f));
        if (const unsigned lifted = lanesOf(block_.lifted); lifted != 0)
            lanes |= lifted & bits(dot(three(block_.ns), toLight) > Floats(0.0f));
        return lanes;
    }

    bool isShiny() const { return (block_.shiny[0] | block_.shiny[1] | block_.shiny[2]) != 0; }

    // kMayShine: points of the block may have highlights.
    template <bool kMayShine = true>
    Three reflected(const Three& n, const Three& toLight, unsigned lanes) const {
        const Floats cosLight = dot(n, toLight);
        const Mask answers = cosLight > Floats(0.0f);
        Three reflected = three(block_.diffuse) * (Floats(static_cast<float>(kInvPi)) * cosLight);
        if constexpr (kMayShine)
            reflected = withHighlights(reflected, n, toLight, cosLight, lanes & bits(answers));
        return select(answers, reflected, Three::all(0, 0, 0));
    }

private:
    static constexpr float kInvPiF = static_cast<float>(kInvPi);

    Three withHighlights(Three reflected, const Three& n, const Three& toLight, Floats cosLight,
                         unsigned lanes) const {
        const auto shiny = [&](SpecularModel model) {
            return lanes & lanesOf(block_.shiny[static_cast<std::size_t>(model)]);
        };
        const unsigned phong = shiny(SpecularModel::Phong), blinn = shiny(SpecularModel::Blinn),
                       ashikhmin = shiny(SpecularModel::Ashikhmin);
        lanes &= phong | blinn | ashikhmin;
        if (lanes == 0) return reflected;
        const Floats zero(0.0f), one(1.0f);
        const Three toEye = three(block_.toEye);
        const Floats cosEye = dot(n, toEye);
        Floats base(0.0f), sumLength(0.0f);
        if (phong != 0) base = min(Floats(2.0f) * (cosLight * cosEye) - dot(toLight, toEye), one);
        if ((blinn | ashikhmin) != 0) {
            const Three half = toEye + toLight;
            const Floats length2 = dot(half, half);
            sumLength = sqrt(length2);
            const Floats cosHalf = select(length2 > zero, min(dot(n, half / sumLength), one), zero);
            base = select(maskOf(phong), base, cosHalf);
        }
        const Mask glitters = base > zero;
        const unsigned shining = lanes & bits(glitters);
        Floats lobe(0.0f);
        if (shining != 0) lobe = powOf(base, each(block_.exponent), shining);
        if (ashikhmin != 0) {
            const Floats norm = (each(block_.exponent) + one) * Floats(kInvPiF / 8);
            const Floats cosHalfEye = Floats(0.5f) * sumLength;
            lobe = select(maskOf(ashikhmin),
                          norm * lobe * cosLight / (cosHalfEye * max(cosLight, cosEye)), lobe);
        }
        const Three highlight =
            select(glitters, three(block_.specular) * lobe, Three::all(0, 0, 0));
        return select(maskOf(lanes), reflected + highlight, reflected);
    }

    const LitBlock& block_;
    Points points_;
};

LANES_END
