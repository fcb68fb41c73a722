// How 8 lanes of SSE4.2 move: see avx512_moves.h.
#pragma once

#include "simd/gather_by_hand.h"
#include "simd/sse.h"

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
    return {fourWords(at, 0), fourWords(at, 4)};
}
template <class Fn>
[[gnu::always_inline]] inline void loadPairs(const Fn& at, Floats& first, Floats& second) {
    const FourPairs low(at, 0), high(at, 4);
    first = {low.first, high.first}, second = {low.second, high.second};
}
inline void storePairs(Floats a, Ints b, float* to) {
    const __m128 lo = _mm_castsi128_ps(b.lo), hi = _mm_castsi128_ps(b.hi);
    _mm_storeu_ps(to, _mm_unpacklo_ps(a.lo, lo));
    _mm_storeu_ps(to + 4, _mm_unpackhi_ps(a.lo, lo));
    _mm_storeu_ps(to + 8, _mm_unpacklo_ps(a.hi, hi));
    _mm_storeu_ps(to + 12, _mm_unpackhi_ps(a.hi, hi));
}

inline void storeRows(Floats a, Floats b, Floats c, Ints d, Ints e, float* to) {
    const auto four = [](__m128 x, __m128 y, __m128 z, __m128 w, __m128 last, float* rows) {
        _MM_TRANSPOSE4_PS(x, y, z, w);
        alignas(16) float fifth[4];
        _mm_store_ps(fifth, last);
        const __m128 all[4] = {x, y, z, w};
        for (int i = 0; i < 4; ++i) {
            _mm_storeu_ps(rows + 5 * i, all[i]);
            rows[5 * i + 4] = fifth[i];
        }
    };
    four(a.lo, b.lo, c.lo, _mm_castsi128_ps(d.lo), _mm_castsi128_ps(e.lo), to);
    four(a.hi, b.hi, c.hi, _mm_castsi128_ps(d.hi), _mm_castsi128_ps(e.hi), to + 20);
}

// --- keys ---

struct alignas(16) Keys {
    std::uint32_t v[W];
};
// Bytes for _mm_shuffle_epi8(): kPacked[m] brings the chosen ones of four numbers to the front,
// zeros follow; 16 of kSlid from 16 - 4 n on move numbers n places up, from 32 - 4 n on 4 - n
// places down.
alignas(16) inline constexpr auto kPacked = [] {
    std::array<std::array<std::uint8_t, 16>, 16> all{};
    for (unsigned chosen = 0; chosen < 16; ++chosen) {
        all[chosen].fill(0x80);
        std::size_t to = 0;
        for (unsigned byte = 0; byte < 16; ++byte)
            if ((chosen >> byte / 4 & 1) != 0) all[chosen][to++] = static_cast<std::uint8_t>(byte);
    }
    return all;
}();
inline constexpr auto kSlid = [] {
    std::array<std::uint8_t, 48> all{};
    all.fill(0x80);
    for (std::size_t byte = 0; byte < 16; ++byte) all[16 + byte] = static_cast<std::uint8_t>(byte);
    return all;
}();
inline __m128i packed(__m128i four, unsigned chosen) {
    return _mm_shuffle_epi8(
        four, _mm_load_si128(reinterpret_cast<const __m128i*>(kPacked[chosen].data())));
}
inline Keys keysOf(Mask lanes, Floats a) {
    const unsigned chosen = bits(lanes), inLow = chosen & 15;
    const auto keysOfFour = [](__m128 near, __m128i lane, unsigned m) {
        return packed(
            _mm_or_si128(_mm_andnot_si128(_mm_set1_epi32(15), _mm_castps_si128(near)), lane), m);
    };
    const __m128i low = keysOfFour(a.lo, _mm_setr_epi32(7, 6, 5, 4), inLow),
                  high = keysOfFour(a.hi, _mm_setr_epi32(3, 2, 1, 0), chosen >> 4);
    const auto slid = [&](int first) { // the high ones behind the low ones
        const std::uint8_t* const from =
            kSlid.data() + first - std::ptrdiff_t{4} * __builtin_popcount(inLow);
        return _mm_shuffle_epi8(high, _mm_loadu_si128(reinterpret_cast<const __m128i*>(from)));
    };
    Keys keys;
    _mm_store_si128(reinterpret_cast<__m128i*>(keys.v), _mm_or_si128(low, slid(16)));
    _mm_store_si128(reinterpret_cast<__m128i*>(keys.v + 4), slid(32));
    return keys;
}
inline __m128i firstFour(const Keys& keys) {
    return _mm_load_si128(reinterpret_cast<const __m128i*>(keys.v));
}
inline void storeKeys(const Keys& keys, std::uint32_t* to) {
    for (int i = 0; i < W; ++i) to[i] = keys.v[i];
}
inline __m128i pick(__m128i keys, const std::uint32_t* from) {
    const __m128i lane =
        _mm_xor_si128(_mm_and_si128(keys, _mm_set1_epi32(15)), _mm_set1_epi32(W - 1));
    // The bytes of that lane, 0 to 31: numbers with the highest bit pick zeros.
    const __m128i first = _mm_shuffle_epi8(
        _mm_slli_epi32(lane, 2), _mm_setr_epi8(0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8, 12, 12, 12, 12));
    const __m128i byte = _mm_add_epi8(first, _mm_set1_epi32(0x03020100));
    const auto* const halves = reinterpret_cast<const __m128i*>(from);
    return _mm_or_si128(
        _mm_shuffle_epi8(_mm_loadu_si128(halves), _mm_add_epi8(byte, _mm_set1_epi8(0x70))),
        _mm_shuffle_epi8(_mm_loadu_si128(halves + 1), _mm_sub_epi8(byte, _mm_set1_epi8(16))));
}
inline std::uint32_t element(__m128i four, int i) {
    alignas(16) std::uint32_t all[4];
    _mm_store_si128(reinterpret_cast<__m128i*>(all), four);
    return all[i & 3];
}

