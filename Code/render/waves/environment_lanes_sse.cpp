// environment_lanes.inl for the registers of SSE4.2.
#include "render/waves/environment_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "base/atan_table.h"
#include "image/colour.h"

SSE_REGION_BEGIN
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

#include "accel/kernels/table_gather_sse.inl"

#include "render/waves/texel_lanes.inl"

#include "accel/kernels/double_double_lanes.inl"

#include "accel/kernels/angle_lanes.inl"

#include "render/waves/environment_lanes.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
