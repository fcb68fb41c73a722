// 8 lanes in one register of AVX2.
#pragma once

#include "simd/region.h"

#include <cstdint>
#include <immintrin.h>
#include <type_traits>

LANES_BEGIN

inline constexpr int W = 8;

struct Mask {
    __m256 v;
};
struct Floats {
    __m256 v;
    Floats() = default;
    Floats(__m256 a) : v(a) {}
    Floats(float a) : v(_mm256_set1_ps(a)) {}
    static Floats load(const void* p) { return _mm256_load_ps(static_cast<const float*>(p)); }
    static Floats unaligned(const float* p) { return _mm256_loadu_ps(p); }
    void store(float* p) const { _mm256_store_ps(p, v); }
};
struct Ints {
    __m256i v;
    Ints(__m256i a) : v(a) {}
    Ints(std::uint32_t a) : v(_mm256_set1_epi32(static_cast<int>(a))) {}
    static Ints load(const std::uint32_t* p) {
        return _mm256_load_si256(reinterpret_cast<const __m256i*>(p));
    }
    static Ints unaligned(const std::uint32_t* p) {
        return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
    }
    static Ints from(std::uint32_t first) {
        return _mm256_add_epi32(_mm256_set1_epi32(static_cast<int>(first)),
                                _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7));
    }
    static Ints bytes(const std::uint8_t* p) {
        return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(p)));
    }
    void store(std::uint32_t* p) const { _mm256_store_si256(reinterpret_cast<__m256i*>(p), v); }
};
struct Doubles {
    __m256d lo, hi;
    Doubles(__m256d a, __m256d b) : lo(a), hi(b) {}
    Doubles(double a) : lo(_mm256_set1_pd(a)), hi(lo) {}
    explicit Doubles(Floats a)
        : lo(_mm256_cvtps_pd(_mm256_castps256_ps128(a.v))),
          hi(_mm256_cvtps_pd(_mm256_extractf128_ps(a.v, 1))) {}
    static Doubles load(const double* p) { return {_mm256_load_pd(p), _mm256_load_pd(p + 4)}; }
    void store(double* p) const { _mm256_store_pd(p, lo), _mm256_store_pd(p + 4, hi); }
    Floats toFloats() const { return _mm256_set_m128(_mm256_cvtpd_ps(hi), _mm256_cvtpd_ps(lo)); }
};

inline Floats operator+(Floats a, Floats b) { return _mm256_add_ps(a.v, b.v); }
inline Floats operator-(Floats a, Floats b) { return _mm256_sub_ps(a.v, b.v); }
inline Floats operator*(Floats a, Floats b) { return _mm256_mul_ps(a.v, b.v); }
inline Floats operator/(Floats a, Floats b) { return _mm256_div_ps(a.v, b.v); }
inline Doubles operator+(Doubles a, Doubles b) {
    return {_mm256_add_pd(a.lo, b.lo), _mm256_add_pd(a.hi, b.hi)};
}
inline Doubles operator-(Doubles a, Doubles b) {
    return {_mm256_sub_pd(a.lo, b.lo), _mm256_sub_pd(a.hi, b.hi)};
}
inline Doubles operator*(Doubles a, Doubles b) {
    return {_mm256_mul_pd(a.lo, b.lo), _mm256_mul_pd(a.hi, b.hi)};
}
inline Doubles operator/(Doubles a, Doubles b) {
    return {_mm256_div_pd(a.lo, b.lo), _mm256_div_pd(a.hi, b.hi)};
}
inline Floats sqrt(Floats a) { return _mm256_sqrt_ps(a.v); }
inline Doubles sqrt(const Doubles& a) { return {_mm256_sqrt_pd(a.lo), _mm256_sqrt_pd(a.hi)}; }
inline Doubles abs(const Doubles& a) {
    const __m256d sign = _mm256_set1_pd(-0.0);
    return {_mm256_andnot_pd(sign, a.lo), _mm256_andnot_pd(sign, a.hi)};
}
inline Doubles min(const Doubles& a, const Doubles& b) {
    return {_mm256_min_pd(a.lo, b.lo), _mm256_min_pd(a.hi, b.hi)};
}
inline Doubles max(const Doubles& a, const Doubles& b) {
    return {_mm256_max_pd(a.lo, b.lo), _mm256_max_pd(a.hi, b.hi)};
}
inline Doubles withSign(const Doubles& a, const Doubles& of) {
    const __m256d sign = _mm256_set1_pd(-0.0);
    const auto half = [&](__m256d x, __m256d y) {
        return _mm256_or_pd(_mm256_andnot_pd(sign, x), _mm256_and_pd(sign, y));
    };
    return {half(a.lo, of.lo), half(a.hi, of.hi)};
}
inline Floats fma(Floats a, Floats b, Floats c) { return _mm256_fmadd_ps(a.v, b.v, c.v); }
inline Floats fnma(Floats a, Floats b, Floats c) {
    return _mm256_fnmadd_ps(a.v, b.v, c.v);
} // c - a b
inline Floats fms(Floats a, Floats b, Floats c) {
    return _mm256_fmsub_ps(a.v, b.v, c.v);
} // a b - c
inline Floats min(Floats a, Floats b) { return _mm256_min_ps(a.v, b.v); }
inline Floats max(Floats a, Floats b) { return _mm256_max_ps(a.v, b.v); }
inline Floats abs(Floats a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a.v); }
inline Floats maxAbs(Floats a, Floats b) { return max(abs(a), abs(b)); }
inline Floats flipSign(Floats a, Floats by) {
    return _mm256_xor_ps(a.v, _mm256_and_ps(by.v, _mm256_set1_ps(-0.0f)));
}
inline Floats withSign(Floats a, Floats of) { return flipSign(abs(a), of); }
inline Floats floor(Floats a) { return _mm256_floor_ps(a.v); }
// The next float; of those that are not negative.
inline Floats nextFloat(Floats a) {
    return _mm256_castsi256_ps(_mm256_add_epi32(_mm256_castps_si256(a.v), _mm256_set1_epi32(1)));
}
inline Floats roughInverse(Floats a) { return _mm256_rcp_ps(a.v); } // 1.5 * 2^-12

