// Points of a wave that lie on one shape, together: what a lamp is hidden by is asked for their
// box.
#pragma once

#include "render/waves/fill_blocks.h"

#include <algorithm>
#include <span>

namespace waves {

// The group of points on a shape; kMost: there are too many.
inline std::size_t groupFor(std::vector<PointGroup>& groups, std::uint32_t shape, bool inside) {
    std::size_t g = 0;
    while (g < groups.size() && (groups[g].shape != shape || groups[g].inside != inside)) ++g;
    if (g == groups.size() && g < PointGroup::kMost) groups.push_back({shape, inside, {}});
    return g;
}

// Sixteen points or fewer; false when there are too many groups.
inline bool groupOneByOne(WaveMemory& memory, std::span<const std::uint32_t> points,
                          std::span<std::uint16_t, PointGroup::kMost> inGroups) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::uint32_t k = points[i];
        const PointBlock& block = memory.points.at.block(k / PointColumns::kPoints);
        const std::size_t at = k % PointColumns::kPoints;
        const bool inside = !block.isFront(at) && !block.isLitApart(at);
        const std::size_t g = groupFor(memory.groups, memory.points.shape[k], inside);
        if (g == PointGroup::kMost) return false;
        Bounds& box = memory.groups[g].box;
        const Vec3 p = SurfaceBlock::get(block.p, at);
        box.extend(p);
        if (block.isCurved(at)) box.extend(p + SurfaceBlock::get(block.lift, at));
        inGroups[g] = static_cast<std::uint16_t>(inGroups[g] | 1u << i);
    }
    return true;
}

// Are all the points of the block on one side of one shape?
inline bool isOnOne(const WaveMemory& memory, std::size_t b) {
    const PointBatch& points = memory.points;
    const std::size_t first = b * PointColumns::kPoints, size = points.sizeOf(b);
    const PointBlock& block = points.at.block(b);
    const unsigned used = points.usedOf(b), outside = (block.front | block.litApart) & used;
    if (outside != 0 && outside != used) return false;
    for (std::size_t k = first + 1; k < first + size; ++k)
        if (points.shape[k] != points.shape[first]) return false;
    return true;
}

// Divides the points that answer lamps by the shape that they are on. False when there is nothing
// to win: points of later waves are far apart, those of many shapes have many boxes.
inline bool groupPoints(const Wave& wave) {
    const IntegratorContext& context = wave.context;
    WaveMemory& memory = wave.memory;
    if (wave.depth > 0 || !context.settings.specialise || !context.occluders.canTell())
        return false;
    memory.groups.clear();
    memory.inGroups.clear();
    for (std::span<const std::uint32_t> rest(memory.answering); !rest.empty();) {
        const auto here = rest.first(std::min(rest.size(), LitBlock::kPoints));
        rest = rest.subspan(here.size());
        auto& inGroups = memory.inGroups.emplace_back();
        const std::size_t b = here[0] / PointColumns::kPoints;
        if (context.shadeLanes.bounds == nullptr || !isWholeBlock(memory.points, here) ||
            !isOnOne(memory, b)) {
            if (!groupOneByOne(memory, here, inGroups)) return false;
            continue;
        }
        const PointBlock& block = memory.points.at.block(b);
        const bool inside = !block.isFront(0) && !block.isLitApart(0);
        const std::size_t g = groupFor(memory.groups, memory.points.shape[here[0]], inside);
        if (g == PointGroup::kMost) return false;
        const unsigned used = memory.points.usedOf(b);
        memory.groups[g].box.extend(context.shadeLanes.bounds(block, used));
        inGroups[g] = static_cast<std::uint16_t>(used);
    }
    return true;
}

// Which groups something may hide from a lamp.
inline void askGroups(const Wave& wave, const Lamp& lamp) {
    const Occluders& occluders = wave.context.occluders;
    for (PointGroup& group : wave.memory.groups)
        group.mayBeHidden = occluders.mayHide(group.box, group.shape, group.inside,
                                              lamp.light.sourcesFor(group.box, occluders.reach()),
                                              lamp.light.isAtInfinity());
}

// The points of a block that something may hide from the lamp that was asked about.
inline unsigned hiddenByGroup(const WaveMemory& memory, std::size_t block, bool isGrouped) {
    if (!isGrouped) return ~0u;
    unsigned points = 0;
    for (std::size_t g = 0; g < memory.groups.size(); ++g)
        if (memory.groups[g].mayBeHidden) points |= memory.inGroups[block][g];
    return points;
}

} // namespace waves
