// 16 lanes in one register of AVX-512.
#pragma once

#include "simd/region.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <immintrin.h>

LANES_BEGIN

inline constexpr int W = 16;

struct Mask {
    __mmask16 v;
};
struct Floats {
    __m512 v;
    Floats() = default;
    Floats(__m512 a) : v(a) {}
    Floats(float a) : v(_mm512_set1_ps(a)) {}
    static Floats load(const void* p) { return _mm512_load_ps(p); }
    static Floats unaligned(const float* p) { return _mm512_loadu_ps(p); }
    void store(float* p) const { _mm512_store_ps(p, v); }
};
struct Ints {
    __m512i v;
    Ints(__m512i a) : v(a) {}
    Ints(std::uint32_t a) : v(_mm512_set1_epi32(static_cast<int>(a))) {}
    static Ints load(const std::uint32_t* p) { return _mm512_load_si512(p); }
    static Ints unaligned(const std::uint32_t* p) { return _mm512_loadu_si512(p); }
    static Ints from(std::uint32_t first) { // first, first + 1, ...
        const __m512i lane =
            _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
        return _mm512_add_epi32(_mm512_set1_epi32(static_cast<int>(first)), lane);
    }
    static Ints bytes(const std::uint8_t* p) {
        return _mm512_cvtepu8_epi32(_mm_load_si128(reinterpret_cast<const __m128i*>(p)));
    }
    void store(std::uint32_t* p) const { _mm512_store_si512(p, v); }
};
// As many doubles as there are floats, in two registers.
struct Doubles {
    __m512d lo, hi;
    Doubles(__m512d a, __m512d b) : lo(a), hi(b) {}
    Doubles(double a) : lo(_mm512_set1_pd(a)), hi(lo) {}
    explicit Doubles(Floats a)
        : lo(_mm512_cvtps_pd(_mm512_castps512_ps256(a.v))),
          hi(_mm512_cvtps_pd(_mm512_extractf32x8_ps(a.v, 1))) {}
    static Doubles load(const double* p) { return {_mm512_load_pd(p), _mm512_load_pd(p + 8)}; }
    void store(double* p) const { _mm512_store_pd(p, lo), _mm512_store_pd(p + 8, hi); }
    Floats toFloats() const {
        return _mm512_insertf32x8(_mm512_castps256_ps512(_mm512_cvtpd_ps(lo)), _mm512_cvtpd_ps(hi),
                                  1);
    }
};

