// Lists that a text fills, block by block.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

// Room for `more` things in a list of those that a text says from its byte `first` on. Doubling
// touches memory twice, which for many things costs as much as reading them; the text that those so
// far took, and others between them, `here` bytes from its start, says how many there will be up to
// `last`. Memory that is not touched costs nothing.
template <class List>
void makeRoomByText(List& list, std::size_t more, std::size_t first, std::size_t here,
                    std::size_t last) {
    constexpr std::size_t kMany = 1000;
    constexpr double kMargin = 1.1, kLeast = 1.5, kMost = 256;
    if (list.size() + more <= list.capacity() || list.size() < kMany || here <= first) return;
    const double left = here < last ? static_cast<double>(last - here) : 0;
    const double growth = 1 + kMargin * left / static_cast<double>(here - first);
    const double wanted = static_cast<double>(list.size()) * std::clamp(growth, kLeast, kMost);
    list.reserve(static_cast<std::size_t>(wanted));
}

// One block more, `here` bytes from the start of the text.
template <class Block>
Block& addedByText(std::vector<Block>& blocks, std::size_t here, std::size_t last) {
    if (!blocks.empty()) makeRoomByText(blocks, 1, blocks.front().loc.offset, here, last);
    return blocks.emplace_back();
}
