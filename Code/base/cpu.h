// What the instruction sets of the kernels ask of the CPU.
#pragma once

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
