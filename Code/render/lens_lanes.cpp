#include "render/lens_lanes.h"

#include "accel/kernels/kernels.h"

#include <string_view>

#define CAMERA_IN_LANES(isa)                                                                       \
    namespace kernels::isa {                                                                       \
    void sobolPairs(PairBlock&);                                                                   \
    void lensRays(const Camera::RoundLens&, LensBlock&);                                           \
    }
CAMERA_IN_LANES(sse)
CAMERA_IN_LANES(avx2)
CAMERA_IN_LANES(avx512)
#undef CAMERA_IN_LANES

CameraLanes cameraLanes([[maybe_unused]] const Kernel& kernel) {
#if defined(__x86_64__)
    static constexpr struct {
        std::string_view name;
        CameraLanes lanes;
    } kTable[] = {
        {"avx512", {kernels::avx512::sobolPairs, kernels::avx512::lensRays}},
        {"avx2", {kernels::avx2::sobolPairs, kernels::avx2::lensRays}},
        {"sse", {kernels::sse::sobolPairs, kernels::sse::lensRays}},
    };
    for (const auto& row : kTable)
        if (row.name == kernel.name) return row.lanes;
#endif
    return {};
}
