// How 8 lanes of AVX2 move: see avx512_moves.h.
#pragma once

#include "simd/avx2.h"
#include "simd/gather_by_hand.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <immintrin.h>
#include <type_traits>

LANES_BEGIN

template <class Fn> [[gnu::always_inline]] inline Ints loadWords(const Fn& at) {
    return _mm256_set_m128i(fourWords(at, 4), fourWords(at, 0));
}
template <class Fn>
[[gnu::always_inline]] inline void loadPairs(const Fn& at, Floats& first, Floats& second) {
    const FourPairs low(at, 0), high(at, 4);
    first = _mm256_set_m128(high.first, low.first);
    second = _mm256_set_m128(high.second, low.second);
}
inline void storePairs(Floats a, Ints b, float* to) {
    const __m256 other = _mm256_castsi256_ps(b.v);
    const __m256 low = _mm256_unpacklo_ps(a.v, other), high = _mm256_unpackhi_ps(a.v, other);
    _mm256_storeu_ps(to, _mm256_permute2f128_ps(low, high, 0x20));
    _mm256_storeu_ps(to + 8, _mm256_permute2f128_ps(low, high, 0x31));
}

inline void storeRows(Floats a, Floats b, Floats c, Ints d, Ints e, float* to) {
    const __m256 other = _mm256_castsi256_ps(d.v);
    const __m256d abLow = _mm256_castps_pd(_mm256_unpacklo_ps(a.v, b.v));
    const __m256d abHigh = _mm256_castps_pd(_mm256_unpackhi_ps(a.v, b.v));
    const __m256d cdLow = _mm256_castps_pd(_mm256_unpacklo_ps(c.v, other));
    const __m256d cdHigh = _mm256_castps_pd(_mm256_unpackhi_ps(c.v, other));
    const __m256 rows[4] = {_mm256_castpd_ps(_mm256_unpacklo_pd(abLow, cdLow)), // rows 0 and 4
                            _mm256_castpd_ps(_mm256_unpackhi_pd(abLow, cdLow)),
                            _mm256_castpd_ps(_mm256_unpacklo_pd(abHigh, cdHigh)),
                            _mm256_castpd_ps(_mm256_unpackhi_pd(abHigh, cdHigh))};
    alignas(32) float fifth[W];
    Floats(_mm256_castsi256_ps(e.v)).store(fifth);
    for (int i = 0; i < 4; ++i) {
        _mm_storeu_ps(to + 5 * i, _mm256_castps256_ps128(rows[i]));
        _mm_storeu_ps(to + 5 * (i + 4), _mm256_extractf128_ps(rows[i], 1));
    }
    for (int i = 0; i < W; ++i) to[5 * i + 4] = fifth[i];
}

