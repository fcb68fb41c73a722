// solids.inl for the registers of sse.cpp.
#include "accel/kernels/solids.h"

#if defined(__x86_64__)
#include "accel/kernels/exact_hit.h"
#include "accel/kernels/target.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <immintrin.h>
#include <limits>

KERNEL_REGION_BEGIN("sse4.2,popcnt")
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

inline Floats sqrt(Floats a) { return {_mm_sqrt_ps(a.lo), _mm_sqrt_ps(a.hi)}; }
inline Doubles sqrt(const Doubles& a) {
    return {_mm_sqrt_pd(a.v[0]), _mm_sqrt_pd(a.v[1]), _mm_sqrt_pd(a.v[2]), _mm_sqrt_pd(a.v[3])};
}
inline unsigned atMost(const Doubles& a, const Doubles& b) {
    unsigned all = 0;
    for (int i = 0; i < 4; ++i)
        all |= static_cast<unsigned>(_mm_movemask_pd(_mm_cmple_pd(a.v[i], b.v[i]))) << 2 * i;
    return all;
}

#include "accel/kernels/solids.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
