// lamp_lanes.inl for the registers of SSE4.2.
#include "render/waves/lamp_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/target.h"
#include "base/math.h"
#include "light/light.h"

#include <bit>
#include <cmath>
#include <immintrin.h>
#include <limits>

KERNEL_REGION_BEGIN("sse4.2,popcnt")
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

inline Floats sqrt(Floats a) { return {_mm_sqrt_ps(a.lo), _mm_sqrt_ps(a.hi)}; }
// fn of the pairs of registers.
template <class Fn> Doubles each(const Doubles& a, const Doubles& b, Fn&& fn) {
    return {fn(a.v[0], b.v[0]), fn(a.v[1], b.v[1]), fn(a.v[2], b.v[2]), fn(a.v[3], b.v[3])};
}
inline Doubles sqrt(const Doubles& a) {
    return each(a, a, [](__m128d x, __m128d) { return _mm_sqrt_pd(x); });
}
inline Doubles abs(const Doubles& a) {
    return each(a, a, [](__m128d x, __m128d) { return _mm_andnot_pd(_mm_set1_pd(-0.0), x); });
}
inline Doubles max(const Doubles& a, const Doubles& b) {
    return each(a, b, [](__m128d x, __m128d y) { return _mm_max_pd(x, y); });
}
inline unsigned less(const Doubles& a, const Doubles& b) {
    unsigned all = 0;
    for (int i = 0; i < 4; ++i)
        all |= static_cast<unsigned>(_mm_movemask_pd(_mm_cmplt_pd(a.v[i], b.v[i]))) << 2 * i;
    return all;
}

#include "render/waves/lamp_lanes.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