// Which lanes a mask chooses, in order, and behind them the others.
inline constexpr auto kChosenLanes = [] {
    std::array<std::array<std::uint8_t, 8>, 256> table{};
    for (unsigned mask = 0; mask < 256; ++mask) {
        std::size_t chosen = 0, other = static_cast<std::size_t>(std::popcount(mask));
        for (unsigned lane = 0; lane < 8; ++lane)
            table[mask][(mask >> lane & 1) != 0 ? chosen++ : other++] =
                static_cast<std::uint8_t>(lane);
    }
    return table;
}();
// AVX2 has no compress: a table says for every mask which lane goes where.
inline __m256i chosenLanes(unsigned chosen) {
    return _mm256_cvtepu8_epi32(
        _mm_loadl_epi64(reinterpret_cast<const __m128i*>(kChosenLanes[chosen].data())));
}
inline void storeChosen(unsigned chosen, Ints from, std::uint32_t* to) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to),
                        _mm256_permutevar8x32_epi32(from.v, chosenLanes(chosen)));
}
inline void storeChosen(unsigned chosen, const std::uint32_t* from, std::uint32_t* to) {
    storeChosen(chosen, Ints::load(from), to);
}
inline void storeChosen(Mask chosen, const std::uint32_t* from, std::uint32_t* to) {
    storeChosen(bits(chosen), from, to);
}
inline __m256i keysOf(Mask lanes, Floats a) {
    const __m256i last = _mm256_setr_epi32(7, 6, 5, 4, 3, 2, 1, 0);
    const __m256i keys =
        _mm256_or_si256(_mm256_andnot_si256(_mm256_set1_epi32(15), _mm256_castps_si256(a.v)), last);
    return _mm256_permutevar8x32_epi32(_mm256_and_si256(keys, _mm256_castps_si256(lanes.v)),
                                       chosenLanes(bits(lanes)));
}
inline __m128i firstFour(__m256i keys) { return _mm256_castsi256_si128(keys); }
inline void storeKeys(__m256i keys, std::uint32_t* to) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), keys);
}
inline __m128i pick(__m128i keys, const std::uint32_t* from) {
    const __m256i all = _mm256_load_si256(reinterpret_cast<const __m256i*>(from));
    const __m128i lanes = _mm_xor_si128(keys, _mm_set1_epi32(W - 1));
    return _mm256_castsi256_si128(_mm256_permutevar8x32_epi32(all, _mm256_castsi128_si256(lanes)));
}
inline std::uint32_t element(__m128i four, int i) {
    return static_cast<std::uint32_t>(_mm_cvtsi128_si32(
        _mm_castps_si128(_mm_permutevar_ps(_mm_castsi128_ps(four), _mm_cvtsi32_si128(i)))));
}

// Keys in descending order; see avx512_moves.h.
inline __m256i sortedKeys(__m256i k) {
    const auto exchange = [&](__m256i other, auto smaller) {
        k = _mm256_blend_epi32(_mm256_max_epu32(k, other), _mm256_min_epu32(k, other),
                               decltype(smaller)::value);
    };
    const auto apart1 = [&] { return _mm256_shuffle_epi32(k, _MM_SHUFFLE(2, 3, 0, 1)); };
    const auto apart2 = [&] { return _mm256_shuffle_epi32(k, _MM_SHUFFLE(1, 0, 3, 2)); };
    const auto apart4 = [&] { return _mm256_permute2x128_si256(k, k, 1); };
    exchange(apart1(), std::integral_constant<int, 0x66>());
    exchange(apart2(), std::integral_constant<int, 0x3c>());
    exchange(apart1(), std::integral_constant<int, 0x5a>());
    exchange(apart4(), std::integral_constant<int, 0xf0>());
    exchange(apart2(), std::integral_constant<int, 0xcc>());
    exchange(apart1(), std::integral_constant<int, 0xaa>());
    return k;
}
inline __m256i pickAll(__m256i keys, const std::uint32_t* from) {
    const __m256i lanes = _mm256_xor_si256(keys, _mm256_set1_epi32(W - 1));
    return _mm256_permutevar8x32_epi32(_mm256_load_si256(reinterpret_cast<const __m256i*>(from)),
                                       lanes);
}
inline std::uint32_t element(__m256i all, int i) {
    return static_cast<std::uint32_t>(
        _mm256_cvtsi256_si32(_mm256_permutevar8x32_epi32(all, _mm256_set1_epi32(i))));
}

// --- chosen lanes ---

