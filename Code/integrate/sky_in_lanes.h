// What rays add of the sky that lobes sent, where it is sampled as a lamp as well.
#pragma once

#include "integrate/shading_kernel.h"
#include "light/kinds/sky.h"
#include "light/tree/pick_lanes.h"
#include "sample/power_heuristic.h"
#include "scene/path_lights.h"

#include <cstddef>

LANES_BEGIN

// Returns the density per steradian of samples of the sky along `dir`, as PathLights::pdf() does.
inline Floats skyDensity(const PathLights& lights, const LampSampling& sampling, const Floats3& p,
                         const Floats3& n, const Floats3& dir) {
    if (lights.entry(lights.sky()).isOfSamplesAlone()) return kInfinityF;
    const Floats pdf = SkyEmitter(lights.skyView()).pdf(p, dir) * Floats(sampling.samples);
    if (!sampling.isOneChosen) return pdf;
    return pdf * LightChoice(lights.tree()).probability(p, n, Ints(lights.sky()));
}

inline void skyParts(const PathLights& lights, const LampSampling& sampling, SkyBlock& block,
                     std::size_t count) {
    for (std::size_t first = 0; first < count; first += W) {
        const auto of = [&](const SkyBlock::Lane(&v)[3]) {
            return Floats3{Floats::load(v[0] + first), Floats::load(v[1] + first),
                           Floats::load(v[2] + first)};
        };
        const Floats pdf = Floats::load(block.pdf + first);
        const Floats other =
            skyDensity(lights, sampling, of(block.p), of(block.n), normalize(of(block.dir)));
        select(pdf > Floats(0.0f), powerHeuristic(pdf, other), Floats(1.0f))
            .store(block.part + first);
    }
}

LANES_END
