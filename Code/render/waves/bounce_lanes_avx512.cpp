// bounce_lanes.inl for the registers of AVX-512.
#include "render/waves/bounce_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "accel/kernels/wide_tree.h"
#include "base/math.h"
#include "base/pow_tables.h"
#include "sample/warp.h"

AVX512_REGION_BEGIN
namespace kernels::avx512 {
#include "accel/kernels/simd_avx512.inl"

#include "accel/kernels/store_chosen_avx512.inl"

#include "accel/kernels/solids_columns_avx512.inl"

#include "accel/kernels/vectors3.inl"

// The lanes of a and b in turn: those of the lower and of the upper halves.
inline Floats lowInTurn(Floats a, Floats b) {
    const __m512i from = _mm512_setr_epi32(0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5, 21, 6, 22, 7, 23);
    return _mm512_permutex2var_ps(a.v, from, b.v);
}
inline Floats highInTurn(Floats a, Floats b) {
    const __m512i from =
        _mm512_setr_epi32(8, 24, 9, 25, 10, 26, 11, 27, 12, 28, 13, 29, 14, 30, 15, 31);
    return _mm512_permutex2var_ps(a.v, from, b.v);
}

#include "accel/kernels/table_gather_avx512.inl"

#include "accel/kernels/pow_bits_avx512.inl"

#include "accel/kernels/pow_lanes.inl"

#include "accel/kernels/double_double_lanes.inl"

#include "accel/kernels/pow_of_doubles.inl"

#include "render/waves/sobol_avx512.inl"

#include "render/waves/circle_lanes.inl"

#include "render/waves/frame_lanes.inl"

#include "render/waves/bounce_lanes.inl"
} // namespace kernels::avx512
KERNEL_REGION_END
#endif
