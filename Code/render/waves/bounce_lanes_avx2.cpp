// bounce_lanes.inl for the registers of AVX2.
#include "render/waves/bounce_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "accel/kernels/wide_tree.h"
#include "base/math.h"
#include "base/pow_tables.h"
#include "sample/warp.h"

AVX2_REGION_BEGIN
namespace kernels::avx2 {
#include "accel/kernels/simd_avx2.inl"

#include "accel/kernels/store_chosen_avx2.inl"

#include "accel/kernels/solids_columns_avx2.inl"

#include "accel/kernels/vectors3.inl"

// The lanes of a and b in turn: those of the lower and of the upper halves.
inline Floats lowInTurn(Floats a, Floats b) {
    const __m256 low = _mm256_unpacklo_ps(a.v, b.v), high = _mm256_unpackhi_ps(a.v, b.v);
    return _mm256_permute2f128_ps(low, high, 0x20);
}
inline Floats highInTurn(Floats a, Floats b) {
    const __m256 low = _mm256_unpacklo_ps(a.v, b.v), high = _mm256_unpackhi_ps(a.v, b.v);
    return _mm256_permute2f128_ps(low, high, 0x31);
}

#include "accel/kernels/table_gather_avx2.inl"

#include "accel/kernels/pow_bits_avx2.inl"

#include "accel/kernels/pow_lanes.inl"

#include "accel/kernels/double_double_lanes.inl"

#include "accel/kernels/pow_of_doubles.inl"

#include "render/waves/sobol_avx2.inl"

#include "render/waves/circle_lanes.inl"

#include "render/waves/frame_lanes.inl"

#include "render/waves/bounce_lanes.inl"
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
