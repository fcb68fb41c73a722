// Sobol pairs along the Z-order of a picture, for numbers or for registers of them: one sequence
// goes through all pixels, so that the samples of every square of 2^k pixels are spread together,
// and the errors of neighbours cancel (Ahmed and Wonka, "Screen-space blue-noise diffusion of Monte
// Carlo sampling error via hierarchical ordering of pixels", 2020).
#pragma once

#include "sample/hash.h"
#include "sample/sobol.h"
#include "sample/z_order.h"

LANES_BEGIN

// A hash of 32 bits to 32 bits: the finaliser lowbias32 of Wellons, "Prospecting for Hash
// Functions" (2018).
template <class Bits> constexpr Bits mixed32(Bits x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

// A digit from 0 to 3 after one of the 24 permutations, which the hash chooses. They are the affine
// maps of two bits: the images of 1 and 2, which are two numbers that are neither 0 nor equal, and
// what is added.
template <class Bits> constexpr Bits permutedDigit(Bits digit, Bits hash) {
    const Bits one = (((hash >> 16) * 3u) >> 16) + 1u;
    const Bits other = 1u + (one & ~(one >> 1) & 1u); // 2 if `one` is 1, else 1
    const Bits two = other ^ (one & (0u - ((hash >> 2) & 1u)));
    return (hash & 3u) ^ (one & (0u - (digit & 1u))) ^ (two & (0u - (digit >> 1)));
}

// The number of a pixel's first sample: its place in the Z-order, every digit of which is permuted
// by a hash of the digits above it, times 2^sampleBits. What leaves the 32 bits is the same for all
// pixels whose samples have room in them.
template <class Bits> constexpr Bits firstSample(Bits zNumber, const ZOrder& order) {
    Bits first = zNumber & 0u;
    for (int shift = 0; shift < 32 - order.sampleBits; shift += 2) {
        const Bits digits = zNumber >> shift;
        const std::uint32_t level = order.seed + static_cast<std::uint32_t>(shift) * 0x9e3779b9u;
        first |= permutedDigit<Bits>(digits & 3u, mixed32<Bits>((digits >> 2) ^ level)) << shift;
    }
    return first << order.sampleBits;
}

// The pair of a sample; each pixel takes its samples in an order of its own, without which the
// upper bits of all dimensions would be the same.
template <class Bits>
constexpr Pair<Bits> zSobolPair(Bits sample, Bits first, Bits b, Bits c, int sampleBits) {
    const std::uint32_t mask = static_cast<std::uint32_t>((std::uint64_t{1} << sampleBits) - 1);
    const Bits shuffled = reversed(scrambledReversed(reversed(sample), mixed32<Bits>(first ^ b)));
    return scrambledPair<Bits>(first | (shuffled & mask), b, c);
}

LANES_END
