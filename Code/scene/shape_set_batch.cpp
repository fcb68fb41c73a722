// Many rays at once: what kernels do, and what is left to shapes and single rays.
#include "accel/kernels/solids.h"
#include "scene/shape_set.h"

#include <algorithm>

void ShapeSet::closest(const RaySpan& rays, std::vector<Hit>& hits) const {
    hits.resize(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = {.t = rays.tMax[i]};
    if (!batched.empty()) closestOfBatched(rays, hits);
    if (!askedAlone_.empty() || !distant.empty()) closestOfOthers(rays, hits);
    if (kernel_) {
        const SolidCalls calls{
            this,
            [](const void* set, const Ray& ray, std::uint32_t number, float tEntry, Hit& best) {
                return static_cast<const ShapeSet*>(set)->nearer(ray, number, tEntry, best);
            },
            nullptr};
        if (!solids_.isEmpty()) closestSolids(*kernel_, solids_, calls, rays, hits);
        if (!placed_.isEmpty()) placed_.closest(*this, rays, hits);
        return;
    }
    if (bounded.size() == batched.size()) return;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray ray = rays[i];
        if (canHit(ray))
            visitNearer(ray, RaySetup(ray.org, ray.dir, extent), Ask::ButBatched, hits[i]);
    }
}

void ShapeSet::closestOfBatched(const RaySpan& rays, std::vector<Hit>& hits) const {
    thread_local std::vector<Hit> found;
    thread_local std::vector<std::uint32_t> asFar;
    found.resize(rays.size()), asFar.resize(rays.size());
    for (const std::uint32_t number : batched) {
        shapes[number]->intersectBatch(rays, number, found);
        if (kernel_) {
            const std::size_t count = kernel_->nearerInBox({boxes[number], extent, number}, rays,
                                                           found.data(), hits.data(), asFar.data());
            for (const std::uint32_t i : std::span(asFar).first(count))
                takeNearer(rays[i], found[i], number, 0, hits[i]);
            continue;
        }
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (!found[i].isHit()) continue;
            const RaySetup setup(rays.org[i], rays.dir[i], extent);
            float zEntry = 0;
            const float zCut = depthCut(1.0f / (hits[i].t * setup.dz));
            if (setup.enters(boxes[number], zCut, zEntry))
                takeNearer(rays[i], found[i], number, zEntry / setup.dz, hits[i]);
        }
    }
}

void ShapeSet::occluded(const RaySpan& rays, std::vector<std::uint8_t>& hidden) const {
    hidden.assign(rays.size(), 0);
    if (!batched.empty()) hideByBatched(rays, hidden);
    if (!askedAlone_.empty() || !distant.empty()) hideByOthers(rays, hidden);
    if (kernel_) {
        const SolidCalls calls{
            this, nullptr, [](const void* set, const Ray& ray, std::uint32_t number) {
                return static_cast<const ShapeSet*>(set)->shapes[number]->occludes(ray);
            }};
        if (!solids_.isEmpty()) anySolids(*kernel_, solids_, calls, rays, hidden);
        if (!placed_.isEmpty()) placed_.occluded(*this, rays, hidden);
        return;
    }
    if (bounded.size() == batched.size()) return;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray ray = rays[i];
        if (hidden[i] == 0 && canHit(ray))
            hidden[i] = isHidden(ray, RaySetup(ray.org, ray.dir, extent), Ask::ButBatched);
    }
}

void ShapeSet::hideByBatched(const RaySpan& rays, std::vector<std::uint8_t>& hidden) const {
    thread_local std::vector<std::uint8_t> found;
    found.resize(rays.size());
    for (const std::uint32_t number : batched) {
        if (shadows[number] != Shadow::Opaque) continue;
        shapes[number]->occludesBatch(rays, found);
        for (std::size_t i = 0; i < rays.size(); ++i) hidden[i] |= found[i];
    }
}

void ShapeSet::closestOfOthers(const RaySpan& rays, std::vector<Hit>& hits) const {
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray ray = rays[i];
        if (!canHit(ray)) continue;
        for (const std::uint32_t number : askedAlone_) nearer(ray, number, 0, hits[i]);
        nearerOfDistant(ray, hits[i]);
    }
}

void ShapeSet::hideByOthers(const RaySpan& rays, std::vector<std::uint8_t>& hidden) const {
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray ray = rays[i];
        if (hidden[i] != 0 || !canHit(ray)) continue;
        hidden[i] = std::any_of(askedAlone_.begin(), askedAlone_.end(),
                                [&](std::uint32_t number) {
                                    return shadows[number] == Shadow::Opaque &&
                                           shapes[number]->occludes(ray);
                                }) ||
                    isHiddenByDistant(ray);
    }
}
