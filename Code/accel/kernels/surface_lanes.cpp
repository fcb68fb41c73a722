// The table of the functions for surfaces.
#include "accel/kernels/surface_lanes.h"

#include "accel/kernels/by_kernel.h"

#define DECLARE(isa)                                                                               \
    namespace kernels::isa {                                                                       \
    void stillSurfaces(const StillsMet&, SurfacePlaces);                                           \
    void ballSurfaces(const BallsMet&, SurfacePlaces);                                             \
    void triangleSurfaces(const TrianglesMet&, TriangleSurfaces&);                                 \
    }
DECLARE_BY_KERNEL(DECLARE)
#define ROW(isa)                                                                                   \
    { kernels::isa::stillSurfaces, kernels::isa::ballSurfaces, kernels::isa::triangleSurfaces }

SurfaceLanes surfaceLanes(const Kernel& kernel) {
    static constexpr ByKernel<SurfaceLanes> kTable = BY_KERNEL(ROW);
    const SurfaceLanes* const lanes = kTable.of(kernel);
    return lanes ? *lanes : SurfaceLanes{};
}
