// solids.inl for the registers of avx2.cpp.
#include "accel/kernels/solids.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "base/rounder.h"

AVX2_REGION_BEGIN
namespace kernels::avx2 {
#include "accel/kernels/simd_avx2.inl"

#include "accel/kernels/ray_lanes.inl"

#include "accel/kernels/solids_columns_avx2.inl"

#include "accel/kernels/all_lanes.inl"

using FewLanes = AllLanes; // see few_lanes_avx512.inl

#include "accel/kernels/solids.inl"

#include "accel/kernels/boxed.inl"
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
