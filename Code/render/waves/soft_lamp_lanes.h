// Samples of lamps that have a size, and suns that have none, a register of points at a time, as in
// lit_lanes.h: a lane is a point of the block, and its samples follow each other.
#pragma once

#include "light/light.h"
#include "light/log_ratio.h"
#include "render/occluders.h"
#include "render/waves/circle_lanes.h"
#include "render/waves/cone_lanes.h"
#include "render/waves/disk_lanes.h"
#include "render/waves/flat_lamp_lanes.h"
#include "render/waves/frame_lanes.h"
#include "render/waves/hidden_lanes.h"
#include "render/waves/lamp_lanes.h"
#include "render/waves/lit_lanes.h"
#include "render/waves/round_lamp_lanes.h"
#include "render/waves/sphere_lamp_lanes.h"
#include "render/waves/sun_lanes.h"
#include "render/waves/three_lanes.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>

LANES_BEGIN

// W points of a block from `first` on, lit by a lamp that has a size. The lamp says which of them
// may see it, where a sample is on it (and again, surely, for lanes that are not sure), the way
// there, and the irradiance on a surface that faces it: what lookAt() returns.
template <class LampSeen> class SoftLanes {
public:
    // `share`: of each sample in the light.
    SoftLanes(const LampSeen& lamp, const LitBlock& block, float share, std::size_t first)
        : block_(block), first_(first), lit_(block, {first}), lamp_(lamp), share_(share) {}

    // Those of them that may be lit.
    unsigned lanesOf(unsigned points) const { return lit_.lanesOf(points) & lamp_.seen(); }

    bool isShiny() const { return lit_.isShiny(); }
    const LampSeen& lamp() const { return lamp_; }

    struct Sample {
        Three light;
        unsigned lit; // by it, if only by black
        unsigned shining() const {
            return static_cast<unsigned>(std::popcount(lit & ~black(light)));
        }
    };
    template <bool kMayShine> Sample sample(const LampRow& row, unsigned asked) const {
        const Three irradiance = lamp_.irradiance(row);
        const unsigned lit = asked & ~black(irradiance) & lit_.rises(row.toLight);
        const Three reflected =
            lit_.template reflected<kMayShine>(Three::load(block_.n, first_), row.toLight, lit);
        return {Three::load(block_.weight, first_) * reflected * irradiance * share_, lit};
    }

private:
    const LitBlock& block_;
    std::size_t first_;
    LitLanes<PointsInRow> lit_;
    LampSeen lamp_;
    Floats share_;
};

inline void store(const Three& v, float* x, float* y, float* z) {
    v.x.store(x), v.y.store(y), v.z.store(z);
}

// Row by row, and nothing is called: the processor works at several, and places some while it
// divides for others.
template <class LampSeen>
inline void findRows(const LampSeen& lamp, const SamplesOnLamp& samples, std::size_t first,
                     LampRow* rows) {
    if constexpr (!LampSeen::kHasPlaces) {
        lamp.findWay(rows[0]);
    } else {
        const PairsInLanes pairs{samples.index + first, samples.x + first, samples.y + first,
                                 samples.first + first};
        drawPairs(pairs, rows, static_cast<std::uint32_t>(samples.count));
        unsigned unsure = 0;
        lamp.place(rows[0], unsure);
        for (std::size_t s = 1; s < samples.count; ++s)
            lamp.place(rows[s], unsure), lamp.findWay(rows[s - 1]);
        lamp.findWay(rows[samples.count - 1]);
        if (unsure == 0) return;
        for (LampRow* row = rows; row != rows + samples.count; ++row)
            lamp.placeSurely(*row, unsure), lamp.findWay(*row);
    }
}

