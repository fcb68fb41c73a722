// What the tests of samplers share. None draws anything at random: samplers are functions, so every
// number there is fixed, and the bounds are what these fixed numbers meet with room to spare.
#pragma once

#include "sample/sampler.h"

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

namespace sampler_kit {

inline constexpr SamplerKind kKinds[] = {SamplerKind::Sobol, SamplerKind::Stratified,
                                         SamplerKind::Random, SamplerKind::Grid,
                                         SamplerKind::ZSobol};

inline std::vector<Vec2> pairsOf(const Sampler& sampler, std::uint32_t pixel,
                                 std::uint32_t dimension, int count, int first = 0) {
    std::vector<Vec2> out;
    for (int i = 0; i < count; ++i)
        out.push_back(sampler.get2D(pixel, static_cast<std::uint32_t>(first + i), dimension));
    return out;
}

// True when each of the columns x rows cells holds exactly one point.
inline bool fillsCells(const std::vector<Vec2>& points, int columns, int rows) {
    std::set<int> cells;
    for (const Vec2 p : points)
        cells.insert(static_cast<int>(p.x * static_cast<float>(columns)) +
                     columns * static_cast<int>(p.y * static_cast<float>(rows)));
    return cells.size() == points.size() && std::ssize(points) == std::ptrdiff_t{columns} * rows;
}

} // namespace sampler_kit
