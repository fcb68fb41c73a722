// placed.inl for the registers of sse.cpp.
#include "accel/kernels/placed.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"

SSE_REGION_BEGIN
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

#include "accel/kernels/stack.inl"

#include "accel/kernels/ray_lanes.inl"

#include "accel/kernels/ray_lists.inl"

#include "accel/kernels/placed_mesh.inl"

#include "accel/kernels/placed.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
