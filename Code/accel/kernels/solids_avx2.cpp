// solids.inl for the registers of avx2.cpp.
#include "accel/kernels/solids.h"

#if defined(__x86_64__)
#include "accel/kernels/exact_hit.h"
#include "accel/kernels/target.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <immintrin.h>
#include <limits>

KERNEL_REGION_BEGIN("avx2,fma,bmi,bmi2,lzcnt,popcnt")
namespace kernels::avx2 {
#include "accel/kernels/simd_avx2.inl"

inline Floats sqrt(Floats a) { return _mm256_sqrt_ps(a.v); }
inline Doubles sqrt(const Doubles& a) { return {_mm256_sqrt_pd(a.lo), _mm256_sqrt_pd(a.hi)}; }
inline unsigned atMost(const Doubles& a, const Doubles& b) {
    const auto half = [](__m256d x, __m256d y) {
        return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(x, y, _CMP_LE_OQ)));
    };
    return half(a.lo, b.lo) | half(a.hi, b.hi) << 4;
}

#include "accel/kernels/solids.inl"
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
