// lamp_lanes.inl for the registers of AVX2.
#include "render/waves/lamp_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/exact_hit.h" // kChosenLanes
#include "accel/kernels/target.h"
#include "base/math.h"
#include "light/light.h"

#include <bit>
#include <cmath>
#include <immintrin.h>
#include <limits>

KERNEL_REGION_BEGIN("avx2,fma,bmi,bmi2,lzcnt,popcnt")
namespace kernels::avx2 {
#include "accel/kernels/simd_avx2.inl"

inline Floats sqrt(Floats a) { return _mm256_sqrt_ps(a.v); }
inline Doubles sqrt(const Doubles& a) { return {_mm256_sqrt_pd(a.lo), _mm256_sqrt_pd(a.hi)}; }
inline Doubles abs(const Doubles& a) {
    const __m256d sign = _mm256_set1_pd(-0.0);
    return {_mm256_andnot_pd(sign, a.lo), _mm256_andnot_pd(sign, a.hi)};
}
inline Doubles max(const Doubles& a, const Doubles& b) {
    return {_mm256_max_pd(a.lo, b.lo), _mm256_max_pd(a.hi, b.hi)};
}
inline unsigned less(const Doubles& a, const Doubles& b) {
    const auto half = [](__m256d x, __m256d y) {
        return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(x, y, _CMP_LT_OQ)));
    };
    return half(a.lo, b.lo) | half(a.hi, b.hi) << 4;
}

#include "render/waves/lamp_lanes.inl"
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
