// lamp_lanes.inl for the registers of AVX-512.
#include "render/waves/lamp_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/target.h"
#include "base/math.h"
#include "light/light.h"

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
inline Doubles abs(const Doubles& a) { return {_mm512_abs_pd(a.lo), _mm512_abs_pd(a.hi)}; }
inline Doubles max(const Doubles& a, const Doubles& b) {
    return {_mm512_max_pd(a.lo, b.lo), _mm512_max_pd(a.hi, b.hi)};
}
inline unsigned less(const Doubles& a, const Doubles& b) {
    return bits({_mm512_cmp_pd_mask(a.lo, b.lo, _CMP_LT_OQ)}) |
           bits({_mm512_cmp_pd_mask(a.hi, b.hi, _CMP_LT_OQ)}) << 8;
}

#include "render/waves/lamp_lanes.inl"
} // namespace kernels::avx512
KERNEL_REGION_END
#endif
