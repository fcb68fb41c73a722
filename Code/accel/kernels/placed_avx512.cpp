// placed.inl for the registers of avx512.cpp.
#include "accel/kernels/placed.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"

AVX512_REGION_BEGIN
namespace kernels::avx512 {
#include "accel/kernels/simd_avx512.inl"

#include "accel/kernels/stack.inl"

#include "accel/kernels/ray_lanes.inl"

#include "accel/kernels/ray_lists.inl"

#include "accel/kernels/placed_mesh.inl"

#include "accel/kernels/placed.inl"
} // namespace kernels::avx512
KERNEL_REGION_END
#endif
