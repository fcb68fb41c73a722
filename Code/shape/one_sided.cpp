#include "shape/one_sided.h"

#include <utility>

OneSided::OneSided(std::unique_ptr<const Shape> shape, Side visible)
    : shape_(std::move(shape)), visible_(visible) {}

// The kernels know nothing of what is restricted twice.
SolidForm OneSided::solidForm() const {
    SolidForm form = shape_->solidForm();
    const Facets::Side side = visible_ == Side::Front ? Facets::Side::Front : Facets::Side::Back;
    if (form.sphere && form.sphereSide != Facets::Side::Both) return {form.hull};
    form.sphereSide = side;
    const auto restrict = [&](auto& part) {
        if (!part) return;
        if (part->side != Facets::Side::Both) return part.reset();
        part->side = side;
    };
    restrict(form.facets);
    restrict(form.tube);
    restrict(form.faces);
    return form;
}

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
    if (!shape_->intersect(ray, nearest) || !seesHit(ray, hit.t, nearest)) return false;
    hit = nearest;
    return true;
}

bool OneSided::seesHit(const Ray& ray, float tMax, Hit& hit) const {
    if (isVisible(ray, hit)) return true;
    // Rare for closed surfaces, whose near side is the visible one: all crossings are looked at.
    hit = {.t = tMax, .shape = hit.shape};
    return lookThrough(ray, hit);
}

void OneSided::intersectBatch(const RaySpan& rays, std::uint32_t number,
                              std::span<Hit> hits) const {
    shape_->intersectBatch(rays, number, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!hits[i].isHit()) continue;
        if (!seesHit(rays[i], rays.tMax[i], hits[i])) hits[i] = {.t = rays.tMax[i]};
    }
}
