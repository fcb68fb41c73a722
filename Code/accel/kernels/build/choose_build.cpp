#include "accel/kernels/build/instances.h"
#include "base/cpu.h"

#if defined(__x86_64__)
namespace {

using namespace kernels::build;

#define BUILD_CODE(isa, supported)                                                                 \
    {                                                                                              \
#isa, supported, isa::makePrims, isa::takeBoxes, isa::gridOver, isa::fillBins,             \
            isa::mergeBins, isa::chooseSplit, isa::makeChildren, isa::divide, isa::growSubtree8,   \
            isa::growSubtree16, isa::growSingles                                                   \
    }
constexpr BuildCode kTable[] = {BUILD_CODE(avx2, hasAvx2), BUILD_CODE(sse, hasSse)};

} // namespace

std::span<const BuildCode> kernels::build::allBuildCodes() { return kTable; }
#else
std::span<const kernels::build::BuildCode> kernels::build::allBuildCodes() { return {}; }
#endif
