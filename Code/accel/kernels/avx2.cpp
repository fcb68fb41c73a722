// 8 lanes: AVX2 and FMA as of 2013 (Haswell, Zen).
#include "accel/kernels/instances.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"

#include <vector>

AVX2_REGION_BEGIN
namespace kernels::avx2 {
#include "accel/kernels/simd_avx2.inl"

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
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
