#include "render/lens_lanes.h"

#include "accel/kernels/by_kernel.h"

#define DECLARE(isa)                                                                               \
    namespace kernels::isa {                                                                       \
    void pairSeeds(std::uint32_t, std::uint32_t, std::span<const std::uint32_t>,                   \
                   const PairSeedColumns&);                                                        \
    void sobolPairs(PairBlock&);                                                                   \
    void spreadPlaces(const Filter::Spread&, const PairBlock&, PlaceBlock&);                       \
    void lensRays(const Camera::Lens&, const PlaceBlock&, const RaySpans&);                        \
    void pinholeRays(const Camera::Lens&, const PlaceBlock&, const RaySpans&);                     \
    }
DECLARE_BY_KERNEL(DECLARE)
#define ROW(isa)                                                                                   \
    {                                                                                              \
        kernels::isa::pairSeeds, kernels::isa::sobolPairs, kernels::isa::spreadPlaces,             \
            kernels::isa::lensRays, kernels::isa::pinholeRays                                      \
    }

CameraLanes cameraLanes(const Kernel& kernel) {
    static constexpr ByKernel<CameraLanes> kTable = BY_KERNEL(ROW);
    const CameraLanes* const lanes = kTable.of(kernel);
    return lanes ? *lanes : CameraLanes{};
}
