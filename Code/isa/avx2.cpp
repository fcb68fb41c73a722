// 8 lanes; AVX2 and FMA as of 2013 (Haswell, Zen).
#if defined(__x86_64__)
#define LANES_AVX2
#include "base/cpu.h"
#include "isa/families.h"
#include "isa/instances.h"

constexpr Isa kAvx2Isa = kernels::avx2::isaOf("avx2", hasAvx2, &kAvx2Shading);
#endif
