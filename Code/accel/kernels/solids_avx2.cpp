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
inline Doubles min(const Doubles& a, const Doubles& b) {
    return {_mm256_min_pd(a.lo, b.lo), _mm256_min_pd(a.hi, b.hi)};
}
inline Doubles max(const Doubles& a, const Doubles& b) {
    return {_mm256_max_pd(a.lo, b.lo), _mm256_max_pd(a.hi, b.hi)};
}
inline Doubles withSign(const Doubles& a, const Doubles& of) {
    const __m256d sign = _mm256_set1_pd(-0.0);
    const auto half = [&](__m256d x, __m256d y) {
        return _mm256_or_pd(_mm256_andnot_pd(sign, x), _mm256_and_pd(sign, y));
    };
    return {half(a.lo, of.lo), half(a.hi, of.hi)};
}
inline unsigned atMost(const Doubles& a, const Doubles& b) {
    const auto half = [](__m256d x, __m256d y) {
        return static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(x, y, _CMP_LE_OQ)));
    };
    return half(a.lo, b.lo) | half(a.hi, b.hi) << 4;
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
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
