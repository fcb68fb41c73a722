// The table of the functions for sphere surfaces.
#include "accel/kernels/sphere_surfaces.h"

#define SPHERE_SURFACES(isa)                                                                       \
    namespace kernels::isa {                                                                       \
    void sphereSurfaces(const SphereToShade&, const RaySpan&, std::span<const Hit>,                \
                        std::span<const std::uint32_t>, Strided<Surface>);                         \
    }
SPHERE_SURFACES(sse)
SPHERE_SURFACES(avx2)
SPHERE_SURFACES(avx512)
#undef SPHERE_SURFACES

SphereSurfacesFn sphereSurfaces([[maybe_unused]] const Kernel& kernel) {
#if defined(__x86_64__)
    static constexpr struct {
        std::string_view name;
        SphereSurfacesFn function;
    } kTable[] = {
        {"avx512", kernels::avx512::sphereSurfaces},
        {"avx2", kernels::avx2::sphereSurfaces},
        {"sse", kernels::sse::sphereSurfaces},
    };
    for (const auto& row : kTable)
        if (row.name == kernel.name) return row.function;
#endif
    return nullptr;
}
