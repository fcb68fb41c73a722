// Surfaces in the registers of avx512.cpp.
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
inline Mask operator<(const Doubles& a, const Doubles& b) {
    const unsigned lo = _mm512_cmp_pd_mask(a.lo, b.lo, _CMP_LT_OQ),
                   hi = _mm512_cmp_pd_mask(a.hi, b.hi, _CMP_LT_OQ);
    return maskOf(lo | hi << 8);
}
inline Doubles select(Mask m, const Doubles& a, const Doubles& b) {
    return {_mm512_mask_blend_pd(static_cast<__mmask8>(m.v), b.lo, a.lo),
            _mm512_mask_blend_pd(static_cast<__mmask8>(m.v >> 8), b.hi, a.hi)};
}
} // namespace

#include "accel/kernels/vectors3.inl"

#include "accel/kernels/round_surfaces.inl"
#include "accel/kernels/triangle_surfaces.inl"
} // namespace kernels::avx512
KERNEL_REGION_END
#endif
