#include "render/waves/lamp_lanes.h"

#include <string_view>

namespace kernels {
namespace sse {
void lightByLamp(const PointEmission&, const LitBlock&, unsigned, LitByLamp&);
}
namespace avx2 {
void lightByLamp(const PointEmission&, const LitBlock&, unsigned, LitByLamp&);
}
namespace avx512 {
void lightByLamp(const PointEmission&, const LitBlock&, unsigned, LitByLamp&);
}
} // namespace kernels

LightByLampFn lightByLamp(const Kernel& kernel) {
#if defined(__x86_64__)
    struct Row {
        std::string_view name;
        LightByLampFn fn;
    };
    static constexpr Row kTable[] = {
        {"avx512", kernels::avx512::lightByLamp},
        {"avx2", kernels::avx2::lightByLamp},
        {"sse", kernels::sse::lightByLamp},
    };
    for (const Row& row : kTable)
        if (row.name == kernel.name) return row.fn;
#endif
    return nullptr;
}
