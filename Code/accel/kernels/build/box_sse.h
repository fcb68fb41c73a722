// A PrimBox in two registers of four lanes.
#pragma once

#include "accel/kernels/build/build.h"
#include "simd/region.h"

#include <cstdint>
#include <immintrin.h>

LANES_BEGIN
namespace build {
using namespace kernels::build;

struct Box {
    __m128 lower, negUpper;
    static Box load(const PrimBox& p) {
        return {_mm_load_ps(p.lo.data()), _mm_load_ps(p.negHi.data())};
    }
    static Box of(__m128 lo, __m128 negHi) { return {lo, negHi}; }
    void store(PrimBox& p) const {
        _mm_store_ps(p.lo.data(), lower), _mm_store_ps(p.negHi.data(), negUpper);
    }
    void extend(Box b) {
        lower = _mm_min_ps(lower, b.lower), negUpper = _mm_min_ps(negUpper, b.negUpper);
    }
    __m128 lo() const { return lower; }
    __m128 negHi() const { return negUpper; }
};

// W numbers in registers.
template <int W> struct NumberSet {
    __m128i lanes[W / 4];
    void fill(std::uint32_t x) {
        for (auto& l : lanes) l = _mm_set1_epi32(static_cast<int>(x));
    }
    // One bit per lane that has x.
    unsigned find(std::uint32_t x) const {
        const __m128i wanted = _mm_set1_epi32(static_cast<int>(x));
        unsigned bits = 0;
        for (int i = 0; i < W / 8; ++i)
            bits |= static_cast<unsigned>(_mm_movemask_epi8(
                        _mm_packs_epi16(_mm_packs_epi32(_mm_cmpeq_epi32(lanes[2 * i], wanted),
                                                        _mm_cmpeq_epi32(lanes[2 * i + 1], wanted)),
                                        _mm_setzero_si128())))
                    << (8 * i);
        return bits;
    }
    // Into lane `at`; nowhere when there is none.
    void put(std::uint32_t x, std::uint32_t at) {
        const __m128i value = _mm_set1_epi32(static_cast<int>(x));
        const __m128i place = _mm_set1_epi32(static_cast<int>(at));
        for (int i = 0; i < W / 4; ++i) {
            const __m128i lane = _mm_setr_epi32(4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 3);
            lanes[i] = _mm_blendv_epi8(lanes[i], value, _mm_cmpeq_epi32(lane, place));
        }
    }
    void store(std::uint32_t* to) const {
        for (int i = 0; i < W / 4; ++i)
            _mm_storeu_si128(reinterpret_cast<__m128i*>(to + 4 * i), lanes[i]);
    }
};

} // namespace build
LANES_END
