// Stage of the wave: lamps that rays see and go on behind (render/seen_lamps.h).
#pragma once

#include "render/waves/wave.h"

inline void addSeenLamps(const Wave& wave) {
    const SeenLamps& lamps = wave.context.scene.seenLamps();
    const PathBatch& rays = wave.rays;
    if (wave.depth == 0 && !lamps.areSeenByCamera()) return;
    std::vector<Hit> room;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const bool asCamera = rays.seesLights[i] == PathBatch::kSeesAsCamera;
        if (rays.seesLights[i] == 0 || (asCamera && !lamps.areSeenByCamera())) continue;
        Ray ray = rays.ray(i);
        const Hit& hit = wave.memory.hits[i];
        if (hit.isHit()) ray.tMax = hit.t;
        const Rgb seen = lamps.seen(ray, asCamera, room);
        if (!isBlack(seen)) wave.add(rays.sample[i], rays.weight[i] * seen);
    }
}
