// All of the vocabulary that lane code is written in: the number types of registers.h and how they
// move between registers and memory.
#pragma once

#if defined(LANES_AVX512)
#include "simd/avx512_moves.h"
#elif defined(LANES_AVX2)
#include "simd/avx2_moves.h"
#elif defined(LANES_SSE)
#include "simd/sse_moves.h"
#else
#include "simd/one_moves.h"
#endif
