// sphere_surfaces.inl for the registers of sse.cpp.
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
// a, but b where `size` is not positive.
inline Doubles orWhereZero(const Doubles& size, const Doubles& a, double b) {
    return quarters([&](int i) {
        return _mm_blendv_pd(_mm_set1_pd(b), a.v[i], _mm_cmpgt_pd(size.v[i], _mm_setzero_pd()));
    });
}
} // namespace

#include "accel/kernels/sphere_surfaces.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
