// The filter of denoise.h by the register. What is added up for a pixel comes in the same order
// whatever the width.
#pragma once

#include "denoise/denoise_lanes.h"
#include "simd/lanes.h"

#include <algorithm>
#include <cstddef>

LANES_BEGIN

// Three planes at W pixels from `at` on.
struct Planes3 {
    Floats x, y, z;
};
inline Planes3 loadPlanes(const float* const (&plane)[3], std::ptrdiff_t at) {
    return {Floats::unaligned(plane[0] + at), Floats::unaligned(plane[1] + at),
            Floats::unaligned(plane[2] + at)};
}
inline Floats squaredDistance(const Planes3& a, const Planes3& b) {
    const Floats x = a.x - b.x, y = a.y - b.y, z = a.z - b.z;
    return x * x + y * y + z * z;
}

inline void denoisePixels(const DenoisePlanes& of, int x, int y, float* const (&to)[3],
                          float* left) {
    const int radius = of.radius;
    const auto stride = static_cast<std::ptrdiff_t>(of.stride);
    const std::ptrdiff_t here = y * stride + x;
    const Planes3 compared = loadPlanes(of.compared, here), room = loadPlanes(of.ownRoom, here);
    const Planes3 albedo = loadPlanes(of.albedo, here), normal = loadPlanes(of.normal, here);
    const Floats albedoScale = Floats::unaligned(of.albedoScale + here);
    const Floats normalScale = Floats::unaligned(of.normalScale + here);
    Floats weights(0.0f), squares(0.0f), r(0.0f), g(0.0f), b(0.0f);
    const int top = std::max(y - radius, 0), bottom = std::min(y + radius, of.height - 1);
    for (int row = top; row <= bottom; ++row) {
        const std::ptrdiff_t first = row * stride + x - radius;
        for (std::ptrdiff_t at = first; at <= first + 2 * radius; ++at) {
            const Planes3 other = loadPlanes(of.compared, at), otherRoom = loadPlanes(of.room, at);
            const auto isNear = [](Floats p, Floats q, Floats most) {
                return (p - q) * (p - q) <= most;
            };
            const Mask near = isNear(compared.x, other.x, room.x + otherRoom.x) &
                              isNear(compared.y, other.y, room.y + otherRoom.y) &
                              isNear(compared.z, other.z, room.z + otherRoom.z);
            const Floats apart =
                squaredDistance(albedo, loadPlanes(of.albedo, at)) * albedoScale +
                squaredDistance(normal, loadPlanes(of.normal, at)) * normalScale;
            const Floats alike = max(Floats(1.0f) - apart, Floats(0.0f));
            const Floats weight =
                select(near, alike * alike * Floats::unaligned(of.trust + at), Floats(0.0f));
            weights = weights + weight;
            squares = squares + weight * weight;
            const Planes3 color = loadPlanes(of.color, at);
            r = r + weight * color.x, g = g + weight * color.y, b = b + weight * color.z;
        }
    }
    const Mask isAlone = weights <= Floats(0.0f);
    const auto store = [&](Floats alone, Floats sum, float* plane) {
        alignas(64) float means[W];
        select(isAlone, alone, sum / weights).store(means);
        std::copy_n(means, W, plane + x);
    };
    const Planes3 color = loadPlanes(of.color, here);
    store(color.x, r, to[0]), store(color.y, g, to[1]), store(color.z, b, to[2]);
    store(Floats(1.0f), squares / weights, left);
}

inline void denoiseRow(const DenoisePlanes& planes, int y, float* const (&to)[3], float* left) {
    for (int x = 0; x < planes.width; x += W) denoisePixels(planes, x, y, to, left);
}

inline constexpr DenoiseLanes kDenoise{denoiseRow};

LANES_END
