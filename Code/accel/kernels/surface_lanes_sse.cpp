// Surfaces in the registers of sse.cpp.
#include "accel/kernels/surface_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "accel/kernels/wide_tree.h"
#include "base/atan_table.h"
#include "base/math.h"

SSE_REGION_BEGIN
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

#include "accel/kernels/solids_columns_sse.inl"

#include "accel/kernels/vectors3.inl"

#include "accel/kernels/table_gather_sse.inl"

#include "accel/kernels/double_double_lanes.inl"

#include "accel/kernels/angle_lanes.inl"

#include "accel/kernels/still_surfaces.inl"

#include "accel/kernels/still_balls.inl"
#include "accel/kernels/triangle_surfaces.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
