#if defined(__x86_64__)
#define LANES_SSE
#include "unit/simd_ops.h"

std::span<const simd_ops::Op> simd_ops::sse() { return kernels::sse::kSimdOps; }
#endif
