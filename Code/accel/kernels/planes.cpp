#include "accel/kernels/planes.h"

#include "accel/kernels/by_kernel.h"

#define DECLARE(isa)                                                                               \
    namespace kernels::isa {                                                                       \
    void firstOfPlane(const StillPlane&, std::uint32_t, const RaySpan&, Hit*);                     \
    std::size_t closestOfPlane(const StillPlane&, std::uint32_t, const RaySpan&, Hit*, PlaneHit*); \
    void anyOfPlane(const StillPlane&, const RaySpan&, std::uint8_t*);                             \
    }
DECLARE_BY_KERNEL(DECLARE)
#define ROW(isa)                                                                                   \
    { kernels::isa::firstOfPlane, kernels::isa::closestOfPlane, kernels::isa::anyOfPlane }

const PlaneKernel* planeKernel(const Kernel& kernel) {
    static constexpr ByKernel<PlaneKernel> kTable = BY_KERNEL(ROW);
    return kTable.of(kernel);
}