// Keys in descending order.
inline Keys sortedKeys(Keys keys) {
    std::sort(keys.v, keys.v + W, [](std::uint32_t a, std::uint32_t b) { return a > b; });
    return keys;
}
inline Keys pickAll(const Keys& keys, const std::uint32_t* from) {
    Keys picked;
    for (int i = 0; i < W; ++i) picked.v[i] = from[(keys.v[i] & 15) ^ (W - 1)];
    return picked;
}
inline std::uint32_t element(const Keys& all, int i) { return all.v[i]; }

inline void storeChosen(unsigned chosen, Ints from, std::uint32_t* to) {
    const unsigned inLow = chosen & 15;
    const auto store = [](__m128i four, unsigned m, std::uint32_t* at) {
        _mm_storeu_si128(reinterpret_cast<__m128i*>(at), packed(four, m));
    };
    store(from.lo, inLow, to);
    store(from.hi, chosen >> 4, to + __builtin_popcount(inLow));
}
inline void storeChosen(unsigned chosen, const std::uint32_t* from, std::uint32_t* to) {
    storeChosen(chosen, Ints::load(from), to);
}
inline void storeChosen(Mask chosen, const std::uint32_t* from, std::uint32_t* to) {
    storeChosen(bits(chosen), from, to);
}

// --- chosen lanes ---

inline void storeChosenFloats(unsigned chosen, Floats a, float* to) {
    alignas(64) float all[W];
    a.store(all);
    for (; chosen != 0; chosen &= chosen - 1) *to++ = all[std::countr_zero(chosen)];
}
inline void storeChosenVectors(unsigned chosen, Floats x, Floats y, Floats z, float* to) {
    alignas(64) float all[3][W];
    x.store(all[0]), y.store(all[1]), z.store(all[2]);
    for (; chosen != 0; chosen &= chosen - 1)
        for (const auto& axis : all) *to++ = axis[std::countr_zero(chosen)];
}
inline unsigned spread(unsigned lowest, unsigned places) {
    unsigned out = 0;
    for (; places != 0; places &= places - 1, lowest >>= 1)
        out |= (lowest & 1) << std::countr_zero(places);
    return out;
}

// --- columns of rows ---

inline constexpr bool kPairsPay = false; // permutations take a store and many loads

inline void loadRows(const float* const (&row)[W], Floats (&column)[4]) {
    for (int half = 0; half < 2; ++half) {
        const auto rowAt = [&](int i) { return _mm_loadu_ps(row[4 * half + i]); };
        __m128 a = rowAt(0), b = rowAt(1), c = rowAt(2), d = rowAt(3);
        _MM_TRANSPOSE4_PS(a, b, c, d);
        const __m128 columns[4] = {a, b, c, d};
        for (int i = 0; i < 4; ++i) (half == 0 ? column[i].lo : column[i].hi) = columns[i];
    }
}

template <int Bit, class Node> inline unsigned kindBits(const Node& node) {
    const Ints child = Ints::load(node.child);
    const auto top = [](__m128i four) {
        return static_cast<unsigned>(
            _mm_movemask_ps(_mm_castsi128_ps(_mm_slli_epi32(four, 31 - Bit))));
    };
    return top(child.lo) | top(child.hi) << 4;
}

inline void storeRows(const double* const (&row)[W], double (*column)[W]) {
    for (int pair = 0; pair < 4; ++pair)
        for (int half = 0; half < 2; ++half) {
            const __m128d a = _mm_loadu_pd(row[2 * pair] + 2 * half),
                          b = _mm_loadu_pd(row[2 * pair + 1] + 2 * half);
            _mm_store_pd(column[2 * half] + 2 * pair, _mm_unpacklo_pd(a, b));
            _mm_store_pd(column[2 * half + 1] + 2 * pair, _mm_unpackhi_pd(a, b));
        }
}

