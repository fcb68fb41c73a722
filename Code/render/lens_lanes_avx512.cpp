// lens_lanes.inl for the registers of AVX-512.
#include "render/lens_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "base/math.h"
#include "sample/hash.h"
#include "sample/warp.h"

AVX512_REGION_BEGIN
namespace kernels::avx512 {
#include "accel/kernels/simd_avx512.inl"

#include "accel/kernels/store_chosen_avx512.inl"

#include "accel/kernels/vectors3.inl"

#include "render/waves/sobol_avx512.inl"

#include "accel/kernels/table_gather_avx512.inl"

#include "render/lens_lanes.inl"
} // namespace kernels::avx512
KERNEL_REGION_END
#endif
