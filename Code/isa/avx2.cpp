// 8 lanes; AVX2 and FMA as of 2013 (Haswell, Zen).
#if defined(__x86_64__)
#define LANES_AVX2
#include "accel/kernels/build/tree_builder.h"
#include "base/cpu.h"
#include "isa/families.h"
#include "isa/instances.h"

namespace kernels::build {
constexpr TreeBuilder kAvx2TreeBuilder = avx2::build::treeBuilder();
}
constexpr Isa kAvx2Isa =
    kernels::avx2::isaOf("avx2", hasAvx2, &kernels::build::kAvx2TreeBuilder, &kAvx2Shading);
#endif
