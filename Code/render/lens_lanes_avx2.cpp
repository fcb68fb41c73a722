// lens_lanes.inl for the registers of AVX2.
#include "render/lens_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "base/math.h"
#include "sample/hash.h"
#include "sample/warp.h"

AVX2_REGION_BEGIN
namespace kernels::avx2 {
#include "accel/kernels/simd_avx2.inl"

#include "accel/kernels/store_chosen_avx2.inl"

#include "accel/kernels/vectors3.inl"

#include "render/waves/sobol_avx2.inl"

#include "accel/kernels/table_gather_avx2.inl"

#include "render/lens_lanes.inl"
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
