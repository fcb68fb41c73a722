// Lamps in the registers of AVX2.
#include "render/waves/lamp_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"
#include "base/math.h"
#include "base/pow_tables.h"
#include "light/area_light.h"
#include "render/occluders.h"
#include "sample/warp.h"

AVX2_REGION_BEGIN
namespace kernels::avx2 {
#include "accel/kernels/simd_avx2.inl"

#include "accel/kernels/store_chosen_avx2.inl"

#include "accel/kernels/table_gather_avx2.inl"

#include "accel/kernels/pow_bits_avx2.inl"

#include "accel/kernels/pow_lanes.inl"

#include "render/waves/lit_lanes.inl"

#include "light/log_ratio.inl"
#include "render/waves/hidden_lanes.inl"
#include "render/waves/spot_cone.inl"

#include "render/waves/lamp_lanes.inl"
#include "render/waves/sobol_avx2.inl"
#include "render/waves/soft_lamp_lanes.inl"
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
