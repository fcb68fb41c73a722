// How 16 lanes of AVX-512 come from memory and go there, are sorted, packed, looked up in tables
// and taken as bits. Its siblings sse_moves.h and avx2_moves.h define the same names.
#pragma once

#include "simd/avx512.h"
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

inline Floats joined(__m128 a, __m128 b, __m128 c, __m128 d) {
    const __m256 low = _mm256_set_m128(b, a), high = _mm256_set_m128(d, c);
    return _mm512_insertf32x8(_mm512_castps256_ps512(low), high, 1);
}
// W times four bytes, of which number i lies at at(i).
template <class Fn> [[gnu::always_inline]] inline Ints loadWords(const Fn& at) {
    const __m256i low = _mm256_set_m128i(fourWords(at, 4), fourWords(at, 0));
    const __m256i high = _mm256_set_m128i(fourWords(at, 12), fourWords(at, 8));
    return _mm512_inserti64x4(_mm512_castsi256_si512(low), high, 1);
}
// W pairs, of which number i lies at at(i).
template <class Fn>
[[gnu::always_inline]] inline void loadPairs(const Fn& at, Floats& first, Floats& second) {
    const FourPairs a(at, 0), b(at, 4), c(at, 8), d(at, 12);
    first = joined(a.first, b.first, c.first, d.first);
    second = joined(a.second, b.second, c.second, d.second);
}
// W pairs (a, b) that follow each other.
inline void storePairs(Floats a, Ints b, float* to) {
    const __m512 other = _mm512_castsi512_ps(b.v);
    const __m512i low = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    const __m512i high = _mm512_add_epi32(low, _mm512_set1_epi32(8));
    _mm512_storeu_ps(to, _mm512_permutex2var_ps(a.v, low, other));
    _mm512_storeu_ps(to + 16, _mm512_permutex2var_ps(a.v, high, other));
}

// W rows (a, b, c, d, e) that follow each other. Register r starts with element 16 r, which is in
// row 16 r / 5 and column r.
inline void storeRows(Floats a, Floats b, Floats c, Ints d, Ints e, float* to) {
    alignas(64) static constexpr auto kRow = [] {
        std::array<std::array<std::uint32_t, W>, 5> rows{};
        for (std::uint32_t i = 0; i < 5 * W; ++i) rows[i / W][i % W] = i / 5;
        return rows;
    }();
    constexpr __mmask16 kEveryFifth[5] = {0x8421, 0x0842, 0x1084, 0x2108, 0x4210}; // from lane i
    const __m512 column[5] = {a.v, b.v, c.v, _mm512_castsi512_ps(d.v), _mm512_castsi512_ps(e.v)};
    for (std::size_t r = 0; r < 5; ++r) {
        const __m512i row = _mm512_load_si512(kRow[r].data());
        __m512 elements = _mm512_permutexvar_ps(row, column[r]);
        for (std::size_t i = 1; i < 5; ++i)
            elements =
                _mm512_mask_permutexvar_ps(elements, kEveryFifth[i], row, column[(r + i) % 5]);
        _mm512_storeu_ps(to + r * W, elements);
    }
}

// Writes the chosen lanes one after the other; what follows them is overwritten too.
inline void storeChosen(Mask chosen, const std::uint32_t* from, std::uint32_t* to) {
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(chosen.v, _mm512_load_si512(from)));
}
inline void storeChosen(unsigned chosen, Ints from, std::uint32_t* to) {
    _mm512_storeu_si512(to, _mm512_maskz_compress_epi32(static_cast<__mmask16>(chosen), from.v));
}
inline void storeChosen(unsigned chosen, const std::uint32_t* from, std::uint32_t* to) {
    storeChosen(chosen, Ints::load(from), to);
}
// Bits of the chosen numbers (not negative), in the lowest four how many lanes come behind; zeros
// follow. They sort like the numbers, of equal ones the last first.
inline __m512i keysOf(Mask chosen, Floats a) {
    const __m512i lane = _mm512_setr_epi32(15, 14, 13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0);
    const __m512i keys =
        _mm512_or_si512(_mm512_andnot_si512(_mm512_set1_epi32(15), _mm512_castps_si512(a.v)), lane);
    return _mm512_maskz_compress_epi32(chosen.v, keys);
}
inline __m128i firstFour(__m512i keys) { return _mm512_castsi512_si128(keys); }
inline void storeKeys(__m512i keys, std::uint32_t* to) { _mm512_storeu_si512(to, keys); }
inline __m128i pick(__m128i keys, const std::uint32_t* from) {
    const __m128i lanes = _mm_xor_si128(keys, _mm_set1_epi32(W - 1));
    return _mm512_castsi512_si128(
        _mm512_permutexvar_epi32(_mm512_castsi128_si512(lanes), _mm512_load_si512(from)));
}
// Element i, 0 to 3.
inline std::uint32_t element(__m128i four, int i) {
    return static_cast<std::uint32_t>(_mm_cvtsi128_si32(
        _mm_castps_si128(_mm_permutevar_ps(_mm_castsi128_ps(four), _mm_cvtsi32_si128(i)))));
}

