#if defined(__x86_64__)
#define LANES_AVX2
#include "unit/simd_ops.h"

std::span<const simd_ops::Op> simd_ops::avx2() { return kernels::avx2::kSimdOps; }
#endif
