// The table of the functions for surfaces.
#include "accel/kernels/surface_lanes.h"

#include "accel/kernels/kernels.h"

#include <string_view>

#define SURFACE_LANES(isa)                                                                         \
    namespace kernels::isa {                                                                       \
    void roundSurfaces(const RoundsMet&, SurfacePlaces);                                        \
    void triangleSurfaces(const TrianglesMet&, TriangleSurfaces&);                                 \
    }
SURFACE_LANES(sse)
SURFACE_LANES(avx2)
SURFACE_LANES(avx512)
#undef SURFACE_LANES

SurfaceLanes surfaceLanes([[maybe_unused]] const Kernel& kernel) {
#if defined(__x86_64__)
    static constexpr struct {
        std::string_view name;
        SurfaceLanes lanes;
    } kTable[] = {
        {"avx512", {kernels::avx512::roundSurfaces, kernels::avx512::triangleSurfaces}},
        {"avx2", {kernels::avx2::roundSurfaces, kernels::avx2::triangleSurfaces}},
        {"sse", {kernels::sse::roundSurfaces, kernels::sse::triangleSurfaces}},
    };
    for (const auto& row : kTable)
        if (row.name == kernel.name) return row.lanes;
#endif
    return {};
}
