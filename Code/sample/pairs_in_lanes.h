// Sampler::pairSeeds() and the pairs that they lead to, for as many pixels and samples as the
// compiler's registers have room for.
#pragma once

#include "sample/hash.h"
#include "sample/pair_block.h"
#include "sample/sobol.h"
#include "sample/z_order.h"
#include "sample/zsobol.h"
#include "simd/lanes.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

LANES_BEGIN

using Bits __attribute__((vector_size(4 * kSobolLanes))) = std::uint32_t;
using SignedBits __attribute__((vector_size(4 * kSobolLanes))) = std::int32_t;
using UnitFloats __attribute__((vector_size(4 * kSobolLanes))) = float;

inline Bits loadBits(const std::uint32_t* from) {
    Bits all;
    std::memcpy(&all, from, sizeof all);
    return all;
}
// unitFloat(): 24 bits fit into a signed number, which lanes can convert.
inline void storeUnit(const Bits& all, float* to) {
    const Bits upper = all >> 8;
    SignedBits number;
    std::memcpy(&number, &upper, sizeof number);
    const UnitFloats unit = __builtin_convertvector(number, UnitFloats) * 0x1p-24f;
    std::memcpy(to, &unit, sizeof unit);
}

using Longs __attribute__((vector_size(sizeof(Bits)))) = std::uint64_t;
inline constexpr std::uint64_t kLow32 = 0xffffffffu;

// mixBits() and hash() of sample/hash.h for lanes.
inline Longs mixed(Longs x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}
inline Longs hashed(std::uint32_t seed, Longs pixel, std::uint32_t dimension) {
    const Longs both = mixed((pixel | std::uint64_t{seed} << 32) + kHashStep);
    return mixed(both + hashStepOf(dimension));
}

// Stores the seeds of each pixel, of a sampler of that seed; the pixels are a multiple of 16.
inline void pairSeeds(std::uint32_t seed, std::uint32_t dimension,
                      std::span<const std::uint32_t> pixels, const PairSeedColumns& out) {
    for (std::size_t i = 0; i < pixels.size(); i += kSobolLanes) {
        const auto store = [&](const Longs& all, std::uint32_t* to) {
            std::memcpy(to + i, &all, sizeof(all));
        };
        Longs both;
        std::memcpy(&both, &pixels[i], sizeof(both));
        // Every other pixel is the lower half of a lane.
        const Longs even = hashed(seed, both & kLow32, dimension),
                    odd = hashed(seed, both >> 32, dimension);
        store((even & kLow32) | odd << 32, out.index);
        store(even >> 32 | (odd & ~kLow32), out.x);
        store((mixed(even + kHashStep) & kLow32) | mixed(odd + kHashStep) << 32, out.y);
    }
}

// The same of a sampler of the kind ZSobol, for one pair of dimensions.
inline void zPairSeeds(const ZOrder& order, std::span<const std::uint32_t> pixels,
                       const PairSeedColumns& out) {
    for (std::size_t i = 0; i < pixels.size(); i += kSobolLanes) {
        const Bits first = firstSample<Bits>(loadBits(&pixels[i]), order);
        std::memcpy(out.index + i, &first, sizeof first);
    }
    std::fill_n(out.x, pixels.size(), order.x);
    std::fill_n(out.y, pixels.size(), order.y);
}

// Draws the first `count` pairs of a block, a multiple of 16, by pairOf(sample, index, x, y).
template <class PairFn>
inline void drawPairs(PairBlock& block, std::size_t count, const PairFn& pairOf) {
    for (std::size_t i = 0; i < count; i += kSobolLanes) {
        const auto pair = pairOf(loadBits(block.sample + i), loadBits(block.index + i),
                                 loadBits(block.x + i), loadBits(block.y + i));
        storeUnit(pair.x, block.u + i), storeUnit(pair.y, block.v + i);
    }
}
inline void sobolPairs(PairBlock& block, std::size_t count) {
    drawPairs(block, count, [](const Bits& sample, const Bits& index, const Bits& x,
                               const Bits& y) { return sobolPair<Bits>(sample, index, x, y); });
}
inline void zSobolPairs(PairBlock& block, std::size_t count, int sampleBits) {
    drawPairs(block, count,
              [&](const Bits& sample, const Bits& index, const Bits& x, const Bits& y) {
                  return zSobolPair<Bits>(sample, index, x, y, sampleBits);
              });
}

LANES_END
