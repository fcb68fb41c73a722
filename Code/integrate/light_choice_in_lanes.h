// One lamp for each of W points, and a sample of its light.
#pragma once

#include "light/kinds/sky.h"
#include "light/lights.h"
#include "light/tree/pick_lanes.h"
#include "material/lobe.h"
#include "scene/path_lights.h"

#include <bit>
#include <cstddef>

LANES_BEGIN

struct ChosenLight {
    SampledLight sample;
    Floats probability; // of the choice
    unsigned met = 0;   // lanes whose lamp rays meet too, with the density that they have
    unsigned open = 0;  // lanes whose lamp casts no shadows
    Floats end;         // of the shadow ray: in front of a light that it would meet
};

// The numbers of a light for each lane, by column: those of one light, where no other is put.
class LightColumns {
public:
    explicit LightColumns(const LightRow& row) {
        for (std::size_t i = 0; i < kLightNumbers; ++i) Floats(row.numbers[i]).store(column_[i]);
    }
    void put(const LightRow& row, std::size_t lane) {
        for (std::size_t i = 0; i < kLightNumbers; ++i) column_[i][lane] = row.numbers[i];
    }
    LightNumbers numbers() const { return {column_[0], W}; }

private:
    alignas(64) float column_[kLightNumbers][W];
};

// Calls fn(light) for lights of the kind of `entry`.
template <class Fn>
void withLights(const PathLights& lights, const PathLights::Entry& entry,
                const LightNumbers& numbers, Fn&& fn) {
    if (entry.row.kind == PathLights::kSkyKind) fn(SkyEmitter(lights.skyView()));
    forLight(entry.row.kind, [&]<class L> { fn(L(numbers)); });
}
template <class L>
SampledLight sampleOf(const L& light, const PathLights::Entry& entry, const Floats3& p, Floats u,
                      Floats v) {
    if constexpr (requires { light.centre(p); })
        if (entry.inCentre || entry.isPlace) return light.centre(p);
    return light.sample(p, u, v);
}
inline SampledLight sampleOf(const PathLights& lights, const PathLights::Entry& entry,
                             const LightNumbers& numbers, const Floats3& p, Floats u, Floats v) {
    const Floats zero(0.0f);
    SampledLight out{rgbOf(0.0f), zero, rgbOf(0.0f), zero, noLanes()};
    withLights(lights, entry, numbers,
               [&](const auto& light) { out = sampleOf(light, entry, p, u, v); });
    return out;
}

// `n` is black where both sides of the surface are lit. Lanes that are not set get any sample.
// `pick` and `more` are the upper and lower bits of one random number.
inline ChosenLight chooseLight(const PathLights& lights, const Floats3& p, const Floats3& n,
                               Floats pick, Floats more, Floats u, Floats v, unsigned lanes) {
    const Doubles number = Doubles(pick) + Doubles(more) * Doubles(0x1p-24);
    const PickedLight picked = LightChoice(lights.tree()).pick(p, n, number);
    alignas(64) std::uint32_t light[W];
    picked.light.store(light);
    const Floats zero(0.0f);
    const Floats3 none{zero, zero, zero};
    ChosenLight out{{none, zero, none, zero, noLanes()}, picked.probability, 0, 0, zero};
    unsigned left = lanes & bits(picked.probability > zero);
    if (left != lanes) // no light: any row will do
        for (std::size_t lane = 0; lane < W; ++lane)
            if ((left >> lane & 1) == 0) light[lane] = 0;
    alignas(64) float end[W] = {};
    while (left != 0) {
        const std::uint32_t first = light[static_cast<std::size_t>(std::countr_zero(left))];
        const PathLights::Entry& leader = lights.entry(first);
        LightColumns columns(leader.row);
        unsigned alike = 0;
        for (std::size_t lane = 0; lane < W; ++lane) {
            const PathLights::Entry& entry = lights.entry(light[lane]);
            const bool is = entry.row.kind == leader.row.kind &&
                            entry.inCentre == leader.inCentre && entry.isPlace == leader.isPlace;
            if (!is) continue;
            if (light[lane] != first) columns.put(entry.row, lane);
            alike |= 1u << lane, end[lane] = PathLights::endOf(entry);
            if (entry.isOpen) out.open |= 1u << lane;
        }
        out.sample =
            select(maskOf(alike), sampleOf(lights, leader, columns.numbers(), p, u, v), out.sample);
        left &= ~alike;
    }
    out.end = out.sample.distance * Floats::load(end);
    out.met = ~bits(out.sample.single) & ~out.open;
    return out;
}

LANES_END
