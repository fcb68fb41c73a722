// Boxes, bins and the choice of a split by the surface area heuristic (Wald 2007), for the three
// axes at once: lane = axis.
#pragma once

#include "accel/kernels/build/box.h"
#include "accel/kernels/build/build.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace kernels::build {

inline WideBinGrid gridOver(Four lo, Four hi, std::uint32_t count) {
    const auto bins = std::min(static_cast<std::uint32_t>(kBins), 4 + count / 20);
    const Four extent = hi - lo, number = allFour(static_cast<float>(bins));
    WideBinGrid grid;
    storeFour(lo, grid.lo.data()), storeFour(hi, grid.hi.data());
    storeFour(extent > 0x1p-100f ? number / extent : Four{}, grid.scale.data());
    storeFour(number - 1.0f, grid.last.data());
    return grid;
}

inline WideBinGrid gridOver(const Box& centres, std::uint32_t count) {
    return gridOver(centres.lo, -centres.negHi, count);
}

inline void clear(WideBins& bins, std::uint32_t used) {
    const Box empty = Box::empty();
    for (auto& axis : bins.box)
        for (std::uint32_t b = 0; b < used; ++b) empty.store(axis[b]);
    for (std::uint32_t b = 0; b < used; ++b) bins.count[b].fill(0);
}

// The bins that a box falls into. 16 bytes per bin of counts, twice that per bin of boxes: one
// number addresses both.
inline FourInts placeIn(const WideBinGrid& grid, const Box& p) {
    const Four position =
        (p.twiceCentre() - loadFour(grid.lo.data())) * loadFour(grid.scale.data());
    const Four inside = least(most(position, Four{}), loadFour(grid.last.data()));
    return __builtin_convertvector(inside, FourInts) << 4;
}

inline void addAt(WideBins& bins, std::size_t axis, std::size_t place, const Box& p) {
    auto* const box = reinterpret_cast<std::byte*>(bins.box[axis].data()) + 2 * place;
    Box grown = Box::load(*reinterpret_cast<PrimBox*>(box));
    grown.extend(p);
    grown.store(*reinterpret_cast<PrimBox*>(box));
    auto* const count = reinterpret_cast<std::byte*>(bins.count.data()) + place + 4 * axis;
    ++*reinterpret_cast<std::uint32_t*>(count);
}

inline void add(WideBins& bins, const WideBinGrid& grid, const Box& p) {
    const FourInts at = placeIn(grid, p);
    for (std::size_t axis = 0; axis < 3; ++axis)
        addAt(bins, axis, static_cast<std::uint32_t>(at[axis]), p);
}

// First all places, then all bins: a bin that is read waits for every store before it whose address
// isn't known yet, since it may be the same bin.
constexpr std::uint32_t kBlock = 256;
inline void addBlock(WideBins& bins, const WideBinGrid& grid, const PrimBox* from,
                     std::uint32_t count) {
    FourInts places[kBlock];
    for (std::uint32_t i = 0; i < count; ++i) places[i] = placeIn(grid, Box::load(from[i]));
    for (std::uint32_t i = 0; i < count; ++i) {
        const Box p = Box::load(from[i]);
        for (std::size_t axis = 0; axis < 3; ++axis)
            addAt(bins, axis, static_cast<std::uint32_t>(places[i][axis]), p);
    }
}

inline FourInts countsOf(const WideBins& bins, std::uint32_t b) {
    FourInts v;
    std::memcpy(&v, bins.count[b].data(), sizeof v);
    return v;
}

// Adds what others have binned in the same grid.
inline void mergeBins(WideBins& to, const WideBins& from, std::uint32_t used) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (std::uint32_t b = 0; b < used; ++b) {
            Box grown = Box::load(to.box[axis][b]);
            grown.extend(Box::load(from.box[axis][b]));
            grown.store(to.box[axis][b]);
        }
    for (std::uint32_t b = 0; b < used; ++b)
        for (std::size_t axis = 0; axis < 3; ++axis) to.count[b][axis] += from.count[b][axis];
}

// The cheapest split between two bins: areas weighted with numbers of triangles.
inline void chooseSplit(BuildRange& r, const WideBins& bins) {
    const std::uint32_t used = r.grid.bins();
    std::array<Four, kBins> rightCost;
    Box x = Box::empty(), y = x, z = x;
    FourInts count{};
    const auto take = [&](std::uint32_t b) {
        x.extend(Box::load(bins.box[0][b]));
        y.extend(Box::load(bins.box[1][b]));
        z.extend(Box::load(bins.box[2][b]));
        count += countsOf(bins, b);
        return halfAreas(x, y, z) * __builtin_convertvector(count, Four);
    };
    for (std::uint32_t b = used - 1; b > 0; --b) rightCost[b] = take(b);
    x = y = z = Box::empty(), count = FourInts{};
    Four leastCost = allFour(std::numeric_limits<float>::infinity()), cut{};
    for (std::uint32_t b = 1; b < used; ++b) {
        const Four cost = take(b - 1) + rightCost[b];
        // Nothing on one side: no split, and its cost is no number.
        const FourInts isSplit = (count != 0) & (count != static_cast<std::int32_t>(r.count));
        const FourInts isBetter = isSplit & (cost < leastCost);
        leastCost = isBetter ? cost : leastCost;
        cut = isBetter ? allFour(static_cast<float>(b)) : cut;
    }
    WideBinSplit& split = r.split;
    split.axis = -1;
    float best = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis)
        if (leastCost[axis] < best) best = leastCost[axis], split.axis = axis;
    if (split.axis < 0) return;
    split.cut = cut[split.axis];
    split.leftCount = 0;
    const auto axis = static_cast<std::size_t>(split.axis);
    Box left = Box::empty(), right = left;
    std::uint32_t b = 0;
    for (; b < static_cast<std::uint32_t>(split.cut); ++b) {
        left.extend(Box::load(bins.box[axis][b]));
        split.leftCount += bins.count[b][axis];
    }
    for (; b < used; ++b) right.extend(Box::load(bins.box[axis][b]));
    left.store(split.left), right.store(split.right);
}

} // namespace kernels::build
