// What the tests of samplers share. None draws anything at random: samplers are functions, so every
// number there is fixed, and the bounds are what these fixed numbers meet with room to spare.
#pragma once

#include "sample/sampler.h"

#include <cstdint>
#include <vector>

namespace sampler_kit {

inline constexpr SamplerKind kKinds[] = {SamplerKind::Sobol, SamplerKind::Stratified,
                                         SamplerKind::Random, SamplerKind::Grid};

inline std::vector<Vec2> pairsOf(const Sampler& sampler, std::uint32_t pixel,
                                 std::uint32_t dimension, int count, int first = 0) {
    std::vector<Vec2> out;
    for (int i = 0; i < count; ++i)
        out.push_back(sampler.get2D(pixel, static_cast<std::uint32_t>(first + i), dimension));
    return out;
}

} // namespace sampler_kit
