// bounce_lanes.inl for the registers of SSE4.2.
#include "render/waves/bounce_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "accel/kernels/wide_tree.h"
#include "base/math.h"
#include "base/pow_tables.h"
#include "sample/warp.h"

SSE_REGION_BEGIN
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

#include "accel/kernels/store_chosen_sse.inl"

#include "accel/kernels/solids_columns_sse.inl"

#include "accel/kernels/vectors3.inl"

// The lanes of a and b in turn: those of the lower and of the upper halves.
inline Floats lowInTurn(Floats a, Floats b) {
    return {_mm_unpacklo_ps(a.lo, b.lo), _mm_unpackhi_ps(a.lo, b.lo)};
}
inline Floats highInTurn(Floats a, Floats b) {
    return {_mm_unpacklo_ps(a.hi, b.hi), _mm_unpackhi_ps(a.hi, b.hi)};
}

#include "accel/kernels/table_gather_sse.inl"

#include "accel/kernels/pow_bits_sse.inl"

#include "accel/kernels/pow_lanes.inl"

#include "accel/kernels/double_double_lanes.inl"

#include "accel/kernels/pow_of_doubles.inl"

#include "render/waves/sobol_sse.inl"

#include "render/waves/circle_lanes.inl"

#include "render/waves/frame_lanes.inl"

#include "render/waves/bounce_lanes.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
