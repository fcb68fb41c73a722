#if defined(__x86_64__)
#define LANES_AVX512
#include "unit/lobe_ops.h"

void lobe_op::avx512(std::uint32_t kind, const Points& in, Results& out) {
    kernels::avx512::computeLobes(kind, in, out);
}
#endif
