// LANES_BEGIN and LANES_END: code between them is compiled for one set of instructions, in a
// namespace of its own, and within it in an unnamed one: all of it belongs to its unit. A unit says
// which by defining LANES_SSE, LANES_AVX2 or LANES_AVX512 before its first #include; any other unit
// gets the plain one-lane code. Headers include all they need before LANES_BEGIN, so that what they
// share with other units is compiled without these instructions.
#pragma once

#include "base/cpu.h"

#if defined(LANES_AVX512)
#define LANES_BEGIN                                                                                \
    AVX512_REGION_BEGIN namespace kernels::avx512 {                                                \
        namespace {
#elif defined(LANES_AVX2)
#define LANES_BEGIN                                                                                \
    AVX2_REGION_BEGIN namespace kernels::avx2 {                                                    \
        namespace {
#elif defined(LANES_SSE)
#define LANES_BEGIN                                                                                \
    SSE_REGION_BEGIN namespace kernels::sse {                                                      \
        namespace {
#else
#define LANES_BEGIN                                                                                \
    namespace kernels::one {                                                                       \
    namespace {
#endif

#if defined(LANES_AVX512) || defined(LANES_AVX2) || defined(LANES_SSE)
#define LANES_END                                                                                  \
    }                                                                                              \
    }                                                                                              \
    KERNEL_REGION_END
#else
#define LANES_END                                                                                  \
    }                                                                                              \
    }
#endif
