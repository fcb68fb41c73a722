// lens_lanes.inl for the registers of SSE4.2.
#include "render/lens_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "base/math.h"
#include "sample/hash.h"
#include "sample/warp.h"

SSE_REGION_BEGIN
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

#include "accel/kernels/store_chosen_sse.inl"

#include "accel/kernels/vectors3.inl"

#include "render/waves/sobol_sse.inl"

#include "accel/kernels/table_gather_sse.inl"

#include "render/lens_lanes.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
