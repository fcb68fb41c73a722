#include "render/camera_medium.h"

#include "render/shading.h"

#include <algorithm>
#include <vector>

MediumTree::Inside mediumOfCamera(const Scene& scene, const RenderSettings& settings,
                                  MediumTree& media) {
    constexpr int kSurfaces = 4096; // more are not looked at
    const auto transmits = [](const SceneMaterial& m) { return !isBlack(m.base.transmission); };
    if (!scene.anyMaterial().transmits) return MediumTree::kNothing;

    const Vec2 lens{0.5f, 0.5f};
    Ray ray = scene.camera().ray({settings.picture.width / 2.0, settings.picture.height / 2.0},
                                 lens, 0.5f);
    if (scene.camera().ray({0, 0}, lens, 0.5f).org != ray.org) return MediumTree::kNothing;

    std::vector<std::uint32_t> entered, around; // around: the innermost first
    for (int i = 0; i < kSurfaces; ++i) {
        const Hit hit = scene.shapes().closest(ray);
        if (!hit.isHit()) break;
        const ShadedPoint at = shade(scene, ray, hit);
        if (transmits(*at.of)) {
            const auto open = std::find(entered.rbegin(), entered.rend(), at.surface.material);
            if (at.front)
                entered.push_back(at.surface.material);
            else if (open != entered.rend())
                entered.erase(std::next(open).base());
            else
                around.push_back(at.surface.material);
        }
        ray = {leave(at.surface, -at.eye.ng), ray.dir, 0, kInfinityF, ray.time};
    }
    MediumTree::Inside inside = MediumTree::kNothing;
    std::for_each(around.rbegin(), around.rend(),
                  [&](std::uint32_t m) { inside = media.enter(inside, m); });
    return inside;
}