// There is room for all lanes behind `to`.
inline Floats packed(unsigned chosen, Floats a) {
    return chosen == (1u << W) - 1 ? a : _mm256_permutevar8x32_ps(a.v, chosenLanes(chosen));
}
inline void storeChosenFloats(unsigned chosen, Floats a, float* to) {
    _mm256_storeu_ps(to, packed(chosen, a).v);
}
inline void storeChosenVectors(unsigned chosen, Floats x, Floats y, Floats z, float* to) {
    const __m256 a = packed(chosen, x).v, b = packed(chosen, y).v, c = packed(chosen, z).v;
    // In each half: x0 x2 y0 y2, y1 y3 z1 z3, z0 z2 x1 x3.
    const __m256 even = _mm256_shuffle_ps(a, b, 0x88), odd = _mm256_shuffle_ps(b, c, 0xdd),
                 rest = _mm256_shuffle_ps(c, a, 0xd8);
    const __m256 first = _mm256_shuffle_ps(even, rest, 0x88), // x0 y0 z0 x1
        second = _mm256_shuffle_ps(odd, even, 0xd8),          // y1 z1 x2 y2
        third = _mm256_shuffle_ps(rest, odd, 0xdd);           // z2 x3 y3 z3
    _mm256_storeu_ps(to, _mm256_permute2f128_ps(first, second, 0x20));
    _mm256_storeu_ps(to + W, _mm256_permute2f128_ps(third, first, 0x30));
    _mm256_storeu_ps(to + 2 * W, _mm256_permute2f128_ps(second, third, 0x31));
}
inline unsigned spread(unsigned lowest, unsigned places) { return _pdep_u32(lowest, places); }

// --- columns of rows ---

inline constexpr bool kPairsPay = true;

inline void loadRows(const float* const (&row)[W], Floats (&column)[4]) {
    const auto rowsFrom = [&](int first) -> __m256 { // row 4 i + first in half i
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(row[first])),
                                    _mm_loadu_ps(row[4 + first]), 1);
    };
    const __m256 a = rowsFrom(0), b = rowsFrom(1), c = rowsFrom(2), d = rowsFrom(3);
    const auto low = [&](__m256 x, __m256 y) -> __m256d {
        return _mm256_castps_pd(_mm256_unpacklo_ps(x, y));
    };
    const auto high = [&](__m256 x, __m256 y) -> __m256d {
        return _mm256_castps_pd(_mm256_unpackhi_ps(x, y));
    };
    column[0] = _mm256_castpd_ps(_mm256_unpacklo_pd(low(a, b), low(c, d)));
    column[1] = _mm256_castpd_ps(_mm256_unpackhi_pd(low(a, b), low(c, d)));
    column[2] = _mm256_castpd_ps(_mm256_unpacklo_pd(high(a, b), high(c, d)));
    column[3] = _mm256_castpd_ps(_mm256_unpackhi_pd(high(a, b), high(c, d)));
}

template <int Bit, class Node> inline unsigned kindBits(const Node& node) {
    const __m256i top = _mm256_slli_epi32(Ints::load(node.child).v, 31 - Bit);
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(top)));
}

inline void storeRows(const double* const (&row)[W], double (*column)[W]) {
    for (int half = 0; half < 2; ++half) {
        const auto at = [&](int i) -> __m256d { return _mm256_loadu_pd(row[4 * half + i]); };
        const __m256d a = at(0), b = at(1), c = at(2), d = at(3);
        const __m256d even[2] = {_mm256_unpacklo_pd(a, b), _mm256_unpacklo_pd(c, d)},
                      odd[2] = {_mm256_unpackhi_pd(a, b), _mm256_unpackhi_pd(c, d)};
        const __m256d columns[4] = {_mm256_permute2f128_pd(even[0], even[1], 0x20),
                                    _mm256_permute2f128_pd(odd[0], odd[1], 0x20),
                                    _mm256_permute2f128_pd(even[0], even[1], 0x31),
                                    _mm256_permute2f128_pd(odd[0], odd[1], 0x31)};
        for (int i = 0; i < 4; ++i) _mm256_store_pd(column[i] + 4 * half, columns[i]);
    }
}

class LaneColumns {
public:
    LaneColumns() : columns_(_mm256_setzero_si256()) {}
    void set(int row, Mask columns) {
        const __m256i bit = _mm256_set1_epi32(static_cast<int>(1u << row));
        columns_ = _mm256_or_si256(columns_, _mm256_and_si256(_mm256_castps_si256(columns.v), bit));
    }
    void store(std::uint32_t* to) const {
        _mm256_store_si256(reinterpret_cast<__m256i*>(to), columns_);
    }

private:
    __m256i columns_;
};

