// 16 lanes; AVX-512 as of 2017 (Skylake-X, Zen 4). A box of the tree builder fills a register of
// AVX2, so that there is no other builder for it.
#if defined(__x86_64__)
#define LANES_AVX512
#include "base/cpu.h"
#include "isa/families.h"
#include "isa/instances.h"

constexpr Isa kAvx512Isa =
    kernels::avx512::isaOf("avx512", hasAvx512, &kernels::build::kAvx2TreeBuilder, &kAvx512Shading);
#endif
