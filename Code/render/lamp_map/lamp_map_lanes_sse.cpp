// The maps of lamps in the registers of SSE.
#include "render/lamp_map/lamp_map.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "accel/kernels/wide_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

SSE_REGION_BEGIN
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

#include "accel/kernels/solids_columns_sse.inl"

#include "accel/kernels/table_gather_sse.inl"

#include "render/lamp_map/lamp_map_lanes.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
