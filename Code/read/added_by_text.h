// Lists that a text fills, block by block.
#pragma once

#include "base/large_pages.h"

#include <algorithm>
#include <cstddef>
#include <vector>

// One block more, `here` bytes from the start of a text that ends at `last`. Doubling touches
// memory twice, which for many blocks costs as much as reading them; the text that those so far
// took, and others between them, says how many there will be. Memory that is not touched costs
// nothing.
template <class Block>
Block& addedByText(std::vector<Block>& blocks, std::size_t here, std::size_t last) {
    constexpr std::size_t kMany = 1000;
    constexpr double kMargin = 1.1, kLeast = 1.5, kMost = 256;
    if (blocks.size() == blocks.capacity() && blocks.size() >= kMany) {
        const std::size_t first = blocks.front().loc.offset;
        const double left = here < last ? static_cast<double>(last - here) : 0;
        const double growth = 1 + kMargin * left / static_cast<double>(here - first);
        const double wanted =
            static_cast<double>(blocks.size()) * std::clamp(growth, kLeast, kMost);
        reserveInLargePages(blocks, static_cast<std::size_t>(wanted));
    }
    return blocks.emplace_back();
}