inline Mask operator<(Floats a, Floats b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
inline Mask operator<=(Floats a, Floats b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LE_OQ)}; }
inline Mask operator>(Floats a, Floats b) { return b < a; }
inline Mask operator>=(Floats a, Floats b) { return b <= a; }
inline Mask operator==(Floats a, Floats b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_EQ_OQ)}; }
inline Mask notGreater(Floats a, Floats b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_NGT_UQ)}; }
inline Ints operator&(Ints a, Ints b) { return _mm256_and_si256(a.v, b.v); }
inline Ints operator+(Ints a, Ints b) { return _mm256_add_epi32(a.v, b.v); }
inline Mask operator<(Ints a, Ints b) {
    const __m256i top = _mm256_set1_epi32(static_cast<int>(0x80000000u));
    return {_mm256_castsi256_ps(
        _mm256_cmpgt_epi32(_mm256_xor_si256(b.v, top), _mm256_xor_si256(a.v, top)))};
}
inline Mask operator==(Ints a, Ints b) {
    return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(a.v, b.v))};
}
inline Mask operator&(Mask a, Mask b) { return {_mm256_and_ps(a.v, b.v)}; }
inline Mask operator|(Mask a, Mask b) { return {_mm256_or_ps(a.v, b.v)}; }
inline unsigned bits(Mask m) { return static_cast<unsigned>(_mm256_movemask_ps(m.v)); }
inline Mask maskOf(unsigned laneBits) {
    const __m256i lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i chosen = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(laneBits)), lane);
    return {_mm256_castsi256_ps(_mm256_cmpeq_epi32(chosen, lane))};
}
inline Floats select(Mask m, Floats a, Floats b) { return _mm256_blendv_ps(b.v, a.v, m.v); }
// min(a, b) where the mask is set, a elsewhere.
inline Floats minWhere(Mask m, Floats a, Floats b) { return min(a, select(m, b, a)); }
inline Ints select(Mask m, Ints a, Ints b) {
    return _mm256_blendv_epi8(b.v, a.v, _mm256_castps_si256(m.v));
}
inline Floats permute(Floats a, Ints lanes) { return _mm256_permutevar8x32_ps(a.v, lanes.v); }
inline Ints permute(Ints a, Ints lanes) { return _mm256_permutevar8x32_epi32(a.v, lanes.v); }

