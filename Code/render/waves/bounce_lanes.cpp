#include "render/waves/bounce_lanes.h"

#include "accel/kernels/by_kernel.h"

#define DECLARE(isa)                                                                               \
    namespace kernels::isa {                                                                       \
    void bouncesInLanes(BounceBlock&);                                                             \
    }
DECLARE_BY_KERNEL(DECLARE)
#define ROW(isa) kernels::isa::bouncesInLanes

BouncesFn bouncesInLanes(const Kernel& kernel) {
    static constexpr ByKernel<BouncesFn> kTable = BY_KERNEL(ROW);
    const BouncesFn* const function = kTable.of(kernel);
    return function ? *function : nullptr;
}
