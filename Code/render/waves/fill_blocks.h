// Points of a wave that answer lamps, in blocks as lanes want them.
#pragma once

#include "render/waves/lamp_light.h"

#include <algorithm>

namespace waves {

inline bool seesLampsFromInside(const ShadedPoint& at) { return !(at.front || at.of->litOutside); }

// The numbers of a point's material.
inline void paintPoint(const Material& material, std::size_t i, LitBlock& block) {
    const auto put = [i](float(*to)[LitBlock::kPoints], Rgb c) {
        to[0][i] = c.r, to[1][i] = c.g, to[2][i] = c.b;
    };
    put(block.diffuse, material.diffuse);
    if (isBlack(material.specular)) return;
    put(block.specular, material.specular);
    block.exponent[i] = material.exponent;
    block.shiny[static_cast<std::size_t>(material.specularModel)] |= 1u << i;
}

// Of any points.
inline void fillOneByOne(const WaveMemory& memory, std::span<const std::uint32_t> points,
                         LitBlock& block) {
    block.lifted = block.inside = 0;
    for (unsigned& shiny : block.shiny) shiny = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::uint32_t k = points[i];
        const ShadedPoint at = memory.points.at[k];
        const Rgb weight = memory.points.weight[k];
        SurfaceBlock::set(block.p, i, at.surface.p);
        SurfaceBlock::set(block.lift, i, at.surface.lift);
        SurfaceBlock::set(block.n, i, at.lit.n);
        SurfaceBlock::set(block.ng, i, at.lit.ng);
        SurfaceBlock::set(block.ns, i, at.lit.ns);
        SurfaceBlock::set(block.toEye, i, at.toEye);
        SurfaceBlock::set(block.weight, i, {weight.r, weight.g, weight.b});
        block.error[i] = at.surface.error, block.rayError[i] = at.surface.rayError;
        const unsigned bit = 1u << i;
        if (seesLampsFromInside(at)) block.inside |= bit;
        if (at.surface.lift != Vec3{}) block.lifted |= bit;
        paintPoint(*memory.points.material[k], i, block);
    }
}

// Of all the points of block b, register by register.
inline void fillInLanes(const Wave& wave, std::size_t b, LitBlock& block) {
    const ShadeLanes& lanes = wave.context.shadeLanes;
    const PointBatch& points = wave.memory.points;
    const std::size_t first = b * PointColumns::kPoints, size = points.sizeOf(b);
    lanes.light(points.at.block(b), &points.weight[first], points.usedOf(b), block);
    if (const Material* const all = points.painted[b].all) return lanes.paint(*all, block);
    if (size == PointColumns::kPoints) return lanes.paintEach(&points.material[first], block);
    for (unsigned& shiny : block.shiny) shiny = 0;
    for (std::size_t i = 0; i < size; ++i) paintPoint(*points.material[first + i], i, block);
}

// Are these numbers, which ascend, all the points of one block?
inline bool isWholeBlock(const PointBatch& points, std::span<const std::uint32_t> numbers) {
    return numbers[0] % PointColumns::kPoints == 0 &&
           numbers.back() - numbers[0] == numbers.size() - 1 &&
           numbers.size() == points.sizeOf(numbers[0] / PointColumns::kPoints);
}

// What is asked of the materials of points that are filled in soon: thousands are more than the
// nearest caches hold.
inline void prefetchMaterials(const PointBatch& points, std::span<const std::uint32_t> numbers) {
    for (const std::uint32_t k : numbers) __builtin_prefetch(points.material[k]);
}

inline void fillBlocks(const Wave& wave) {
    static_assert(LitBlock::kPoints == PointColumns::kPoints);
    WaveMemory& memory = wave.memory;
    const std::span<const std::uint32_t> answering(memory.answering);
    const std::size_t blocks = (answering.size() + LitBlock::kPoints - 1) / LitBlock::kPoints;
    if (memory.litBlocks.size() < blocks) {
        memory.litBlocks.reserve(memory.points.at.size() / LitBlock::kPoints);
        memory.litBlocks.resize(blocks);
    }
    for (std::size_t b = 0; b < blocks; ++b) {
        LitBlock& block = memory.litBlocks[b];
        const std::size_t first = b * LitBlock::kPoints;
        const auto here =
            answering.subspan(first, std::min(answering.size() - first, LitBlock::kPoints));
        if (const std::size_t soon = first + 2 * LitBlock::kPoints; soon < answering.size())
            prefetchMaterials(
                memory.points,
                answering.subspan(soon, std::min(answering.size() - soon, LitBlock::kPoints)));
        block.used = (1u << here.size()) - 1;
        std::copy(here.begin(), here.end(), block.point);
        if (isWholeBlock(memory.points, here) && wave.context.shadeLanes.light != nullptr) {
            fillInLanes(wave, here[0] / LitBlock::kPoints, block);
            std::copy_n(&memory.points.shape[here[0]], here.size(), block.shape);
        } else {
            fillOneByOne(memory, here, block);
            for (std::size_t i = 0; i < here.size(); ++i)
                block.shape[i] = memory.points.shape[here[i]];
        }
    }
}

} // namespace waves