inline unsigned bitsOf(__m256d lo, __m256d hi) {
    return static_cast<unsigned>(_mm256_movemask_pd(lo) | _mm256_movemask_pd(hi) << 4);
}
inline unsigned less(const Doubles& a, const Doubles& b) {
    return bitsOf(_mm256_cmp_pd(a.lo, b.lo, _CMP_LT_OQ), _mm256_cmp_pd(a.hi, b.hi, _CMP_LT_OQ));
}
inline unsigned atMost(const Doubles& a, const Doubles& b) {
    return bitsOf(_mm256_cmp_pd(a.lo, b.lo, _CMP_LE_OQ), _mm256_cmp_pd(a.hi, b.hi, _CMP_LE_OQ));
}
inline Mask operator<(const Doubles& a, const Doubles& b) {
    const __m256 lo = _mm256_castpd_ps(_mm256_cmp_pd(a.lo, b.lo, _CMP_LT_OQ)),
                 hi = _mm256_castpd_ps(_mm256_cmp_pd(a.hi, b.hi, _CMP_LT_OQ));
    const __m256d pairs = _mm256_castps_pd(_mm256_shuffle_ps(lo, hi, 0x88));
    return {_mm256_castpd_ps(_mm256_permute4x64_pd(pairs, 0xd8))};
}
inline Doubles select(Mask m, const Doubles& a, const Doubles& b) {
    const __m256i lanes = _mm256_castps_si256(m.v);
    const __m256i lo = _mm256_cvtepi32_epi64(_mm256_castsi256_si128(lanes)),
                  hi = _mm256_cvtepi32_epi64(_mm256_extracti128_si256(lanes, 1));
    return {_mm256_blendv_pd(b.lo, a.lo, _mm256_castsi256_pd(lo)),
            _mm256_blendv_pd(b.hi, a.hi, _mm256_castsi256_pd(hi))};
}

inline float smallest(Floats a) {
    __m128 m = _mm_min_ps(_mm256_castps256_ps128(a.v), _mm256_extractf128_ps(a.v, 1));
    m = _mm_min_ps(m, _mm_movehl_ps(m, m));
    return _mm_cvtss_f32(_mm_min_ss(m, _mm_shuffle_ps(m, m, 1)));
}
inline float largest(Floats a) { return -smallest(Floats(0.0f) - a); }

template <bool Largest> inline Floats foldRows(const float (*rows)[W]) {
    const auto fold = [&](__m256 a, __m256 b) {
        return Largest ? _mm256_max_ps(a, b) : _mm256_min_ps(a, b);
    };
    __m256 two[4];
    for (int i = 0; i < 4; ++i) {
        const __m256 a = _mm256_load_ps(rows[i]), b = _mm256_load_ps(rows[i + 4]);
        two[i] = fold(_mm256_permute2f128_ps(a, b, 0x20), _mm256_permute2f128_ps(a, b, 0x31));
    }
    const auto four = [&](__m256 a, __m256 b) {
        return fold(_mm256_unpacklo_ps(a, b), _mm256_unpackhi_ps(a, b));
    };
    const __m256 a = four(two[0], two[1]), b = four(two[2], two[3]);
    return fold(_mm256_shuffle_ps(a, b, 0x44), _mm256_shuffle_ps(a, b, 0xee));
}
inline Floats smallestOfRows(const float (*rows)[W]) { return foldRows<false>(rows); }
inline Floats largestOfRows(const float (*rows)[W]) { return foldRows<true>(rows); }

inline void loadVectors(const float* p, Floats& x, Floats& y, Floats& z) {
    const auto halves = [&](int at) { // 4 floats of the first 4 vectors and 4 of the others
        return _mm256_set_m128(_mm_loadu_ps(p + at + 12), _mm_loadu_ps(p + at));
    };
    const __m256 a = halves(0), b = halves(4), c = halves(8);
    const __m256 xy = _mm256_shuffle_ps(b, c, _MM_SHUFFLE(2, 1, 3, 2));
    const __m256 yz = _mm256_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 2, 1));
    x = _mm256_shuffle_ps(a, xy, _MM_SHUFFLE(2, 0, 3, 0));
    y = _mm256_shuffle_ps(yz, xy, _MM_SHUFFLE(3, 1, 2, 0));
    z = _mm256_shuffle_ps(yz, c, _MM_SHUFFLE(3, 0, 3, 1));
}

LANES_END
