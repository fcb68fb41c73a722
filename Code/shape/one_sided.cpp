#include "shape/one_sided.h"

#include <utility>

OneSided::OneSided(std::unique_ptr<const Shape> shape, Side visible)
    : shape_(std::move(shape)), visible_(visible) {}

bool OneSided::isVisible(const Ray& ray, const Hit& hit) const {
    const bool front = dot(shape_->surfaceFor(ray, hit, {false, false}).ng, ray.dir) <= 0;
    return front == (visible_ == Side::Front);
}

bool OneSided::intersect(const Ray& ray, Hit& hit) const {
    Hit nearest = hit;
    if (!shape_->intersect(ray, nearest)) return false;
    if (!isVisible(ray, nearest)) {
        // Rare for closed surfaces, whose near side is the visible one: all crossings are looked
        // at.
        Ray all = ray;
        all.tMax = kInfinityF;
        std::vector<Hit> hits;
        shape_->collect(all, hits);
        nearest.t = kInfinityF;
        bool found = false;
        for (const Hit& other : hits) {
            const bool isNearer =
                other.t < nearest.t || (found && other.t == nearest.t && other.prim < nearest.prim);
            if (!(other.t <= hit.t) || !isNearer || !isVisible(ray, other)) continue;
            nearest = other;
            found = true;
        }
        if (!found) return false;
        nearest.shape = hit.shape;
    }
    hit = nearest;
    return true;
}
