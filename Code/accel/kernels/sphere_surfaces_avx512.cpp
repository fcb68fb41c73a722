// sphere_surfaces.inl for the registers of avx512.cpp.
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

// g++ 12 takes the undefined operands of its own intrinsics for mistakes (GCC bug 105593).
#if !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
KERNEL_REGION_BEGIN("avx512f,avx512dq,avx512bw,avx512vl,avx512cd,avx2,fma,bmi,bmi2,lzcnt,popcnt")
namespace kernels::avx512 {
#include "accel/kernels/simd_avx512.inl"

namespace {

inline Doubles sqrt(const Doubles& a) { return {_mm512_sqrt_pd(a.lo), _mm512_sqrt_pd(a.hi)}; }
inline Doubles abs(const Doubles& a) { return {_mm512_abs_pd(a.lo), _mm512_abs_pd(a.hi)}; }
inline Doubles max(const Doubles& a, const Doubles& b) {
    return {_mm512_max_pd(a.lo, b.lo), _mm512_max_pd(a.hi, b.hi)};
}
// a, but b where `size` is not positive.
inline Doubles orWhereZero(const Doubles& size, const Doubles& a, double b) {
    const auto half = [b](__m512d s, __m512d x) {
        return _mm512_mask_blend_pd(_mm512_cmp_pd_mask(s, _mm512_setzero_pd(), _CMP_GT_OQ),
                                    _mm512_set1_pd(b), x);
    };
    return {half(size.lo, a.lo), half(size.hi, a.hi)};
}
} // namespace

#include "accel/kernels/sphere_surfaces.inl"
} // namespace kernels::avx512
KERNEL_REGION_END
#endif
