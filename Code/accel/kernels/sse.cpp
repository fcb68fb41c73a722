// 8 lanes in pairs of registers: SSE4.2 as of 2008 (Nehalem, Bulldozer).
#include "accel/kernels/instances.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"

#include <vector>

SSE_REGION_BEGIN
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

#include "accel/kernels/key_range.inl"

#include "accel/kernels/barycentrics.inl"

#include "accel/kernels/stack.inl"

#include "accel/kernels/ray_lanes.inl"

#include "accel/kernels/queue_rays.inl"

#include "accel/kernels/queue_answers.inl"

#include "accel/kernels/edge_on.inl"

#include "accel/kernels/queue_exact.inl"

#include "accel/kernels/handful.inl"

#include "accel/kernels/queue.inl"

#include "accel/kernels/bundle_gaps.inl"

#include "accel/kernels/bundle_rays.inl"

#include "accel/kernels/bundle_keys.inl"

#include "accel/kernels/bundle_block.inl"

#include "accel/kernels/bundle_best.inl"

#include "accel/kernels/bundle_leaf.inl"

#include "accel/kernels/bundle.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