// Keys in descending order: Batcher's bitonic sort (1968), step by step exchanged with the lane
// that is `apart`.
inline __m512i sortedKeys(__m512i k) {
    const auto exchange = [&](__m512i other, unsigned smaller) {
        k = _mm512_mask_min_epu32(_mm512_max_epu32(k, other), static_cast<__mmask16>(smaller), k,
                                  other);
    };
    const auto apart1 = [&] { return _mm512_shuffle_epi32(k, _MM_PERM_CDAB); };
    const auto apart2 = [&] { return _mm512_shuffle_epi32(k, _MM_PERM_BADC); };
    const auto apart4 = [&] { return _mm512_shuffle_i32x4(k, k, _MM_SHUFFLE(2, 3, 0, 1)); };
    const auto apart8 = [&] { return _mm512_shuffle_i32x4(k, k, _MM_SHUFFLE(1, 0, 3, 2)); };
    exchange(apart1(), 0x6666);
    exchange(apart2(), 0x3c3c), exchange(apart1(), 0x5a5a);
    exchange(apart4(), 0x0ff0), exchange(apart2(), 0x33cc), exchange(apart1(), 0x55aa);
    exchange(apart8(), 0xff00), exchange(apart4(), 0xf0f0), exchange(apart2(), 0xcccc);
    exchange(apart1(), 0xaaaa);
    return k;
}
inline __m512i pickAll(__m512i keys, const std::uint32_t* from) {
    const __m512i lanes = _mm512_xor_si512(keys, _mm512_set1_epi32(W - 1));
    return _mm512_permutexvar_epi32(lanes, _mm512_load_si512(from));
}
inline std::uint32_t element(__m512i all, int i) {
    return static_cast<std::uint32_t>(_mm_cvtsi128_si32(
        _mm512_castsi512_si128(_mm512_permutexvar_epi32(_mm512_set1_epi32(i), all))));
}

// --- chosen lanes ---

inline void storeChosenFloats(unsigned chosen, Floats a, float* to) {
    _mm512_storeu_ps(to, _mm512_maskz_compress_ps(static_cast<__mmask16>(chosen), a.v));
}
// Of vectors. Register r starts with element 16 r, which is in lane 16 r / 3.
inline void storeChosenVectors(unsigned chosen, Floats x, Floats y, Floats z, float* to) {
    alignas(64) static constexpr auto kLane = [] {
        std::array<std::array<std::uint32_t, W>, 3> lanes{};
        for (std::uint32_t i = 0; i < 3 * W; ++i) lanes[i / W][i % W] = i / 3;
        return lanes;
    }();
    constexpr __mmask16 kEveryThird[3] = {0x9249, 0x2492, 0x4924}; // from lane i
    const auto packed = [&](Floats a) {
        return _mm512_maskz_compress_ps(static_cast<__mmask16>(chosen), a.v);
    };
    const __m512 axis[3] = {packed(x), packed(y), packed(z)};
    for (std::size_t r = 0; r < 3; ++r) {
        const __m512i lane = _mm512_load_si512(kLane[r].data());
        // Element 16 r + i is of axis (r + i) % 3.
        __m512 elements = _mm512_permutexvar_ps(lane, axis[r]);
        for (std::size_t i = 1; i < 3; ++i)
            elements =
                _mm512_mask_permutexvar_ps(elements, kEveryThird[i], lane, axis[(r + i) % 3]);
        _mm512_storeu_ps(to + r * W, elements);
    }
}
// The lowest bits, in order, to where bits of `places` are.
inline unsigned spread(unsigned lowest, unsigned places) { return _pdep_u32(lowest, places); }

