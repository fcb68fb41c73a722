// What shading does by the instructions of avx2.cpp.
#if defined(__x86_64__)
#define LANES_AVX2
#include "isa/instances.h"
#include "integrate/shading_in_lanes.h"

constexpr ShadingKernel kAvx2Shading = kernels::avx2::kShading;
#endif
