// The table of the functions for points.
#include "render/waves/shade_lanes.h"

#include "accel/kernels/by_kernel.h"

#define DECLARE(isa)                                                                               \
    namespace kernels::isa {                                                                       \
    unsigned seePoints(PointBlock&, const Vec3*, unsigned, unsigned);                              \
    void lightPoints(const PointBlock&, const Rgb*, unsigned, LitBlock&);                          \
    void paintPoints(const Material&, LitBlock&);                                                  \
    void paintEachPoint(const Material* const*, LitBlock&);                                        \
    void addGlowInARow(const Rgb*, const Rgb*, Rgb*);                                              \
    void takeRow(const Rgb*, LightSums&);                                                          \
    void giveRow(const LightSums&, Rgb*);                                                          \
    void addRow(const LightSums&, Rgb*);                                                           \
    Bounds boundsOfPoints(const PointBlock&, unsigned);                                            \
    void aimAtPoints(const LitByLamp&, unsigned, const RayPlaces&);                                \
    void addLight(const LitByLamp&, unsigned, const std::uint8_t*, LightSums&);                    \
    }
DECLARE_BY_KERNEL(DECLARE)
#define ROW(isa)                                                                                   \
    {                                                                                              \
        kernels::isa::seePoints, kernels::isa::lightPoints, kernels::isa::paintPoints,             \
            kernels::isa::paintEachPoint, kernels::isa::addGlowInARow, kernels::isa::takeRow,      \
            kernels::isa::giveRow, kernels::isa::addRow, kernels::isa::boundsOfPoints,             \
            kernels::isa::aimAtPoints, kernels::isa::addLight                                      \
    }

ShadeLanes shadeLanes(const Kernel& kernel) {
    static constexpr ByKernel<ShadeLanes> kTable = BY_KERNEL(ROW);
    const ShadeLanes* const lanes = kTable.of(kernel);
    return lanes ? *lanes : ShadeLanes{};
}
