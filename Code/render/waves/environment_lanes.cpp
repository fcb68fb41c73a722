#include "render/waves/environment_lanes.h"

#include "accel/kernels/by_kernel.h"

#define DECLARE(isa)                                                                               \
    namespace kernels::isa {                                                                       \
    void environmentColors(const Environment::View&, EnvironmentBlock&, std::size_t);              \
    }
DECLARE_BY_KERNEL(DECLARE)
#define ROW(isa) kernels::isa::environmentColors

EnvironmentColorsFn environmentColors(const Kernel& kernel) {
    static constexpr ByKernel<EnvironmentColorsFn> kTable = BY_KERNEL(ROW);
    const EnvironmentColorsFn* const function = kTable.of(kernel);
    return function ? *function : nullptr;
}
