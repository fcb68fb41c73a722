// The CPU: which instruction sets it has, memory fetched ahead of its use, and regions of code that
// are compiled for one of the sets.
#pragma once

#include <cstddef>

#if defined(__x86_64__)
inline bool hasSse() {
    return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt");
}
inline bool hasAvx2() {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
}
inline bool hasAvx512() {
    return hasAvx2() && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512cd");
}
#endif

// Fetches all lines of the cache that an object aligned to them lies in; of others the last may be
// missing.
template <class T> inline void prefetch(const T& what) {
    const auto* const bytes = reinterpret_cast<const std::byte*>(&what);
    for (std::size_t at = 0; at < sizeof what; at += 64) __builtin_prefetch(bytes + at);
}

// Opens and closes a region whose functions are compiled for more than plain x86-64. The region
// starts after the last #include: what headers define stays plain and may be shared by the linker.

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
