#include "render/seen_lamps.h"

#include "light/seen_light.h"

#include <utility>

void SeenLamps::add(LightDesc::SeenBy by, const Light& light, std::unique_ptr<const Shape> body) {
    using enum LightDesc::SeenBy;
    const Lamp lamp{&light, by == Camera || by == All, by == Reflections || by == All};
    if (light.isDark() || !light.lampEmission(false)) return;
    areSeenByCamera_ |= lamp.byCamera;
    if (!body) return suns_.push_back(lamp);
    lamps_.push_back(lamp);
    bodies_.add(std::move(body), ShapeSet::Shadow::SeeThrough);
}

void SeenLamps::finish() {
    if (!lamps_.empty()) bodies_.finish(true);
}

Rgb SeenLamps::seen(const Ray& ray, bool asCamera, std::vector<Hit>& hits) const {
    Rgb sum;
    if (!(ray.tMax < kInfinityF))
        for (const Lamp& sun : suns_)
            if (sun.isSeen(asCamera)) sum += seenLight(*sun.light, ray.dir);
    if (lamps_.empty()) return sum;
    hits.clear();
    bodies_.seeThroughHits(ray, hits);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const Lamp& lamp = lamps_[hits[i].shape];
        // A ball is met where it is entered and where it is left, and seen once.
        bool again = false;
        for (std::size_t k = 0; k < i; ++k) again |= hits[k].shape == hits[i].shape;
        if (!again && lamp.isSeen(asCamera)) sum += seenLight(*lamp.light, ray.dir);
    }
    return sum;
}
