// The table of the functions for what mirrors and glass send on.
#include "render/waves/bounce_lanes.h"

#include "accel/kernels/by_kernel.h"

#define DECLARE(isa)                                                                               \
    namespace kernels::isa {                                                                       \
    std::size_t dividePoints(const PointBlock&, const std::uint32_t*, unsigned, std::uint16_t*);   \
    void bouncePoints(const PointBlock&, const Rgb*, std::span<const AlikePoints>,                 \
                      const BouncePairs*, float, const RayPlaces&, LeavingRays&);                  \
    void mirrorPoints(const PointBlock&, const Rgb*, const Material* const*, unsigned, float,      \
                      const RayPlaces&, LeavingRays&);                                             \
    }
DECLARE_BY_KERNEL(DECLARE)
#define ROW(isa)                                                                                   \
    { kernels::isa::dividePoints, kernels::isa::bouncePoints, kernels::isa::mirrorPoints }

BounceLanes bounceLanes(const Kernel& kernel) {
    static constexpr ByKernel<BounceLanes> kTable = BY_KERNEL(ROW);
    const BounceLanes* const lanes = kTable.of(kernel);
    return lanes ? *lanes : BounceLanes{};
}
