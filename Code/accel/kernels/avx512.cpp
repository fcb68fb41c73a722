// 16 lanes: AVX-512 as of 2017 (Skylake-X, Zen 4).
#include "accel/kernels/instances.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"

#include <vector>

AVX512_REGION_BEGIN
namespace kernels::avx512 {
#include "accel/kernels/simd_avx512.inl"

#include "accel/kernels/kernel.inl"
} // namespace kernels::avx512
KERNEL_REGION_END
#endif
