#include "accel/kernels/by_kernel.h"
#include "render/lamp_map.h"

#define DECLARE(isa)                                                                               \
    namespace kernels::isa {                                                                       \
    HiddenByMap askLampMap(const LampMap&, const LitBlock&, const LitByLamp&, unsigned);           \
    }
DECLARE_BY_KERNEL(DECLARE)
#define ROW(isa) kernels::isa::askLampMap

AskLampMapFn askLampMap(const Kernel& kernel) {
    static constexpr ByKernel<AskLampMapFn> kTable = BY_KERNEL(ROW);
    const AskLampMapFn* const function = kTable.of(kernel);
    return function ? *function : nullptr;
}
