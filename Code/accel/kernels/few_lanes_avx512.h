// A few of W lanes, one behind the other in a register of their own: where rays go apart, one to
// four of them meet most solids, and sixteen divisions and roots take four times as long. The bits
// are the same in any register. Included by solids_avx512.cpp behind all_lanes.inl.
#pragma once

#include "simd/lanes.h"

#include <immintrin.h>

LANES_BEGIN

struct FewDoubles {
    __m256d v;
    FewDoubles(__m256d a) : v(a) {}
    FewDoubles(double a) : v(_mm256_set1_pd(a)) {}
};
inline FewDoubles operator+(FewDoubles a, FewDoubles b) { return _mm256_add_pd(a.v, b.v); }
inline FewDoubles operator-(FewDoubles a, FewDoubles b) { return _mm256_sub_pd(a.v, b.v); }
inline FewDoubles operator*(FewDoubles a, FewDoubles b) { return _mm256_mul_pd(a.v, b.v); }
inline FewDoubles operator/(FewDoubles a, FewDoubles b) { return _mm256_div_pd(a.v, b.v); }
inline FewDoubles sqrt(FewDoubles a) { return _mm256_sqrt_pd(a.v); }
inline unsigned less(FewDoubles a, FewDoubles b) {
    return _mm256_cmp_pd_mask(a.v, b.v, _CMP_LT_OQ);
}
inline unsigned atMost(FewDoubles a, FewDoubles b) {
    return _mm256_cmp_pd_mask(a.v, b.v, _CMP_LE_OQ);
}

class FewLanes {
public:
    using Numbers = FewDoubles;
    static constexpr int kMost = 4;

    explicit FewLanes(unsigned lanes)
        : lanes_(lanes), order_(_mm512_castsi512_si128(
                             _mm512_maskz_compress_epi32(maskOf(lanes).v, Ints::from(0).v))) {}

    Numbers pick(Floats a) const {
        const __m512i order = _mm512_castsi128_si512(order_);
        return _mm256_cvtps_pd(_mm512_castps512_ps128(_mm512_permutexvar_ps(order, a.v)));
    }
    unsigned pick(unsigned lanes) const { return _pext_u32(lanes, lanes_); }
    unsigned all() const { return _pext_u32(lanes_, lanes_); }

    static __m128 rounded(Numbers a) { return _mm256_cvtpd_ps(a.v); }
    static Numbers exact(__m128 a) { return _mm256_cvtps_pd(a); }
    Floats putBack(__m128 a) const {
        return _mm512_maskz_expand_ps(maskOf(lanes_).v, _mm512_castps128_ps512(a));
    }
    unsigned putBack(unsigned few) const { return _pdep_u32(few, lanes_); }

private:
    unsigned lanes_;
    __m128i order_;
};

LANES_END
