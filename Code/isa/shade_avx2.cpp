// What shading does by the instructions of avx2.cpp.
#if defined(__x86_64__)
#define LANES_AVX2
#include "isa/instances.h"
#include "render/path/path_in_lanes.h"

constexpr PathKernel kAvx2Path{kernels::avx2::scatterBlock};
#endif
