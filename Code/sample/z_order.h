// Numbers of pixels along the Z-order (Morton's), and what the samplers of the kind ZSobol make of
// them.
#pragma once

#include <cstdint>

// 16 bits to the even ones of 32.
constexpr std::uint32_t spreadBits(std::uint32_t x) {
    x = (x | x << 8) & 0x00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0fu;
    x = (x | x << 2) & 0x33333333u;
    return (x | x << 1) & 0x55555555u;
}
// Returns the place in the Z-order of a pixel below 2^16 both ways.
constexpr std::uint32_t zNumber(std::uint32_t x, std::uint32_t y) {
    return spreadBits(x) | spreadBits(y) << 1;
}

// How a sampler numbers the samples of all pixels for a pair of dimensions: by the Z-order of the
// pixels, shuffled by `seed`, and 2^sampleBits samples for each. x and y scramble their pairs.
struct ZOrder {
    std::uint32_t seed, x, y;
    int sampleBits;
};
