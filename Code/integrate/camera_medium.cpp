#include "integrate/camera_medium.h"

#include "integrate/shading.h"

#include <algorithm>
#include <vector>

MediumTree::Inside mediumOfCamera(const Scene& scene, const RenderSettings& settings,
                                  MediumTree& media) {
    constexpr int kSurfaces = 4096; // more are not looked at
    const auto transmits = [](const SceneMaterial& m) { return m.transmits; };
    if (!scene.anyMaterial().transmits) return MediumTree::kNothing;

    const Vec2 lens{0.5f, 0.5f};
    Ray ray = scene.camera().ray({settings.picture.width / 2.0, settings.picture.height / 2.0},
                                 lens, 0.5f);
    if (scene.camera().ray({0, 0}, lens, 0.5f).org != ray.org) return MediumTree::kNothing;

    struct Crossing {
        std::uint32_t material, object;
    };
    std::vector<Crossing> entered, around; // around: the innermost first
    for (int i = 0; i < kSurfaces; ++i) {
        const Hit hit = scene.shapes().closest(ray);
        if (!hit.isHit()) break;
        const Surface surface = scene.shapes().shapes[hit.shape]->surface(ray, hit);
        const bool isFront = dot(ray.dir, surface.ng) <= 0;
        if (transmits(scene.materials()[surface.material])) {
            const Crossing crossing{surface.material, surface.object};
            const auto open =
                std::find_if(entered.rbegin(), entered.rend(), [&](const Crossing& other) {
                    return other.material == crossing.material;
                });
            if (isFront)
                entered.push_back(crossing);
            else if (open != entered.rend())
                entered.erase(std::next(open).base());
            else
                around.push_back(crossing);
        }
        ray = {leave(surface, isFront ? -surface.ng : surface.ng), ray.dir, 0, kInfinityF,
               ray.time};
    }
    for (const Crossing& unleft : entered) {
        const auto insideOut = std::find_if(around.rbegin(), around.rend(), [&](const Crossing& c) {
            return c.object == unleft.object;
        });
        if (insideOut != around.rend()) around.erase(std::next(insideOut).base());
    }
    MediumTree::Inside inside = MediumTree::kNothing;
    std::for_each(around.rbegin(), around.rend(),
                  [&](const Crossing& c) { inside = media.enter(inside, c.material); });
    return inside;
}
