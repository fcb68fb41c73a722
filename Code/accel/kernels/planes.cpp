#include "accel/kernels/planes.h"

#include <string_view>

#define PLANE_FUNCTIONS(isa)                                                                       \
    namespace kernels::isa {                                                                       \
    std::size_t closestOfPlane(const StillPlane&, const RaySpan&, std::span<const Hit>,            \
                               PlaneHit*);                                                         \
    void anyOfPlane(const StillPlane&, const RaySpan&, std::uint8_t*);                             \
    }
PLANE_FUNCTIONS(sse)
PLANE_FUNCTIONS(avx2)
PLANE_FUNCTIONS(avx512)
#undef PLANE_FUNCTIONS

const PlaneKernel* planeKernel([[maybe_unused]] const Kernel& kernel) {
#if defined(__x86_64__)
    static constexpr PlaneKernel kTable[] = {
        {"avx512", kernels::avx512::closestOfPlane, kernels::avx512::anyOfPlane},
        {"avx2", kernels::avx2::closestOfPlane, kernels::avx2::anyOfPlane},
        {"sse", kernels::sse::closestOfPlane, kernels::sse::anyOfPlane},
    };
    for (const PlaneKernel& row : kTable)
        if (std::string_view(row.name) == kernel.name) return &row;
#endif
    return nullptr;
}
