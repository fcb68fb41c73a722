#include "render/waves/lamp_lanes.h"

#include "accel/kernels/by_kernel.h"

#define DECLARE(isa)                                                                               \
    namespace kernels::isa {                                                                       \
    void lightByLamp(const PointEmission&, const LitBlock&, unsigned, LitByLamp&);                 \
    void lightBySamples(const LampEmission&, const LitBlock&, const SamplesOnLamp&,                \
                        const Occluders&, const HiddenPoints&, LitBySamples&);                     \
    void wholeLight(const PointEmission&, const LitBlock&, unsigned, unsigned, WholeLight&);       \
    HiddenPoints hiddenPoints(const Occluders&, const LitBlock&, const LampBall&);                 \
    }
DECLARE_BY_KERNEL(DECLARE)
#define ROW(isa)                                                                                   \
    {                                                                                              \
        kernels::isa::lightByLamp, kernels::isa::lightBySamples, kernels::isa::wholeLight,         \
            kernels::isa::hiddenPoints                                                             \
    }

namespace {

struct Functions {
    LightByLampFn byLamp = nullptr;
    LightBySamplesFn bySamples = nullptr;
    WholeLightFn wholeLight = nullptr;
    HiddenPointsFn hiddenPoints = nullptr;
};

Functions functionsOf(const Kernel& kernel) {
    static constexpr ByKernel<Functions> kTable = BY_KERNEL(ROW);
    const Functions* const functions = kTable.of(kernel);
    return functions ? *functions : Functions{};
}

} // namespace

HiddenPointsFn hiddenPoints(const Kernel& kernel) { return functionsOf(kernel).hiddenPoints; }
LightByLampFn lightByLamp(const Kernel& kernel) { return functionsOf(kernel).byLamp; }
LightBySamplesFn lightBySamples(const Kernel& kernel) { return functionsOf(kernel).bySamples; }
WholeLightFn wholeLight(const Kernel& kernel) { return functionsOf(kernel).wholeLight; }