// --- columns of rows ---

inline constexpr bool kPairsPay = true; // see accel/kernels/solids_pairs.h

// Four numbers that follow each other at row[i], in lane i of four registers.
inline void loadRows(const float* const (&row)[W], Floats (&column)[4]) {
    const auto rowsFrom = [&](int first) -> __m512 { // row 4 i + first in quarter i
        __m512 rows = _mm512_castps128_ps512(_mm_loadu_ps(row[first]));
        rows = _mm512_insertf32x4(rows, _mm_loadu_ps(row[4 + first]), 1);
        rows = _mm512_insertf32x4(rows, _mm_loadu_ps(row[8 + first]), 2);
        return _mm512_insertf32x4(rows, _mm_loadu_ps(row[12 + first]), 3);
    };
    const __m512 a = rowsFrom(0), b = rowsFrom(1), c = rowsFrom(2), d = rowsFrom(3);
    const auto low = [&](__m512 x, __m512 y) -> __m512d {
        return _mm512_castps_pd(_mm512_unpacklo_ps(x, y));
    };
    const auto high = [&](__m512 x, __m512 y) -> __m512d {
        return _mm512_castps_pd(_mm512_unpackhi_ps(x, y));
    };
    column[0] = _mm512_castpd_ps(_mm512_unpacklo_pd(low(a, b), low(c, d)));
    column[1] = _mm512_castpd_ps(_mm512_unpackhi_pd(low(a, b), low(c, d)));
    column[2] = _mm512_castpd_ps(_mm512_unpacklo_pd(high(a, b), high(c, d)));
    column[3] = _mm512_castpd_ps(_mm512_unpackhi_pd(high(a, b), high(c, d)));
}

// Children whose kind has this bit.
template <int Bit, class Node> inline unsigned kindBits(const Node& node) {
    return bits({_mm512_test_epi32_mask(Ints::load(node.child).v, _mm512_set1_epi32(1 << Bit))});
}

// The same of doubles, in memory.
inline void storeRows(const double* const (&row)[W], double (*column)[W]) {
    for (int half = 0; half < 2; ++half) {
        const auto rowsFrom = [&](int first) -> __m512d { // and the one after the next
            const double* const* const at = row + 8 * half + first;
            return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(at[0])),
                                      _mm256_loadu_pd(at[2]), 1);
        };
        const __m512d a = rowsFrom(0), b = rowsFrom(1), c = rowsFrom(4), d = rowsFrom(5);
        const __m512d even[2] = {_mm512_unpacklo_pd(a, b), _mm512_unpacklo_pd(c, d)},
                      odd[2] = {_mm512_unpackhi_pd(a, b), _mm512_unpackhi_pd(c, d)};
        const __m512d columns[4] = {_mm512_shuffle_f64x2(even[0], even[1], 0x88),
                                    _mm512_shuffle_f64x2(odd[0], odd[1], 0x88),
                                    _mm512_shuffle_f64x2(even[0], even[1], 0xdd),
                                    _mm512_shuffle_f64x2(odd[0], odd[1], 0xdd)};
        for (int i = 0; i < 4; ++i) _mm512_store_pd(column[i] + 8 * half, columns[i]);
    }
}

// Bits of W rows of W, asked for by columns.
class LaneColumns {
public:
    LaneColumns() : columns_(_mm512_setzero_si512()) {}
    void set(int row, Mask columns) {
        columns_ = _mm512_mask_or_epi32(columns_, columns.v, columns_,
                                        _mm512_set1_epi32(kBit[static_cast<std::size_t>(row)]));
    }
    void store(std::uint32_t* to) const { _mm512_store_si512(to, columns_); }

private:
    // In memory, from where one costs no more than the `or` itself.
    alignas(64) static constexpr auto kBit = [] {
        std::array<int, W> bit{};
        for (std::size_t i = 0; i < W; ++i) bit[i] = 1 << i;
        return bit;
    }();
    __m512i columns_;
};

// --- look-ups in tables ---

