#include "render/query.h"

#include "render/shading.h"

void closest(const Scene& scene, const RayBatch& rays, std::vector<Hit>& hits) {
    hits.resize(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = scene.shapes().closest(rays.ray(i));
}

void transmitted(const Scene& scene, const RayBatch& rays, std::vector<Rgb>& transmittance) {
    transmittance.resize(rays.size());
    std::vector<Hit> hits;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray ray = rays.ray(i);
        Rgb passed{1, 1, 1};
        if (scene.shapes().occluded(ray))
            passed = {};
        else if (scene.hasSeeThrough()) {
            hits.clear();
            scene.shapes().seeThroughHits(ray, hits);
            for (const Hit& hit : hits) passed *= straightTransmission(scene, ray, hit);
        }
        transmittance[i] = passed;
    }
}
