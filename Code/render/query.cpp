#include "render/query.h"

#include "render/shading.h"

void closest(const Scene& scene, const RayBatch& rays, std::vector<Hit>& hits) {
    scene.shapes().closest(rays.span(), hits);
}

void transmitted(const Scene& scene, const RayBatch& rays, std::vector<Rgb>& transmittance) {
    transmittance.resize(rays.size());
    std::vector<std::uint8_t> hidden;
    scene.shapes().occluded(rays.span(), hidden);
    std::vector<Hit> hits;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Rgb passed{1, 1, 1};
        if (hidden[i] != 0)
            passed = {};
        else if (scene.hasSeeThrough()) {
            const Ray ray = rays.ray(i);
            hits.clear();
            scene.shapes().seeThroughHits(ray, hits);
            for (const Hit& hit : hits) passed *= straightTransmission(scene, ray, hit);
        }
        transmittance[i] = passed;
    }
}
