// Lamps in the registers of SSE4.2.
#include "render/waves/lamp_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "base/math.h"
#include "base/pow_tables.h"
#include "light/area_light.h"
#include "render/occluders.h"
#include "sample/warp.h"

SSE_REGION_BEGIN
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

#include "accel/kernels/store_chosen_sse.inl"

#include "accel/kernels/table_gather_sse.inl"

#include "accel/kernels/pow_bits_sse.inl"

#include "accel/kernels/pow_lanes.inl"

#include "render/waves/lit_lanes.inl"

#include "light/log_ratio.inl"
#include "render/waves/hidden_lanes.inl"
#include "render/waves/spot_cone.inl"

#include "render/waves/lamp_lanes.inl"
#include "render/waves/sobol_sse.inl"
#include "render/waves/soft_lamp_lanes.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
