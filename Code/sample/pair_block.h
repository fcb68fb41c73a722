// Pairs of random numbers by the register: what lanes read and write. Knows numbers only.
#pragma once

#include <cstddef>
#include <cstdint>

// Pixels, numbers of samples, what their pairs are shuffled and scrambled by, and the pairs.
struct alignas(64) PairBlock {
    static constexpr std::size_t kPairs = 64;
    std::uint32_t pixel[kPairs], sample[kPairs], index[kPairs], x[kPairs], y[kPairs];
    float u[kPairs], v[kPairs];
};

// Where Sampler::pairSeeds() of pixels are stored.
struct PairSeedColumns {
    std::uint32_t *index, *x, *y;
};