// --- look-ups in tables ---

inline Doubles floor(const Doubles& a) { return {_mm256_floor_pd(a.lo), _mm256_floor_pd(a.hi)}; }
inline Ints wholeOf(const Doubles& a) {
    return _mm256_inserti128_si256(_mm256_castsi128_si256(_mm256_cvttpd_epi32(a.lo)),
                                   _mm256_cvttpd_epi32(a.hi), 1);
}
inline __m128i upperHalf(Ints a) { return _mm256_extracti128_si256(a.v, 1); }
inline Doubles doublesOf(Ints a) {
    return {_mm256_cvtepi32_pd(_mm256_castsi256_si128(a.v)), _mm256_cvtepi32_pd(upperHalf(a))};
}
inline Ints byteOf(Ints a, int i) {
    return _mm256_and_si256(_mm256_srl_epi32(a.v, _mm_cvtsi32_si128(8 * i)),
                            _mm256_set1_epi32(255));
}
inline Ints fourBytesAt(const std::uint8_t* from, Ints offset) {
    const NumbersInMemory at(offset);
    return loadWords([&](std::size_t i) { return from + at[i]; });
}
inline Ints elementsAt(const std::uint32_t* table, Ints i, unsigned chosen) {
    return _mm256_mask_i32gather_epi32(_mm256_setzero_si256(),
                                       static_cast<const int*>(static_cast<const void*>(table)),
                                       i.v, _mm256_castps_si256(maskOf(chosen).v), 4);
}
template <int kStride>
[[gnu::always_inline]] inline void pairsAt(const double* rows, Ints i, Doubles& first,
                                           Doubles& second) {
    const NumbersInMemory at(i);
    const TwoRows a(rows, at, 0, kStride), b(rows, at, 2, kStride), c(rows, at, 4, kStride),
        d(rows, at, 6, kStride);
    first = {_mm256_set_m128d(b.first, a.first), _mm256_set_m128d(d.first, c.first)};
    second = {_mm256_set_m128d(b.second, a.second), _mm256_set_m128d(d.second, c.second)};
}

// --- bits of powers ---

inline Ints bitsOf(Floats a) { return _mm256_castps_si256(a.v); }
inline Floats fromBits(Ints a) { return _mm256_castsi256_ps(a.v); }
inline Ints plus(Ints a, std::uint32_t b) { return _mm256_add_epi32(a.v, Ints(b).v); }
inline Ints masked(Ints a, std::uint32_t b) { return _mm256_and_si256(a.v, Ints(b).v); }
template <int kBits> Ints shiftedRight(Ints a) { return _mm256_srai_epi32(a.v, kBits); }
inline Doubles powersOfTwo(Ints k) {
    const auto half = [&](__m128i exponent) {
        return _mm256_castsi256_pd(_mm256_slli_epi64(_mm256_cvtepi32_epi64(exponent), 52));
    };
    const Ints biased = plus(k, 1023);
    return {half(_mm256_castsi256_si128(biased.v)), half(_mm256_extracti128_si256(biased.v, 1))};
}

// --- bits of Sobol numbers ---

inline constexpr std::size_t kSobolLanes = 8;

// --- lanes of two in turn ---

inline Floats lowInTurn(Floats a, Floats b) {
    const __m256 low = _mm256_unpacklo_ps(a.v, b.v), high = _mm256_unpackhi_ps(a.v, b.v);
    return _mm256_permute2f128_ps(low, high, 0x20);
}
inline Floats highInTurn(Floats a, Floats b) {
    const __m256 low = _mm256_unpacklo_ps(a.v, b.v), high = _mm256_unpackhi_ps(a.v, b.v);
    return _mm256_permute2f128_ps(low, high, 0x31);
}

LANES_END
