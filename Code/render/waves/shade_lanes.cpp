// The table of the functions for points.
#include "render/waves/shade_lanes.h"

#include "accel/kernels/kernels.h"

#include <string_view>

#define SHADE_LANES(isa)                                                                           \
    namespace kernels::isa {                                                                       \
    unsigned seePoints(PointBlock&, const Vec3*, unsigned, unsigned);                              \
    void lightPoints(const PointBlock&, const Rgb*, unsigned, LitBlock&);                          \
    void paintPoints(const Material&, LitBlock&);                                                  \
    unsigned mirrorPoints(const PointBlock&, const Rgb*, const Rgb*, unsigned, float,              \
                          const RayPlaces&);                                                       \
    Bounds boundsOfPoints(const PointBlock&, unsigned);                                            \
    void aimAtPoints(const LitByLamp&, unsigned, const RayPlaces&);                                \
    void addLight(const LitByLamp&, unsigned, const std::uint8_t*, LightSums&);                    \
    constexpr ShadeLanes kShadeLanes{seePoints,      lightPoints, paintPoints, mirrorPoints,       \
                                     boundsOfPoints, aimAtPoints, addLight};                       \
    }
SHADE_LANES(sse)
SHADE_LANES(avx2)
SHADE_LANES(avx512)
#undef SHADE_LANES

ShadeLanes shadeLanes([[maybe_unused]] const Kernel& kernel) {
#if defined(__x86_64__)
    static constexpr struct {
        std::string_view name;
        ShadeLanes lanes;
    } kTable[] = {
        {"avx512", kernels::avx512::kShadeLanes},
        {"avx2", kernels::avx2::kShadeLanes},
        {"sse", kernels::sse::kShadeLanes},
    };
    for (const auto& row : kTable)
        if (row.name == kernel.name) return row.lanes;
#endif
    return {};
}
