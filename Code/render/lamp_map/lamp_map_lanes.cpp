#include "accel/kernels/by_kernel.h"
#include "render/lamp_map/lamp_map.h"

#define DECLARE(isa)                                                                               \
    namespace kernels::isa {                                                                       \
    void askLampMap(const LampMap&, std::span<const LitBlock>, std::span<LitByLamp>);              \
    }
DECLARE_BY_KERNEL(DECLARE)
#define ROW(isa) kernels::isa::askLampMap

AskLampMapFn askLampMap(const Kernel& kernel) {
    static constexpr ByKernel<AskLampMapFn> kTable = BY_KERNEL(ROW);
    const AskLampMapFn* const function = kTable.of(kernel);
    return function ? *function : nullptr;
}