inline Doubles floor(const Doubles& a) {
    constexpr int kDown = _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC;
    return {_mm512_roundscale_pd(a.lo, kDown), _mm512_roundscale_pd(a.hi, kDown)};
}
// Cut towards zero.
inline Ints wholeOf(const Doubles& a) {
    return _mm512_inserti64x4(_mm512_castsi256_si512(_mm512_cvttpd_epi32(a.lo)),
                              _mm512_cvttpd_epi32(a.hi), 1);
}
inline __m256i upperHalf(Ints a) { return _mm512_extracti64x4_epi64(a.v, 1); }
inline Doubles doublesOf(Ints a) {
    return {_mm512_cvtepi32_pd(_mm512_castsi512_si256(a.v)), _mm512_cvtepi32_pd(upperHalf(a))};
}
// Byte i, 0 to 3, of each.
inline Ints byteOf(Ints a, int i) {
    return _mm512_and_si512(_mm512_srl_epi32(a.v, _mm_cvtsi32_si128(8 * i)),
                            _mm512_set1_epi32(255));
}
// The four bytes at each offset.
inline Ints fourBytesAt(const std::uint8_t* from, Ints offset) {
    const NumbersInMemory at(offset);
    return loadWords([&](std::size_t i) { return from + at[i]; });
}
// Element i of a table for each i, which are below 2^31; 0 in lanes that are not chosen, whatever
// their i.
inline Ints elementsAt(const std::uint32_t* table, Ints i, unsigned chosen) {
    return _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), static_cast<__mmask16>(chosen), i.v,
                                       table, 4);
}
inline __m512d joined(__m128d a, __m128d b, __m128d c, __m128d d) {
    const __m256d low = _mm256_set_m128d(b, a), high = _mm256_set_m128d(d, c);
    return _mm512_insertf64x4(_mm512_castpd256_pd512(low), high, 1);
}
// The first two elements of row i, for each i, of a table whose rows are kStride long.
template <int kStride>
[[gnu::always_inline]] inline void pairsAt(const double* rows, Ints i, Doubles& first,
                                           Doubles& second) {
    const NumbersInMemory at(i);
    const TwoRows a(rows, at, 0, kStride), b(rows, at, 2, kStride), c(rows, at, 4, kStride),
        d(rows, at, 6, kStride), e(rows, at, 8, kStride), f(rows, at, 10, kStride),
        g(rows, at, 12, kStride), h(rows, at, 14, kStride);
    first = {joined(a.first, b.first, c.first, d.first),
             joined(e.first, f.first, g.first, h.first)};
    second = {joined(a.second, b.second, c.second, d.second),
              joined(e.second, f.second, g.second, h.second)};
}

// --- bits of powers ---

inline Ints bitsOf(Floats a) { return _mm512_castps_si512(a.v); }
inline Floats fromBits(Ints a) { return _mm512_castsi512_ps(a.v); }
inline Ints plus(Ints a, std::uint32_t b) { return _mm512_add_epi32(a.v, Ints(b).v); }
inline Ints masked(Ints a, std::uint32_t b) { return _mm512_and_si512(a.v, Ints(b).v); }
template <int kBits> Ints shiftedRight(Ints a) { return _mm512_srai_epi32(a.v, kBits); }
// 2^k, for k from -1022 to 1023.
inline Doubles powersOfTwo(Ints k) {
    const auto half = [&](__m256i exponent) {
        return _mm512_castsi512_pd(_mm512_slli_epi64(_mm512_cvtepi32_epi64(exponent), 52));
    };
    const Ints biased = plus(k, 1023);
    return {half(_mm512_castsi512_si256(biased.v)), half(_mm512_extracti64x4_epi64(biased.v, 1))};
}

// --- bits of Sobol numbers ---

inline constexpr std::size_t kSobolLanes = 16;

// --- lanes of two in turn ---

// The lanes of a and b in turn: those of the lower and of the upper halves.
inline Floats lowInTurn(Floats a, Floats b) {
    const __m512i from = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    return _mm512_permutex2var_ps(a.v, from, b.v);
}
inline Floats highInTurn(Floats a, Floats b) {
    const __m512i from =
        _mm512_setr_epi32(8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
    return _mm512_permutex2var_ps(a.v, from, b.v);
}

LANES_END
