// The cones of the rays of a wave, and the footprints in which they meet surfaces. States have cones
// only where the context filters pictures.
#pragma once

#include "integrate/path_memory.h"
#include "integrate/wave.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace waves {

// Writes the cones of camera rays.
inline void makeCones(const IntegratorContext& context, const PathBatch& rays,
                      std::vector<PathState>& states) {
    const Camera& camera = context.scene.camera();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const RayCone pixel = camera.cone(rays.dir[i], rays.time[i]);
        states[i].cone = {pixel.width * context.footprintScale,
                          pixel.spread * context.footprintScale};
    }
}

// Finds what part of their pictures the rays of some points stand for; `chosen` has a bit for each
// that counts. Returns whether any is more than a point.
inline bool findFootprints(const Wave& wave, const PointBlock& at, const std::uint32_t* numbers,
                           unsigned chosen, FootprintBlock& found) {
    const Hit* last = nullptr; // on a primitive whose derivatives are `even`
    SurfaceDerivatives even;
    unsigned wide = 0;
    for (unsigned rest = chosen; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rest));
        const std::uint32_t ray = wave.memory.points.ray[numbers[i]];
        const Hit& hit = wave.memory.hits[ray];
        const float width = wave.memory.path.states[ray].cone.widthAt(hit.t);
        found.put(i, width, wave.rays.dir[ray], SurfaceBlock::get(at.ng, i));
        if (!(width > 0)) continue;
        wide |= 1u << i;
        if (last == nullptr || last->shape != hit.shape || last->prim != hit.prim) {
            const Shape& shape = *wave.context.scene.shapes().shapes[hit.shape];
            even = shape.derivatives(wave.rays.ray(ray), hit);
            last = even.isEven ? &hit : nullptr;
        }
        found.put(i, even);
    }
    if (wide == 0) return false;
    wave.context.pictures.footprints(found, static_cast<std::size_t>(std::bit_width(chosen)));
    return true;
}
// Returns what part of its pictures the ray of point k stands for.
inline UvFootprint footprintAt(const Wave& wave, std::size_t k) {
    if (!wave.context.filtersTextures()) return {};
    const std::uint32_t i = wave.memory.points.ray[k];
    const Hit& hit = wave.memory.hits[i];
    const float width = wave.memory.path.states[i].cone.widthAt(hit.t);
    if (!(width > 0)) return {};
    const Shape& shape = *wave.context.scene.shapes().shapes[hit.shape];
    const PointBlock& block = wave.memory.points.at.block(k / PointBlock::kPoints);
    return footprintOn(width, wave.rays.dir[i],
                       SurfaceBlock::get(block.ng, k % PointBlock::kPoints),
                       shape.derivatives(wave.rays.ray(i), hit));
}

// Returns the cone of a ray that leaves point k straight on.
inline RayCone coneThrough(const Wave& wave, std::size_t k) {
    const std::uint32_t i = wave.memory.points.ray[k];
    return wave.memory.path.states[i].cone.from(wave.memory.hits[i].t);
}

// Returns the cone of a ray that a lobe sends from point k, in a direction of this density (0: a
// single one), to the other side of a boundary or not (null).
inline RayCone coneAfter(const Wave& wave, std::size_t k, Vec3 dir, float pdf,
                         const Boundary* crossed) {
    RayCone cone = coneThrough(wave, k);
    if (crossed != nullptr) {
        const PointBlock& block = wave.memory.points.at.block(k / PointBlock::kPoints);
        const std::size_t place = k % PointBlock::kPoints;
        const Vec3 n = SurfaceBlock::get(block.n, place);
        cone = cone.refracted(crossed->eta, dot(n, SurfaceBlock::get(block.toEye, place)),
                              -dot(n, dir));
    }
    return pdf > 0 ? cone.scattered(pdf, wave.context.inverseSamples) : cone;
}

} // namespace waves
