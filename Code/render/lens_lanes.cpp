#include "render/lens_lanes.h"

#include "accel/kernels/by_kernel.h"

#define DECLARE(isa)                                                                               \
    namespace kernels::isa {                                                                       \
    void pairSeeds(std::uint32_t, std::uint32_t, std::span<const std::uint32_t>,                   \
                   const PairSeedColumns&);                                                        \
    void sobolPairs(PairBlock&);                                                                   \
    void spreadPairs(const Filter::Inverse&, PairBlock&);                                          \
    void lensRays(const Camera::Lens&, LensBlock&);                                                \
    void pinholeRays(const Camera::Lens&, std::span<const Vec2d>, std::span<Vec3>,                 \
                     std::span<float>);                                                            \
    }
DECLARE_BY_KERNEL(DECLARE)
#define ROW(isa)                                                                                   \
    {                                                                                              \
        kernels::isa::pairSeeds, kernels::isa::sobolPairs, kernels::isa::spreadPairs,              \
            kernels::isa::lensRays, kernels::isa::pinholeRays                                      \
    }

CameraLanes cameraLanes(const Kernel& kernel) {
    static constexpr ByKernel<CameraLanes> kTable = BY_KERNEL(ROW);
    const CameraLanes* const lanes = kTable.of(kernel);
    return lanes ? *lanes : CameraLanes{};
}
