// Rays that plain mirrors send on, of a block of points at a time; bounces.h knows the rest.
#pragma once

#include "render/waves/wave.h"
#include "sample/hash.h"

#include <array>
#include <bit>

namespace waves {

// Branches of the tree of rays: numbers for Sampler.
inline constexpr std::uint32_t kReflected = 1, kRefracted = 2;

// A rough surface's highlight has counted the lamps; a sharp mirror shows their bodies.
inline bool showsLamps(const Material& material) {
    return material.roughness <= 0 || isBlack(material.specular);
}

// The points of a block whose materials mirror, if no ray leaves it in another way: else nothing is
// known.
inline std::optional<unsigned> plainMirrors(const Wave& wave, std::size_t b) {
    const PointBatch& points = wave.memory.points;
    const SceneMaterial* const materials = wave.context.scene.materials().data();
    const PointBlock& block = points.at.block(b);
    const auto isOther = [&](std::size_t i, const Material& material) {
        return !isPlainMirror(material) || materials[block.material[i]].isLamp;
    };
    if (const Material* const all = points.painted[b]) {
        if (isOther(0, *all)) return {};
        return isBlack(all->mirror) ? 0 : points.usedOf(b);
    }
    unsigned mirrors = 0;
    for (std::size_t i = 0; i < points.sizeOf(b); ++i) {
        const Material& material = *points.material[b * PointColumns::kPoints + i];
        if (isOther(i, material)) return {};
        mirrors |= static_cast<unsigned>(!isBlack(material.mirror)) << i;
    }
    return mirrors;
}

inline void mirrorInLanes(const Wave& wave, std::size_t b, unsigned mirrors) {
    if (mirrors == 0) return;
    const PointBatch& points = wave.memory.points;
    const std::size_t first = b * PointColumns::kPoints;
    std::array<Rgb, PointColumns::kPoints> colours;
    for (std::size_t i = 0; i < points.sizeOf(b); ++i)
        colours[i] = points.material[first + i]->mirror;
    const PathBatch& rays = wave.rays;
    PathBatch& next = wave.memory.next;
    std::size_t to = next.extend(PointColumns::kPoints); // lanes write whole registers
    unsigned worth = wave.context.shadeLanes.mirror(
        points.at.block(b), &points.weight[first], colours.data(), mirrors, wave.context.cutoff,
        {&next.org[to], &next.dir[to], nullptr, &next.weight[to]});
    const auto count = static_cast<std::size_t>(std::popcount(worth));
    wave.counts.reflect += count;
    next.shrink(to + count);
    for (; worth != 0; worth &= worth - 1, ++to) {
        const auto i = static_cast<std::size_t>(std::countr_zero(worth));
        const std::size_t from = points.ray[first + i];
        next.tMin[to] = 0, next.tMax[to] = kInfinityF, next.time[to] = rays.time[from];
        next.sample[to] = rays.sample[from];
        next.medium[to] = rays.medium[from];
        next.stream[to] = low32(hash(rays.stream[from], kReflected));
        next.seesLights[to] = showsLamps(*points.material[first + i]);
    }
}

} // namespace waves