template <bool kMayShine, class LampSeen>
void sumSamples(const SoftLanes<LampSeen>& lanes, const SamplesOnLamp& samples,
                const LinesToLamp& lines, unsigned mayBeHidden, std::size_t first,
                LitBySamples& out) {
    constexpr std::size_t kPoints = LitBlock::kPoints;
    LampRow rows[LitBySamples::kMost];
    findRows(lanes.lamp(), samples, first, rows);
    const unsigned asked = lanes.lanesOf(samples.points);
    mayBeHidden = mayBeHidden >> first & ((1u << W) - 1);
    unsigned waiting = out.waiting >> first & ((1u << W) - 1);
    const Three before = Three::load(out.sum, first);
    Three sum = before;
    for (std::size_t s = 0; s < samples.count; ++s) {
        const LampRow& row = rows[s];
        auto by = lanes.template sample<kMayShine>(row, asked);
        out.shining += by.shining();
        if ((by.lit & mayBeHidden) != 0) {
            by.lit &= ~black(by.light);
            const auto [hidden, unsure] =
                lines.ask(row.toLight, row.distance, by.lit & mayBeHidden);
            by.lit &= ~hidden, waiting |= unsure;
            const std::size_t to = s * kPoints + first;
            store(by.light, out.light[0] + to, out.light[1] + to, out.light[2] + to);
            store(row.toLight, out.dir[0] + to, out.dir[1] + to, out.dir[2] + to);
            (Doubles(row.distance) * Doubles(1 - 0x1p-20)).toFloats().store(out.tMax + to);
            out.lit[s] |= static_cast<std::uint16_t>((by.lit & mayBeHidden) << first);
            out.unsure[s] |= static_cast<std::uint16_t>(unsure << first);
        }
        sum = select(maskOf(by.lit), sum + by.light, sum);
    }
    out.waiting |= waiting << first;
    store(select(maskOf(waiting), before, sum), out.sum[0] + first, out.sum[1] + first,
          out.sum[2] + first);
}

// Points of which nobody knows what may hide them send rays.
template <bool kMayShine, class LampSeen>
void sumOrSend(const SoftLanes<LampSeen>& lanes, const SamplesOnLamp& samples,
               const LitBlock& block, unsigned mayBeHidden, std::size_t first, LitBySamples& out) {
    LampRow rows[LitBySamples::kMost];
    findRows(lanes.lamp(), samples, first, rows);
    const unsigned asked = lanes.lanesOf(samples.points);
    mayBeHidden = mayBeHidden >> first & ((1u << W) - 1);
    // leave()
    const Three org = Three::load(block.p, first) +
                      Three::load(block.ng, first) * Floats::load(block.error + first) +
                      Three::load(block.lift, first);
    const Ints number = Ints::from(out.firstSum + static_cast<std::uint32_t>(first));
    Three sum = Three::load(out.sum, first);
    for (std::size_t s = 0; s < samples.count; ++s) {
        const LampRow& row = rows[s];
        const auto by = lanes.template sample<kMayShine>(row, asked);
        out.shining += by.shining();
        const unsigned sent = by.lit & mayBeHidden & ~black(by.light);
        if (sent != 0) {
            const std::size_t n = out.rays;
            storeChosenVectors(sent, org.x, org.y, org.z, &out.to.org[n].x);
            storeChosenVectors(sent, row.toLight.x, row.toLight.y, row.toLight.z, &out.to.dir[n].x);
            storeChosenVectors(sent, by.light.x, by.light.y, by.light.z, &out.to.weight[n].r);
            storeChosenFloats(sent, row.distance * Floats(1 - 0x1p-20f), out.to.tMax + n);
            storeChosen(sent, number, out.to.sum + n);
            out.rays += static_cast<std::size_t>(std::popcount(sent));
        }
        sum = select(maskOf(by.lit & ~mayBeHidden), sum + by.light, sum);
    }
    store(sum, out.sum[0] + first, out.sum[1] + first, out.sum[2] + first);
}

