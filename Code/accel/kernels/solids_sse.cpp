// solids.inl for the registers of sse.cpp.
#include "accel/kernels/solids.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "base/rounder.h"

SSE_REGION_BEGIN
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

#include "accel/kernels/ray_lanes.inl"

#include "accel/kernels/solids_columns_sse.inl"

#include "accel/kernels/all_lanes.inl"

using FewLanes = AllLanes; // see few_lanes_avx512.inl

#include "accel/kernels/solids.inl"

#include "accel/kernels/boxed.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
