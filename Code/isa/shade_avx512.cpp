// What shading does by the instructions of avx512.cpp.
#if defined(__x86_64__)
#define LANES_AVX512
#include "isa/instances.h"
#include "render/path/path_in_lanes.h"

constexpr PathKernel kAvx512Path{kernels::avx512::scatterBlock};
#endif
