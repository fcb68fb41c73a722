// What the instruction sets of the kernels ask of the CPU.
#pragma once

#if defined(__x86_64__)
// glibc has asked the CPU before the program starts. The compiler's own function asks again, and
// where the machine is virtual its host answers each of the questions: 0.1 ms of every start.
// (clang++ does not read that header: _Bool is no word of C++.)
#if __has_include(<sys/platform/x86.h>) && !defined(__clang__)
#include <sys/platform/x86.h>
#endif
#if defined(CPU_FEATURE_ACTIVE)
#define CPU_HAS(feature, nameForCompiler) CPU_FEATURE_ACTIVE(feature)
#else
#define CPU_HAS(feature, nameForCompiler) (__builtin_cpu_supports(nameForCompiler) != 0)
#endif

inline bool hasSse() { return CPU_HAS(SSE4_2, "sse4.2") && CPU_HAS(POPCNT, "popcnt"); }
inline bool hasAvx2() {
    return CPU_HAS(AVX2, "avx2") && CPU_HAS(FMA, "fma") && CPU_HAS(BMI1, "bmi") &&
           CPU_HAS(BMI2, "bmi2");
}
inline bool hasAvx512() {
    return hasAvx2() && CPU_HAS(AVX512F, "avx512f") && CPU_HAS(AVX512DQ, "avx512dq") &&
           CPU_HAS(AVX512BW, "avx512bw") && CPU_HAS(AVX512VL, "avx512vl") &&
           CPU_HAS(AVX512CD, "avx512cd");
}
inline bool hasCarrylessProducts() { return CPU_HAS(PCLMULQDQ, "pclmul"); }

#undef CPU_HAS
#endif