template <class Emission>
void sumBlock(const Emission& lamp, const LitBlock& block, const SamplesOnLamp& places,
              const Occluders& occluders, const HiddenPoints& hidden, LitBySamples& out) {
    for (std::size_t first = 0; first < LitBlock::kPoints; first += W) {
        const SoftLanes lanes(lookAt(lamp, block, first), block, places.share, first);
        if (lanes.lanesOf(places.points) == 0) continue;
        if (!hidden.areShapesKnown) {
            if (lanes.isShiny())
                sumOrSend<true>(lanes, places, block, hidden.maybe, first, out);
            else
                sumOrSend<false>(lanes, places, block, hidden.maybe, first, out);
            continue;
        }
        const LinesToLamp lines(block, occluders, hidden, first);
        if (lanes.isShiny())
            sumSamples<true>(lanes, places, lines, hidden.maybe, first, out);
        else
            sumSamples<false>(lanes, places, lines, hidden.maybe, first, out);
    }
}

void lightBySamples(const LampEmission& lamp, const LitBlock& block, const SamplesOnLamp& places,
                    const Occluders& occluders, const HiddenPoints& hidden, LitBySamples& out) {
    out.lit.fill(0), out.unsure.fill(0), out.shining = 0;
    if (const auto* const round = std::get_if<PointEmission>(&lamp))
        sumBlock(*round, block, places, occluders, hidden, out);
    else if (const auto* const flat = std::get_if<FlatEmission>(&lamp))
        sumBlock(*flat, block, places, occluders, hidden, out);
    else if (const auto* const sun = std::get_if<SunEmission>(&lamp))
        sumBlock(*sun, block, places, occluders, hidden, out);
    else if (const auto* const parallel = std::get_if<ParallelEmission>(&lamp))
        sumBlock(*parallel, block, places, occluders, hidden, out);
    else if (const auto* const sphere = std::get_if<SphereEmission>(&lamp))
        sumBlock(*sphere, block, places, occluders, hidden, out);
}

// cannotReach() and whole() of PointLight, and wholeLight() of a point.
void wholeLight(const PointEmission& lamp, const LitBlock& block, unsigned points,
                unsigned unhidden, WholeLight& out) {
    const Attenuation& fade = lamp.attenuation;
    if (lamp.cone || (!fade.isInverseSquare() && !fade.isConstant())) unhidden = 0;
    unhidden &= ~(block.shiny[0] | block.shiny[1] | block.shiny[2]);
    const Three none = Three::all(0, 0, 0);
    out.known = 0;
    for (std::size_t first = 0; first < LitBlock::kPoints; first += W) {
        const auto put = [&](const Three& light) {
            store(light, out.light[0] + first, out.light[1] + first, out.light[2] + first);
        };
        put(none);
        const LitLanes<PointsInRow> lit(block, {first});
        if (lit.lanesOf(points) == 0) continue;
        const Three n = Three::load(block.n, first);
        const Three d = Three::all(lamp.position.x, lamp.position.y, lamp.position.z) -
                        Three::load(block.p, first);
        const Floats distance2 = dot(d, d), distance = sqrt(distance2);
        const unsigned unseen = behindHorizon(lamp, n, d, distance2);
        out.known |= (lit.lanesOf(points) & unseen) << first;
        const Floats height = Floats(lamp.radius) + Floats(kHorizonSlack) * distance;
        const auto isAbove = [&](const Three& up) { return bits(dot(up, d) >= height); };
        unsigned above = isAbove(Three::load(block.ng, first));
        if (const unsigned lifted = lit.lanesOf(block.lifted); lifted != 0)
            above |= lifted & isAbove(Three::load(block.ns, first));
        unsigned lanes =
            lit.lanesOf(points & unhidden) & above & isAbove(n) & bits(distance2 > Floats(0.0f));
        if (lanes == 0) continue;
        const Floats radius2(sqr(lamp.radius));
        const Floats faded = fade.isConstant()
                                 ? Floats(fade.constant) / logRatio(radius2 / distance2)
                                 : Floats(fade.quadratic) * (distance2 + radius2);
        const Three irradiance = Three::all(lamp.intensity.r, lamp.intensity.g, lamp.intensity.b) *
                                 (Floats(1.0f) / faded);
        const Three reflected = lit.template reflected<false>(n, d / distance, lanes);
        const Three light = Three::load(block.weight, first) * reflected * irradiance;
        lanes &= ~black(light);
        put(select(maskOf(lanes), light, none));
        out.known |= lanes << first;
    }
}

LANES_END
