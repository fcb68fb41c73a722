// lamp_lanes.inl for the registers of AVX2.
#include "render/waves/lamp_lanes.h"

#if defined(__x86_64__)
#include "accel/kernels/exact_hit.h" // kChosenLanes
#include "accel/kernels/target.h"
#include "base/math.h"
#include "light/light.h"

#include <bit>
#include <cmath>
#include <immintrin.h>
#include <limits>

AVX2_REGION_BEGIN
namespace kernels::avx2 {
#include "accel/kernels/simd_avx2.inl"

#include "render/waves/lamp_lanes.inl"
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
