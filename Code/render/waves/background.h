// Stage of the wave: what rays see that meet no surface.
#pragma once

#include "render/integrator.h"
#include "render/waves/wave.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

namespace waves {

// The radiance that each of the missed rays sees, in the order of their list. Without a picture
// around the scene it is the same for all, and the list is empty.
inline std::span<const Rgb> backgroundsOf(const Wave& wave) {
    const Scene& scene = wave.context.scene;
    const Environment* const environment = scene.environment();
    if (environment == nullptr) return {};
    const auto missed = std::span<const std::uint32_t>(wave.memory.points.missed)
                            .first(wave.memory.points.missedCount);
    RawVector<Rgb>& seen = wave.memory.backgrounds;
    if (seen.size() < missed.size()) seen.resize(missed.size());
    if (wave.context.environmentColors == nullptr) {
        for (std::size_t m = 0; m < missed.size(); ++m)
            seen[m] = scene.background(wave.rays.dir[missed[m]]);
        return std::span(seen).first(missed.size());
    }
    const Environment::View view = environment->view();
    EnvironmentBlock block;
    for (std::size_t first = 0; first < missed.size(); first += EnvironmentBlock::kRays) {
        const std::size_t count = std::min(EnvironmentBlock::kRays, missed.size() - first);
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 dir = wave.rays.dir[missed[first + i]];
            block.dir[0][i] = dir.x, block.dir[1][i] = dir.y, block.dir[2][i] = dir.z;
        }
        wave.context.environmentColors(view, block, count);
        for (std::size_t i = 0; i < count; ++i)
            seen[first + i] = scene.background(
                view.texels ? Rgb{block.color[0][i], block.color[1][i], block.color[2][i]}
                            : environment->radiance(Environment::Place{block.s[i], block.t[i]}));
    }
    return std::span(seen).first(missed.size());
}

} // namespace waves
