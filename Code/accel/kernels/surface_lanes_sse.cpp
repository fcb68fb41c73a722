// Surfaces in the registers of sse.cpp.
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

KERNEL_REGION_BEGIN("sse4.2,popcnt")
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

namespace {

// fn(i) for each of the four registers.
template <class Fn> inline Doubles quarters(Fn&& fn) { return {fn(0), fn(1), fn(2), fn(3)}; }
inline Doubles sqrt(const Doubles& a) {
    return quarters([&](int i) { return _mm_sqrt_pd(a.v[i]); });
}
inline Doubles abs(const Doubles& a) {
    return quarters([&](int i) { return _mm_andnot_pd(_mm_set1_pd(-0.0), a.v[i]); });
}
inline Doubles max(const Doubles& a, const Doubles& b) {
    return quarters([&](int i) { return _mm_max_pd(a.v[i], b.v[i]); });
}
inline Mask operator<(const Doubles& a, const Doubles& b) {
    const auto less = [&](int i) { return _mm_castpd_ps(_mm_cmplt_pd(a.v[i], b.v[i])); };
    return {_mm_shuffle_ps(less(0), less(1), 0x88), _mm_shuffle_ps(less(2), less(3), 0x88)};
}
inline Doubles select(Mask m, const Doubles& a, const Doubles& b) {
    const __m128 twice[4] = {_mm_unpacklo_ps(m.lo, m.lo), _mm_unpackhi_ps(m.lo, m.lo),
                             _mm_unpacklo_ps(m.hi, m.hi), _mm_unpackhi_ps(m.hi, m.hi)};
    return quarters([&](int i) { return _mm_blendv_pd(b.v[i], a.v[i], _mm_castps_pd(twice[i])); });
}
} // namespace

#include "accel/kernels/vectors3.inl"

#include "accel/kernels/round_surfaces.inl"
#include "accel/kernels/triangle_surfaces.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
