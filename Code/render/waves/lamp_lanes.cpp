#include "render/waves/lamp_lanes.h"

#include <string_view>

#define LIGHT_IN_LANES(isa)                                                                        \
    namespace kernels::isa {                                                                       \
    void lightByLamp(const PointEmission&, const LitBlock&, unsigned, LitByLamp&);                 \
    void lightBySamples(const PointEmission&, const LitBlock&, const SamplesOnLamp&,               \
                        const Occluders&, const HiddenPoints&, LitBySamples&);                     \
    HiddenPoints hiddenPoints(const Occluders&, const LitBlock&, const PointEmission&);            \
    }
LIGHT_IN_LANES(sse)
LIGHT_IN_LANES(avx2)
LIGHT_IN_LANES(avx512)
#undef LIGHT_IN_LANES

namespace {

struct Row {
    std::string_view name;
    LightByLampFn byLamp = nullptr;
    LightBySamplesFn bySamples = nullptr;
    HiddenPointsFn hiddenPoints = nullptr;
};

Row rowOf([[maybe_unused]] const Kernel& kernel) {
#if defined(__x86_64__)
    static constexpr Row kTable[] = {
        {"avx512", kernels::avx512::lightByLamp, kernels::avx512::lightBySamples,
         kernels::avx512::hiddenPoints},
        {"avx2", kernels::avx2::lightByLamp, kernels::avx2::lightBySamples,
         kernels::avx2::hiddenPoints},
        {"sse", kernels::sse::lightByLamp, kernels::sse::lightBySamples,
         kernels::sse::hiddenPoints},
    };
    for (const Row& row : kTable)
        if (row.name == kernel.name) return row;
#endif
    return {};
}

} // namespace

HiddenPointsFn hiddenPoints(const Kernel& kernel) { return rowOf(kernel).hiddenPoints; }
LightByLampFn lightByLamp(const Kernel& kernel) { return rowOf(kernel).byLamp; }
LightBySamplesFn lightBySamples(const Kernel& kernel) { return rowOf(kernel).bySamples; }
