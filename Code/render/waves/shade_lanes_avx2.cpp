// shade_lanes.inl for the registers of AVX2.
#include "render/waves/shade_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "accel/kernels/wide_tree.h"
#include "base/math.h"

AVX2_REGION_BEGIN
namespace kernels::avx2 {
#include "accel/kernels/simd_avx2.inl"

#include "accel/kernels/store_chosen_avx2.inl"

#include "accel/kernels/solids_columns_avx2.inl"

#include "accel/kernels/vectors3.inl"

#include "render/waves/shade_lanes.inl"
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