inline Floats operator+(Floats a, Floats b) { return _mm512_add_ps(a.v, b.v); }
inline Floats operator-(Floats a, Floats b) { return _mm512_sub_ps(a.v, b.v); }
inline Floats operator*(Floats a, Floats b) { return _mm512_mul_ps(a.v, b.v); }
inline Floats operator/(Floats a, Floats b) { return _mm512_div_ps(a.v, b.v); }
inline Doubles operator+(Doubles a, Doubles b) {
    return {_mm512_add_pd(a.lo, b.lo), _mm512_add_pd(a.hi, b.hi)};
}
inline Doubles operator-(Doubles a, Doubles b) {
    return {_mm512_sub_pd(a.lo, b.lo), _mm512_sub_pd(a.hi, b.hi)};
}
inline Doubles operator*(Doubles a, Doubles b) {
    return {_mm512_mul_pd(a.lo, b.lo), _mm512_mul_pd(a.hi, b.hi)};
}
inline Doubles operator/(Doubles a, Doubles b) {
    return {_mm512_div_pd(a.lo, b.lo), _mm512_div_pd(a.hi, b.hi)};
}
inline Floats sqrt(Floats a) { return _mm512_sqrt_ps(a.v); }
inline Doubles sqrt(const Doubles& a) { return {_mm512_sqrt_pd(a.lo), _mm512_sqrt_pd(a.hi)}; }
inline Doubles abs(const Doubles& a) { return {_mm512_abs_pd(a.lo), _mm512_abs_pd(a.hi)}; }
inline Doubles min(const Doubles& a, const Doubles& b) {
    return {_mm512_min_pd(a.lo, b.lo), _mm512_min_pd(a.hi, b.hi)};
}
inline Doubles max(const Doubles& a, const Doubles& b) {
    return {_mm512_max_pd(a.lo, b.lo), _mm512_max_pd(a.hi, b.hi)};
}
inline Doubles withSign(const Doubles& a, const Doubles& of) {
    const __m512d sign = _mm512_set1_pd(-0.0);
    const auto half = [&](__m512d x, __m512d y) {
        return _mm512_or_pd(_mm512_andnot_pd(sign, x), _mm512_and_pd(sign, y));
    };
    return {half(a.lo, of.lo), half(a.hi, of.hi)};
}
inline Floats fma(Floats a, Floats b, Floats c) { return _mm512_fmadd_ps(a.v, b.v, c.v); }
inline Floats fnma(Floats a, Floats b, Floats c) {
    return _mm512_fnmadd_ps(a.v, b.v, c.v);
} // c - a b
inline Floats fms(Floats a, Floats b, Floats c) {
    return _mm512_fmsub_ps(a.v, b.v, c.v);
} // a b - c
// The second operand wins when one is NaN, as in base/math.h.
inline Floats min(Floats a, Floats b) { return _mm512_min_ps(a.v, b.v); }
inline Floats max(Floats a, Floats b) { return _mm512_max_ps(a.v, b.v); }
// min(a, b) where the mask is set, a elsewhere.
inline Floats minWhere(Mask m, Floats a, Floats b) {
    return _mm512_mask_min_ps(a.v, m.v, a.v, b.v);
}
inline Floats abs(Floats a) { return _mm512_abs_ps(a.v); }
inline Floats maxAbs(Floats a, Floats b) { return _mm512_range_ps(a.v, b.v, 0b1011); }
inline Floats flipSign(Floats a, Floats by) {
    return _mm512_xor_ps(a.v, _mm512_and_ps(by.v, _mm512_set1_ps(-0.0f)));
}
inline Floats withSign(Floats a, Floats of) { return flipSign(abs(a), of); }
inline Floats floor(Floats a) { return _mm512_floor_ps(a.v); }
// The next float; of those that are not negative.
inline Floats nextFloat(Floats a) {
    return _mm512_castsi512_ps(_mm512_add_epi32(_mm512_castps_si512(a.v), _mm512_set1_epi32(1)));
}
inline Floats roughInverse(Floats a) { return _mm512_rcp14_ps(a.v); } // 2^-14

inline Mask operator<(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LT_OQ)}; }
inline Mask operator<=(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_LE_OQ)}; }
inline Mask operator>(Floats a, Floats b) { return b < a; }
inline Mask operator>=(Floats a, Floats b) { return b <= a; }
inline Mask operator==(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_EQ_OQ)}; }
// True for NaN.
inline Mask notGreater(Floats a, Floats b) { return {_mm512_cmp_ps_mask(a.v, b.v, _CMP_NGT_UQ)}; }
inline Ints operator&(Ints a, Ints b) { return _mm512_and_si512(a.v, b.v); }
inline Ints operator+(Ints a, Ints b) { return _mm512_add_epi32(a.v, b.v); }
inline Mask operator<(Ints a, Ints b) { return {_mm512_cmplt_epu32_mask(a.v, b.v)}; }
inline Mask operator==(Ints a, Ints b) { return {_mm512_cmpeq_epi32_mask(a.v, b.v)}; }
inline Mask operator&(Mask a, Mask b) { return {static_cast<__mmask16>(a.v & b.v)}; }
inline Mask operator|(Mask a, Mask b) { return {static_cast<__mmask16>(a.v | b.v)}; }
inline unsigned bits(Mask m) {
    unsigned lanes = m.v;
#if !defined(__clang__)
    // g++ 12 may spill the 16 bits of a mask and load 32: they are made 32 in a register.
    asm("" : "+r"(lanes));
#endif
    return lanes;
}
inline Mask maskOf(unsigned laneBits) { return {static_cast<__mmask16>(laneBits)}; }
inline Floats select(Mask m, Floats a, Floats b) { return _mm512_mask_blend_ps(m.v, b.v, a.v); }
inline Ints select(Mask m, Ints a, Ints b) { return _mm512_mask_blend_epi32(m.v, b.v, a.v); }
inline Floats permute(Floats a, Ints lanes) { return _mm512_permutexvar_ps(lanes.v, a.v); }
inline Ints permute(Ints a, Ints lanes) { return _mm512_permutexvar_epi32(lanes.v, a.v); }

