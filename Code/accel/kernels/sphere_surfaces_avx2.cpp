// sphere_surfaces.inl for the registers of avx2.cpp.
#include "accel/kernels/sphere_surfaces.h"

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
// a, but b where `size` is not positive.
inline Doubles orWhereZero(const Doubles& size, const Doubles& a, double b) {
    const auto half = [b](__m256d s, __m256d x) {
        return _mm256_blendv_pd(_mm256_set1_pd(b), x,
                                _mm256_cmp_pd(s, _mm256_setzero_pd(), _CMP_GT_OQ));
    };
    return {half(size.lo, a.lo), half(size.hi, a.hi)};
}
} // namespace

#include "accel/kernels/sphere_surfaces.inl"
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
