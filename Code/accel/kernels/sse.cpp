// 8 lanes in pairs of registers: SSE4.2 as of 2008 (Nehalem, Bulldozer).
#include "accel/kernels/instances.h"

#if defined(__x86_64__)
#include "accel/kernels/region_includes.h"

#include <vector>

SSE_REGION_BEGIN
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

#include "accel/kernels/kernel.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
