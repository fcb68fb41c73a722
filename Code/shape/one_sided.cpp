#include "shape/one_sided.h"

#include <utility>

OneSided::OneSided(std::unique_ptr<const Shape> shape, Side visible)
    : shape_(std::move(shape)), visible_(visible) {}

bool OneSided::isVisible(const Ray& ray, const Hit& hit) const {
    return shape_->seesFront(ray, hit) == (visible_ == Side::Front);
}

bool OneSided::lookThrough(const Ray& ray, Hit& hit) const {
    Ray all = ray;
    all.tMax = kInfinityF;
    std::vector<Hit> hits;
    shape_->collect(all, hits);
    Hit nearest;
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
    hit = nearest;
    return true;
}

bool OneSided::intersect(const Ray& ray, Hit& hit) const {
    Hit nearest = hit;
    if (!shape_->intersect(ray, nearest)) return false;
    // Rare for closed surfaces, whose near side is the visible one: all crossings are looked at.
    if (!isVisible(ray, nearest)) return lookThrough(ray, hit);
    hit = nearest;
    return true;
}

void OneSided::intersectBatch(const RaySpan& rays, std::uint32_t number,
                              std::span<Hit> hits) const {
    shape_->intersectBatch(rays, number, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!hits[i].isHit()) continue;
        const Ray ray = rays[i];
        if (isVisible(ray, hits[i])) continue;
        hits[i] = {.t = ray.tMax};
        if (lookThrough(ray, hits[i])) hits[i].shape = number;
    }
}
