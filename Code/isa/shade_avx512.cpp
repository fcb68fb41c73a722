// What shading does by the instructions of avx512.cpp.
#if defined(__x86_64__)
#define LANES_AVX512
#include "isa/instances.h"
#include "integrate/shading_in_lanes.h"

constexpr ShadingKernel kAvx512Shading = kernels::avx512::kShading;
#endif
