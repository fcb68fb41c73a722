// planes.inl for the registers of SSE4.2.
#include "accel/kernels/planes.h"

#if defined(__x86_64__)
#include "accel/kernels/exact_hit.h" // kChosenLanes
#include "accel/kernels/target.h"
#include "base/math.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <immintrin.h>
#include <limits>

SSE_REGION_BEGIN
namespace kernels::sse {
#include "accel/kernels/simd_sse.inl"

#include "accel/kernels/vectors3.inl"

#include "accel/kernels/planes.inl"
} // namespace kernels::sse
KERNEL_REGION_END
#endif
