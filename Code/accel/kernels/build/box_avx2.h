// A PrimBox in one register of eight lanes.
#pragma once

#include "accel/kernels/build/build.h"
#include "simd/region.h"

#include <cstdint>
#include <immintrin.h>

LANES_BEGIN
namespace build {
using namespace kernels::build;

struct Box {
    __m256 lanes;
    static Box load(const PrimBox& p) { return {_mm256_load_ps(p.lo.data())}; }
    static Box of(__m128 lo, __m128 negHi) { return {_mm256_set_m128(negHi, lo)}; }
    void store(PrimBox& p) const { _mm256_store_ps(p.lo.data(), lanes); }
    void extend(Box b) { lanes = _mm256_min_ps(lanes, b.lanes); }
    __m128 lo() const { return _mm256_castps256_ps128(lanes); }
    __m128 negHi() const { return _mm256_extractf128_ps(lanes, 1); }
};

// W numbers in registers.
template <int W> struct NumberSet {
    __m256i lanes[W / 8];
    void fill(std::uint32_t x) {
        for (auto& l : lanes) l = _mm256_set1_epi32(static_cast<int>(x));
    }
    // One bit per lane that has x.
    unsigned find(std::uint32_t x) const {
        const __m256i wanted = _mm256_set1_epi32(static_cast<int>(x));
        unsigned bits = 0;
        for (int i = 0; i < W / 8; ++i)
            bits |= static_cast<unsigned>(_mm256_movemask_ps(
                        _mm256_castsi256_ps(_mm256_cmpeq_epi32(lanes[i], wanted))))
                    << (8 * i);
        return bits;
    }
    // Into lane `at`; nowhere when there is none.
    void put(std::uint32_t x, std::uint32_t at) {
        const __m256i value = _mm256_set1_epi32(static_cast<int>(x));
        const __m256i place = _mm256_set1_epi32(static_cast<int>(at));
        for (int i = 0; i < W / 8; ++i) {
            const __m256i lane = _mm256_add_epi32(_mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7),
                                                  _mm256_set1_epi32(8 * i));
            lanes[i] = _mm256_blendv_epi8(lanes[i], value, _mm256_cmpeq_epi32(lane, place));
        }
    }
    void store(std::uint32_t* to) const {
        for (int i = 0; i < W / 8; ++i)
            _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + 8 * i), lanes[i]);
    }
};

} // namespace build
LANES_END
