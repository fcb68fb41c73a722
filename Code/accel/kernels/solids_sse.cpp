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
inline Doubles min(const Doubles& a, const Doubles& b) {
    return {_mm_min_pd(a.v[0], b.v[0]), _mm_min_pd(a.v[1], b.v[1]), _mm_min_pd(a.v[2], b.v[2]),
            _mm_min_pd(a.v[3], b.v[3])};
}
inline Doubles max(const Doubles& a, const Doubles& b) {
    return {_mm_max_pd(a.v[0], b.v[0]), _mm_max_pd(a.v[1], b.v[1]), _mm_max_pd(a.v[2], b.v[2]),
            _mm_max_pd(a.v[3], b.v[3])};
}
inline Doubles withSign(const Doubles& a, const Doubles& of) {
    const __m128d sign = _mm_set1_pd(-0.0);
    const auto part = [&](__m128d x, __m128d y) {
        return _mm_or_pd(_mm_andnot_pd(sign, x), _mm_and_pd(sign, y));
    };
    return {part(a.v[0], of.v[0]), part(a.v[1], of.v[1]), part(a.v[2], of.v[2]),
            part(a.v[3], of.v[3])};
}
inline unsigned atMost(const Doubles& a, const Doubles& b) {
    unsigned all = 0;
    for (int i = 0; i < 4; ++i)
        all |= static_cast<unsigned>(_mm_movemask_pd(_mm_cmple_pd(a.v[i], b.v[i]))) << 2 * i;
    return all;
}

// Bits of 8 rows of 8, asked for by columns.
class LaneMatrix {
public:
    void set(int row, unsigned columns) { rows_ |= std::uint64_t{columns} << 8 * row; }
    // The factor brings bit 0 of byte k to bit 56 + k, and no two products meet.
    unsigned column(int i) const {
        return static_cast<unsigned>((rows_ >> i & 0x0101010101010101u) * 0x0102040810204080u >>
                                     56);
    }

private:
    std::uint64_t rows_ = 0;
};

#include "accel/kernels/ray_lanes.inl"

#include "accel/kernels/solids.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
