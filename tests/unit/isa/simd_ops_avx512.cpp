#if defined(__x86_64__)
#define LANES_AVX512
#include "unit/simd_ops.h"

std::span<const simd_ops::Op> simd_ops::avx512() { return kernels::avx512::kSimdOps; }
#endif
