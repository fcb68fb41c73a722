// 8 lanes in pairs of registers; SSE4.2 as of 2008 (Nehalem, Bulldozer).
#if defined(__x86_64__)
#define LANES_SSE
#include "base/cpu.h"
#include "isa/families.h"
#include "isa/instances.h"

constexpr Isa kSseIsa = kernels::sse::isaOf("sse", hasSse, &kSseShading);
#endif
