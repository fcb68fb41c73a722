// The number types of this unit's instruction set (see region.h): W lanes of Floats, Ints, Doubles
// and their Mask.
#pragma once

#if defined(LANES_AVX512)
#include "simd/avx512.h"
#elif defined(LANES_AVX2)
#include "simd/avx2.h"
#elif defined(LANES_SSE)
#include "simd/sse.h"
#else
#include "simd/one.h"
#endif
