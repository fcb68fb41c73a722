// environment_lanes.inl for the registers of AVX-512.
#include "render/waves/environment_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "base/atan_table.h"
#include "image/colour.h"

AVX512_REGION_BEGIN
namespace kernels::avx512 {
#include "accel/kernels/simd_avx512.inl"

#include "accel/kernels/table_gather_avx512.inl"

#include "render/waves/texel_lanes.inl"

#include "accel/kernels/double_double_lanes.inl"

#include "accel/kernels/angle_lanes.inl"

#include "render/waves/environment_lanes.inl"
} // namespace kernels::avx512
KERNEL_REGION_END
#endif
