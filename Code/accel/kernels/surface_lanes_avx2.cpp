// Surfaces in the registers of avx2.cpp.
#include "accel/kernels/surface_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/exact_hit.h"
#include "accel/kernels/target.h"
#include "base/math.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <immintrin.h>
#include <limits>

KERNEL_REGION_BEGIN("avx2,fma,bmi,bmi2,lzcnt,popcnt")
namespace kernels::avx2 {
#include "accel/kernels/simd_avx2.inl"

namespace {

inline Doubles sqrt(const Doubles& a) { return {_mm256_sqrt_pd(a.lo), _mm256_sqrt_pd(a.hi)}; }
inline Doubles abs(const Doubles& a) {
    const __m256d sign = _mm256_set1_pd(-0.0);
    return {_mm256_andnot_pd(sign, a.lo), _mm256_andnot_pd(sign, a.hi)};
}
inline Doubles max(const Doubles& a, const Doubles& b) {
    return {_mm256_max_pd(a.lo, b.lo), _mm256_max_pd(a.hi, b.hi)};
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
} // namespace

#include "accel/kernels/vectors3.inl"

#include "accel/kernels/round_surfaces.inl"
#include "accel/kernels/triangle_surfaces.inl"
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
