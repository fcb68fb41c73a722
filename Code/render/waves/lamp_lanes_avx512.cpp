// Lamps in the registers of AVX-512.
#include "render/waves/lamp_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "base/math.h"
#include "base/pow_tables.h"
#include "light/area_light.h"
#include "render/occluders.h"
#include "sample/warp.h"

AVX512_REGION_BEGIN
namespace kernels::avx512 {
#include "accel/kernels/simd_avx512.inl"

#include "accel/kernels/store_chosen_avx512.inl"

#include "accel/kernels/table_gather_avx512.inl"

#include "accel/kernels/pow_bits_avx512.inl"

#include "accel/kernels/pow_lanes.inl"

#include "render/waves/lit_lanes.inl"

#include "light/log_ratio.inl"
#include "render/waves/hidden_lanes.inl"
#include "render/waves/spot_cone.inl"

#include "render/waves/lamp_lanes.inl"
#include "render/waves/sobol_avx512.inl"
#include "render/waves/soft_lamp_lanes.inl"
} // namespace kernels::avx512
KERNEL_REGION_END
#endif
