// 16 lanes; AVX-512 as of 2017 (Skylake-X, Zen 4).
#if defined(__x86_64__)
#define LANES_AVX512
#include "base/cpu.h"
#include "isa/families.h"
#include "isa/instances.h"

constexpr Isa kAvx512Isa = kernels::avx512::isaOf("avx512", hasAvx512, &kAvx512Shading);
#endif
