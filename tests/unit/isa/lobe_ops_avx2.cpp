#if defined(__x86_64__)
#define LANES_AVX2
#include "unit/lobe_ops.h"

void lobe_op::avx2(std::uint32_t kind, const Points& in, Results& out) {
    kernels::avx2::computeLobes(kind, in, out);
}
#endif
