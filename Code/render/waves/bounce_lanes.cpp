#include "render/waves/bounce_lanes.h"

#include "accel/kernels/kernels.h"

#include <string_view>

#define BOUNCES_IN_LANES(isa)                                                                      \
    namespace kernels::isa {                                                                       \
    void bouncesInLanes(BounceBlock&);                                                             \
    }
BOUNCES_IN_LANES(sse)
BOUNCES_IN_LANES(avx2)
BOUNCES_IN_LANES(avx512)
#undef BOUNCES_IN_LANES

BouncesFn bouncesInLanes([[maybe_unused]] const Kernel& kernel) {
#if defined(__x86_64__)
    static constexpr struct {
        std::string_view name;
        BouncesFn fn;
    } kTable[] = {
        {"avx512", kernels::avx512::bouncesInLanes},
        {"avx2", kernels::avx2::bouncesInLanes},
        {"sse", kernels::sse::bouncesInLanes},
    };
    for (const auto& row : kTable)
        if (row.name == kernel.name) return row.fn;
#endif
    return nullptr;
}
