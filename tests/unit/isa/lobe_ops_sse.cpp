#if defined(__x86_64__)
#define LANES_SSE
#include "unit/lobe_ops.h"

void lobe_op::sse(std::uint32_t kind, const Points& in, Results& out) {
    kernels::sse::computeLobes(kind, in, out);
}
#endif
