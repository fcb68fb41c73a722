// 8 lanes: AVX2 and FMA as of 2013 (Haswell, Zen).
#include "accel/kernels/instances.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"

#include <vector>

AVX2_REGION_BEGIN
namespace kernels::avx2 {
#include "accel/kernels/simd_avx2.inl"

#include "accel/kernels/kernel.inl"
} // namespace kernels::avx2
KERNEL_REGION_END
#endif