class LaneColumns {
public:
    LaneColumns() : lo_(_mm_setzero_si128()), hi_(lo_) {}
    void set(int row, Mask columns) {
        const __m128i bit = _mm_set1_epi32(static_cast<int>(1u << row));
        lo_ = _mm_or_si128(lo_, _mm_and_si128(_mm_castps_si128(columns.lo), bit));
        hi_ = _mm_or_si128(hi_, _mm_and_si128(_mm_castps_si128(columns.hi), bit));
    }
    void store(std::uint32_t* to) const { Ints(lo_, hi_).store(to); }

private:
    __m128i lo_, hi_;
};

// --- look-ups in tables ---

inline Doubles floor(const Doubles& a) {
    return quarters([&](int i) { return _mm_floor_pd(a.v[i]); });
}
inline Ints wholeOf(const Doubles& a) {
    return {_mm_unpacklo_epi64(_mm_cvttpd_epi32(a.v[0]), _mm_cvttpd_epi32(a.v[1])),
            _mm_unpacklo_epi64(_mm_cvttpd_epi32(a.v[2]), _mm_cvttpd_epi32(a.v[3]))};
}
inline Doubles doublesOf(Ints a) {
    return {_mm_cvtepi32_pd(a.lo), _mm_cvtepi32_pd(_mm_unpackhi_epi64(a.lo, a.lo)),
            _mm_cvtepi32_pd(a.hi), _mm_cvtepi32_pd(_mm_unpackhi_epi64(a.hi, a.hi))};
}
inline Ints byteOf(Ints a, int i) {
    const __m128i shift = _mm_cvtsi32_si128(8 * i), byte = _mm_set1_epi32(255);
    return {_mm_and_si128(_mm_srl_epi32(a.lo, shift), byte),
            _mm_and_si128(_mm_srl_epi32(a.hi, shift), byte)};
}
inline Ints fourBytesAt(const std::uint8_t* from, Ints offset) {
    const NumbersInMemory at(offset);
    return loadWords([&](std::size_t i) { return from + at[i]; });
}
inline Ints elementsAt(const std::uint32_t* table, Ints i, unsigned chosen) {
    alignas(16) std::uint32_t at[W], out[W] = {};
    i.store(at);
    for (; chosen != 0; chosen &= chosen - 1) {
        const int lane = std::countr_zero(chosen);
        out[lane] = table[at[lane]];
    }
    return Ints::load(out);
}
template <int kStride>
[[gnu::always_inline]] inline void pairsAt(const double* rows, Ints i, Doubles& first,
                                           Doubles& second) {
    const NumbersInMemory at(i);
    const TwoRows a(rows, at, 0, kStride), b(rows, at, 2, kStride), c(rows, at, 4, kStride),
        d(rows, at, 6, kStride);
    first = {a.first, b.first, c.first, d.first};
    second = {a.second, b.second, c.second, d.second};
}

// --- bits of powers ---

inline Ints bitsOf(Floats a) { return {_mm_castps_si128(a.lo), _mm_castps_si128(a.hi)}; }
inline Floats fromBits(Ints a) { return {_mm_castsi128_ps(a.lo), _mm_castsi128_ps(a.hi)}; }
inline Ints plus(Ints a, std::uint32_t b) {
    return {_mm_add_epi32(a.lo, Ints(b).lo), _mm_add_epi32(a.hi, Ints(b).lo)};
}
inline Ints masked(Ints a, std::uint32_t b) {
    return {_mm_and_si128(a.lo, Ints(b).lo), _mm_and_si128(a.hi, Ints(b).lo)};
}
template <int kBits> Ints shiftedRight(Ints a) {
    return {_mm_srai_epi32(a.lo, kBits), _mm_srai_epi32(a.hi, kBits)};
}
inline Doubles powersOfTwo(Ints k) {
    const auto two = [&](__m128i exponent) {
        return _mm_castsi128_pd(_mm_slli_epi64(_mm_cvtepi32_epi64(exponent), 52));
    };
    const auto upper = [&](__m128i four) { return _mm_unpackhi_epi64(four, four); };
    const Ints biased = plus(k, 1023);
    return {two(biased.lo), two(upper(biased.lo)), two(biased.hi), two(upper(biased.hi))};
}

// --- bits of Sobol numbers ---

inline constexpr std::size_t kSobolLanes = 4;

// --- lanes of two in turn ---

inline Floats lowInTurn(Floats a, Floats b) {
    return {_mm_unpacklo_ps(a.lo, b.lo), _mm_unpackhi_ps(a.lo, b.lo)};
}
inline Floats highInTurn(Floats a, Floats b) {
    return {_mm_unpacklo_ps(a.hi, b.hi), _mm_unpackhi_ps(a.hi, b.hi)};
}

LANES_END
