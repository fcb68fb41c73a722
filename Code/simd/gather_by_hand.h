// What lies anywhere, piece by piece into registers of four floats or two doubles: faster than the
// gathers of AVX2 and AVX-512, which are microcode.
#pragma once

#include "simd/registers.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <immintrin.h>

LANES_BEGIN

// Numbers that are taken one by one: loads do that faster than shifts within a register, for which
// g++ would leave the store out.
class NumbersInMemory {
public:
    explicit NumbersInMemory(Ints i) {
        i.store(numbers_);
        asm("" : "+m"(numbers_));
    }
    std::uint32_t operator[](std::size_t lane) const { return numbers_[lane]; }

private:
    alignas(64) std::uint32_t numbers_[W];
};

// Four times four bytes. at(i): where number i lies, for i from `from` on.
template <class Fn>
[[gnu::always_inline]] inline __m128i fourWords(const Fn& at, std::size_t from) {
    const auto word = [&](std::size_t i) {
        std::int32_t bytes;
        std::memcpy(&bytes, at(from + i), sizeof bytes);
        return _mm_cvtsi32_si128(bytes);
    };
    return _mm_unpacklo_epi64(_mm_unpacklo_epi32(word(0), word(1)),
                              _mm_unpacklo_epi32(word(2), word(3)));
}

// Four pairs of floats. at(i): where pair i lies, for i from `from` on.
struct FourPairs {
    __m128 first, second;

    template <class Fn> [[gnu::always_inline]] FourPairs(const Fn& at, std::size_t from) {
        const auto two = [&](std::size_t i) {
            const __m128 low = _mm_loadl_pi(_mm_setzero_ps(), pair(at(i)));
            return _mm_loadh_pi(low, pair(at(i + 1)));
        };
        const __m128 a = two(from), b = two(from + 2);
        first = _mm_shuffle_ps(a, b, _MM_SHUFFLE(2, 0, 2, 0));
        second = _mm_shuffle_ps(a, b, _MM_SHUFFLE(3, 1, 3, 1));
    }

private:
    static const __m64* pair(const float* at) { return reinterpret_cast<const __m64*>(at); }
};

// Two pairs of doubles: those number at[i] and at[i + 1] of rows that are `stride` long.
struct TwoRows {
    __m128d first, second;

    [[gnu::always_inline]] TwoRows(const double* rows, const NumbersInMemory& at, std::size_t i,
                                   std::size_t stride) {
        const __m128d a = _mm_loadu_pd(rows + stride * at[i]);
        const __m128d b = _mm_loadu_pd(rows + stride * at[i + 1]);
        first = _mm_unpacklo_pd(a, b), second = _mm_unpackhi_pd(a, b);
    }
};

LANES_END
