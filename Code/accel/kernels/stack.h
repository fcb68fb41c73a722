// Stacks of rays that take their steps one by one: the nodes that a ray goes to later, the farthest
// at the bottom, and with them the depths at which it enters them. A stack is as long as its tree
// allows, and 2 W places more: stores write W places whatever they keep.
#pragma once

#include "accel/kernels/wide_tree.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <immintrin.h>
#include <type_traits>

LANES_BEGIN

// An odd number of lines between stacks spreads them over the sets of the cache.
inline std::size_t strideOfStacks(std::size_t mostEntries) {
    return ((mostEntries + std::size_t{2} * W + 15) / 16 | 1) * 16;
}

// Pushes the children in `hit`, of which there are `count`, the farthest first, and returns the
// nearest. Up to four, 97 to 99 of 100 steps where boxes overlap little, by a sorting network of
// their own; more, by the one for W. entries: the depths' bits, the lowest four replaced. Of boxes
// that the ray starts in the last is the nearest, as for rays that any hit ends.
inline WideRef pushSorted(Mask hit, int count, Floats entry, const WideRef* child, WideRef* refs,
                          std::uint32_t* entries) {
    const auto keys = keysOf(hit, entry);
    if (count > 4) [[unlikely]] {
        const auto all = sortedKeys(keys);
        storeKeys(all, entries);
        const auto sorted = pickAll(all, child);
        storeKeys(sorted, refs);
        return element(sorted, count - 1);
    }
    __m128i k = firstFour(keys);
    const auto exchange = [](__m128i x, __m128i y, auto lower) {
        return _mm_castps_si128(_mm_blend_ps(_mm_castsi128_ps(_mm_max_epu32(x, y)),
                                             _mm_castsi128_ps(_mm_min_epu32(x, y)),
                                             decltype(lower)::value));
    };
    k = exchange(k, _mm_shuffle_epi32(k, _MM_SHUFFLE(1, 0, 3, 2)),
                 std::integral_constant<int, 12>());
    k = exchange(k, _mm_shuffle_epi32(k, _MM_SHUFFLE(2, 3, 0, 1)),
                 std::integral_constant<int, 10>());
    const __m128i middle = exchange(k, _mm_shuffle_epi32(k, _MM_SHUFFLE(3, 1, 2, 0)),
                                    std::integral_constant<int, 4>());
    k = _mm_blend_epi16(k, middle, 0x3c);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(entries), k);
    const __m128i sorted = pick(k, child);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(refs), sorted);
    return element(sorted, count - 1);
}

// The same in any order and without depths, for rays that any hit ends.
inline WideRef pushAny(Mask hit, unsigned lanes, const WideRef* child, WideRef* refs) {
    storeChosen(hit, child, refs);
    return child[(static_cast<int>(std::bit_width(lanes)) - 1) & (W - 1)]; // 0: any
}

// Takes out what starts behind zCut >= 0, so that no pop has to look, but not the end of the stack,
// which has entry 0. Returns the new top.
inline std::uint32_t dropHidden(WideRef* refs, std::uint32_t* entries, std::uint32_t top,
                                float zCut) {
    // The lowest four bits of an entry don't count.
    const Ints limit((std::bit_cast<std::uint32_t>(zCut) | 15) + 1);
    std::uint32_t kept = 0;
    for (std::uint32_t k = 0; k < top; k += W) {
        const std::uint32_t left = top - k;
        const unsigned keep =
            bits(Ints::load(entries + k) < limit) & (left < W ? (1u << left) - 1 : ~0u);
        storeChosen(keep, refs + k, refs + kept);
        storeChosen(keep, entries + k, entries + kept);
        kept += static_cast<std::uint32_t>(std::popcount(keep));
    }
    return kept;
}

LANES_END
