// bounce_lanes.inl for the registers of SSE4.2.
#include "render/waves/bounce_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"

SSE_REGION_BEGIN
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

#include "accel/kernels/vectors3.inl"

#include "render/waves/bounce_lanes.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
