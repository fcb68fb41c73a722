// placed.inl for the registers of avx512.cpp.
#include "accel/kernels/placed.h"

#if defined(__x86_64__)
#include "accel/kernels/exact_hit.h"
#include "accel/kernels/target.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <immintrin.h>
#include <limits>

// g++ 12 takes the undefined operands of its own intrinsics for mistakes (GCC bug 105593).
#if !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
KERNEL_REGION_BEGIN("avx512f,avx512dq,avx512bw,avx512vl,avx512cd,avx2,fma,bmi,bmi2,lzcnt,popcnt")
namespace kernels::avx512 {
#include "accel/kernels/simd_avx512.inl"

#include "accel/kernels/stack.inl"

#include "accel/kernels/ray_lanes.inl"

#include "accel/kernels/placed_mesh.inl"

#include "accel/kernels/placed.inl"
} // namespace kernels::avx512
KERNEL_REGION_END
#endif
