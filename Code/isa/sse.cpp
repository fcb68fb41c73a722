// 8 lanes in pairs of registers; SSE4.2 as of 2008 (Nehalem, Bulldozer).
#if defined(__x86_64__)
#define LANES_SSE
#include "accel/kernels/build/tree_builder.h"
#include "base/cpu.h"
#include "isa/families.h"
#include "isa/instances.h"

static constexpr kernels::build::TreeBuilder kSseTreeBuilder = kernels::sse::build::treeBuilder();
constexpr Isa kSseIsa = kernels::sse::isaOf("sse", hasSse, &kSseTreeBuilder, &kSseShading);
#endif
