// Bytes to pack.
#pragma once

#include <cstdint>
#include <vector>

using Buffer = std::vector<std::uint8_t>;

inline std::uint32_t nextRandom(std::uint32_t& state) { // Numerical Recipes
    state = state * 1664525u + 1013904223u;
    return state >> 8;
}
