// The registers that hold a box of the builder: one of eight lanes, or two of four.
#pragma once

#if defined(LANES_SSE)
#include "accel/kernels/build/box_sse.h"
#else
#include "accel/kernels/build/box_avx2.h"
#endif
