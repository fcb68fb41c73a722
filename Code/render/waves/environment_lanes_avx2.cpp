// environment_lanes.inl for the registers of AVX2.
#include "render/waves/environment_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "base/atan_table.h"
#include "image/colour.h"

AVX2_REGION_BEGIN
namespace kernels::avx2 {
#include "accel/kernels/simd_avx2.inl"

#include "accel/kernels/table_gather_avx2.inl"

#include "render/waves/texel_lanes.inl"

#include "accel/kernels/double_double_lanes.inl"

#include "accel/kernels/angle_lanes.inl"

#include "render/waves/environment_lanes.inl"
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
