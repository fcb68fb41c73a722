#include "render/waves/lamp_lanes.h"

#include <string_view>

#define LIGHT_BY_LAMP(isa)                                                                         \
    namespace kernels::isa {                                                                       \
    void lightByLamp(const PointEmission&, const LitBlock&, unsigned, LitByLamp&);                 \
    }
LIGHT_BY_LAMP(sse)
LIGHT_BY_LAMP(avx2)
LIGHT_BY_LAMP(avx512)
#undef LIGHT_BY_LAMP

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