// Bits of the lanes where it holds.
inline unsigned less(const Doubles& a, const Doubles& b) {
    return bits({_mm512_cmp_pd_mask(a.lo, b.lo, _CMP_LT_OQ)}) |
           bits({_mm512_cmp_pd_mask(a.hi, b.hi, _CMP_LT_OQ)}) << 8;
}
inline unsigned atMost(const Doubles& a, const Doubles& b) {
    return bits({_mm512_cmp_pd_mask(a.lo, b.lo, _CMP_LE_OQ)}) |
           bits({_mm512_cmp_pd_mask(a.hi, b.hi, _CMP_LE_OQ)}) << 8;
}
inline Mask operator<(const Doubles& a, const Doubles& b) { return maskOf(less(a, b)); }
inline Doubles select(Mask m, const Doubles& a, const Doubles& b) {
    return {_mm512_mask_blend_pd(static_cast<__mmask8>(bits(m)), b.lo, a.lo),
            _mm512_mask_blend_pd(static_cast<__mmask8>(bits(m) >> 8), b.hi, a.hi)};
}

inline float smallest(Floats a) { return _mm512_reduce_min_ps(a.v); }
inline float largest(Floats a) { return _mm512_reduce_max_ps(a.v); }

// Lane i is the smallest or largest number of row i.
template <bool Largest> inline Floats foldRows(const float (*rows)[W]) {
    const auto fold = [&](__m512 a, __m512 b) {
        return Largest ? _mm512_max_ps(a, b) : _mm512_min_ps(a, b);
    };
    __m512 two[8], four[4];
    for (int i = 0; i < 8; ++i) { // two rows to a register, and so on
        const __m512 a = _mm512_load_ps(rows[i]), b = _mm512_load_ps(rows[i + 8]);
        two[i] = fold(_mm512_shuffle_f32x4(a, b, 0x44), _mm512_shuffle_f32x4(a, b, 0xee));
    }
    for (int i = 0; i < 4; ++i)
        four[i] = fold(_mm512_shuffle_f32x4(two[i], two[i + 4], 0x88),
                       _mm512_shuffle_f32x4(two[i], two[i + 4], 0xdd));
    const auto eight = [&](__m512 a, __m512 b) {
        return fold(_mm512_unpacklo_ps(a, b), _mm512_unpackhi_ps(a, b));
    };
    const __m512 a = eight(four[0], four[1]), b = eight(four[2], four[3]);
    const __m512 all = fold(_mm512_shuffle_ps(a, b, 0x44), _mm512_shuffle_ps(a, b, 0xee));
    return _mm512_shuffle_f32x4(all, all, _MM_SHUFFLE(3, 1, 2, 0));
}
inline Floats smallestOfRows(const float (*rows)[W]) { return foldRows<false>(rows); }
inline Floats largestOfRows(const float (*rows)[W]) { return foldRows<true>(rows); }

// x, y, z of W vectors that follow each other.
inline void loadVectors(const float* p, Floats& x, Floats& y, Floats& z) {
    const __m512 a = _mm512_loadu_ps(p), b = _mm512_loadu_ps(p + 16), c = _mm512_loadu_ps(p + 32);
    const auto pick = [&](__m512i fromAB, __m512i withC) {
        return _mm512_permutex2var_ps(_mm512_permutex2var_ps(a, fromAB, b), withC, c);
    };
    x = pick(_mm512_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21, 24, 27, 30, 0, 0, 0, 0, 0),
             _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 17, 20, 23, 26, 29));
    y = pick(_mm512_setr_epi32(1, 4, 7, 10, 13, 16, 19, 22, 25, 28, 31, 0, 0, 0, 0, 0),
             _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 18, 21, 24, 27, 30));
    z = pick(_mm512_setr_epi32(2, 5, 8, 11, 14, 17, 20, 23, 26, 29, 0, 0, 0, 0, 0, 0),
             _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 16, 19, 22, 25, 28, 31));
}

LANES_END
