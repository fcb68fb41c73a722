// solids.inl for the registers of avx512.cpp.
#include "accel/kernels/solids.h"

#if defined(__x86_64__)
#include "accel/kernels/exact_hit.h"
#include "accel/kernels/target.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <immintrin.h>
#include <limits>

// g++ 12 takes the undefined operands of its own intrinsics for mistakes (GCC bug 105593).
#if !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
KERNEL_REGION_BEGIN("avx512f,avx512dq,avx512bw,avx512vl,avx512cd,avx2,fma,bmi,bmi2,lzcnt,popcnt")
namespace kernels::avx512 {
#include "accel/kernels/simd_avx512.inl"

inline Floats sqrt(Floats a) { return _mm512_sqrt_ps(a.v); }
inline Doubles sqrt(const Doubles& a) { return {_mm512_sqrt_pd(a.lo), _mm512_sqrt_pd(a.hi)}; }
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
inline unsigned atMost(const Doubles& a, const Doubles& b) {
    return bits({_mm512_cmp_pd_mask(a.lo, b.lo, _CMP_LE_OQ)}) |
           bits({_mm512_cmp_pd_mask(a.hi, b.hi, _CMP_LE_OQ)}) << 8;
}

// Bits of W rows, asked for by columns.
class LaneMatrix {
public:
    LaneMatrix() : rows_(_mm256_setzero_si256()) {}
    void set(int row, unsigned columns) {
        rows_ = _mm256_mask_set1_epi16(rows_, static_cast<__mmask16>(1u << row),
                                       static_cast<short>(columns));
    }
    unsigned column(int i) const {
        return bits({_mm256_movepi16_mask(_mm256_sll_epi16(rows_, _mm_cvtsi32_si128(15 - i)))});
    }

private:
    __m256i rows_;
};

#include "accel/kernels/ray_lanes.inl"

#include "accel/kernels/solids.inl"
} // namespace kernels::avx512
KERNEL_REGION_END
#endif
