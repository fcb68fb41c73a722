// What shading does by the instructions of sse.cpp.
#if defined(__x86_64__)
#define LANES_SSE
#include "isa/instances.h"
#include "integrate/shading_in_lanes.h"

constexpr ShadingKernel kSseShading = kernels::sse::kShading;
#endif
