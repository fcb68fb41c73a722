// Opens and closes a region whose functions are compiled for more than plain x86-64. The region
// starts after the last #include: what headers define stays plain and may be shared by the linker.
#pragma once

#define KERNEL_PRAGMA(text) _Pragma(#text)
#if defined(__clang__)
#define KERNEL_REGION_BEGIN(isa)                                                                   \
    KERNEL_PRAGMA(clang attribute push(__attribute__((target(isa))), apply_to = function))
#define KERNEL_REGION_END KERNEL_PRAGMA(clang attribute pop)
#define KERNEL_QUIET
#else
#define KERNEL_REGION_BEGIN(isa) KERNEL_PRAGMA(GCC push_options) KERNEL_PRAGMA(GCC target(isa))
#define KERNEL_REGION_END KERNEL_PRAGMA(GCC pop_options)
// g++ 12 takes the undefined operands of its intrinsics for mistakes (GCC bug 105593).
#define KERNEL_QUIET                                                                               \
    KERNEL_PRAGMA(GCC diagnostic ignored "-Wuninitialized")                                        \
    KERNEL_PRAGMA(GCC diagnostic ignored "-Wmaybe-uninitialized")
#endif

// The sets of instructions that there are kernels for.
#define SSE_REGION_BEGIN KERNEL_REGION_BEGIN("sse4.2,popcnt")
#define AVX2_REGION_BEGIN KERNEL_REGION_BEGIN("avx2,fma,bmi,bmi2,lzcnt,popcnt")
#define AVX512_REGION_BEGIN                                                                        \
    KERNEL_QUIET KERNEL_REGION_BEGIN("avx512f,avx512dq,avx512bw,avx512vl,avx512cd,avx2,fma,bmi,"   \
                                     "bmi2,lzcnt,popcnt")
