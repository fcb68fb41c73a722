#include "render/shape_set.h"

#include "shape/mesh_instance.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace {

// A tree over fewer shapes costs more than it saves; the answer is the same either way.
constexpr std::size_t kFewestForTree = 5;

} // namespace

void ShapeSet::reserve(std::size_t count) {
    shapes.reserve(count), boxes.reserve(count), shadows.reserve(count), bounded.reserve(count);
}

void ShapeSet::add(std::unique_ptr<const Shape> shape, Shadow shadow) {
    const auto number = static_cast<std::uint32_t>(shapes.size());
    const Bounds box = shape->bounds();
    if (box.isFinite()) {
        bounded.push_back(number);
        extent = max(max(maxAbs(box.lo), maxAbs(box.hi)), extent);
    } else if (!box.isEmpty()) {
        unbounded.push_back(number);
    }
    boxes.push_back(box);
    shapes.push_back(std::move(shape));
    shadows.push_back(shadow);
}

void ShapeSet::finish(bool withBvh, const Kernel& kernel, int threads) {
    if (withBvh) kernel_ = solidKernel(kernel), planeKernel_ = planeKernel(kernel);
    for (const std::uint32_t number : unbounded)
        if (const auto form = shapes[number]->solidForm(); form.plane && planeKernel_)
            floors_.push_back({*form.plane, number});
        else
            askedAlone_.push_back(number);
    isBatched_.assign(shapes.size(), 0);
    for (const std::uint32_t number : bounded) {
        if (!shapes[number]->takesBatches() || (kernel_ && shapes[number]->solidForm().facets))
            continue;
        batched.push_back(number);
        isBatched_[number] = 1;
    }
    if (!withBvh) return;
    inTree_.reserve(bounded.size());
    for (const std::uint32_t number : bounded)
        if (!isBatched_[number]) inTree_.push_back(number);
    if (!kernel_ && inTree_.size() < kFewestForTree) return inTree_.clear();
    bvh = buildBvh(boxesInTree(), threads);
    bvh.nodes.shrink_to_fit();
    if (kernel_) buildBatchTrees(kernel, threads);
}

std::vector<Bounds> ShapeSet::boxesInTree() const {
    std::vector<Bounds> out;
    out.reserve(inTree_.size());
    for (const std::uint32_t number : inTree_) out.push_back(boxes[number]);
    return out;
}

void ShapeSet::buildBatchTrees(const Kernel& kernel, int threads) {
    solids_.reserve(inTree_.size());
    for (const std::uint32_t number : inTree_) {
        const MeshInstance* const instance = shapes[number]->meshInstance();
        if (instance != nullptr && instance->geometry().kernel == &kernel) {
            placed_.add(boxes[number], number, shadows[number] == Shadow::Opaque,
                        instance->geometry().wide);
            continue;
        }
        solids_.add(boxes[number], number, shadows[number] == Shadow::Opaque,
                    shapes[number]->solidForm());
    }
    solids_.extent = extent;
    solids_.build(kernel_->width,
                  solids_.boxes.size() == inTree_.size() ? bvh : buildBvh(solids_.boxes, threads));
    if (!placed_.isEmpty()) placed_.build(kernel, extent, threads);
}

// fn(shape, zEntry, zCut) for every shape whose box the ray enters in front of zCut; true stops.
template <class VisitFn>
void ShapeSet::visit(const RaySetup& setup, float zCut, Ask ask, VisitFn&& fn) const {
    if (ask == Ask::All)
        for (const std::uint32_t number : unbounded)
            if (fn(number, 0.0f, zCut)) return;
    const auto leaf = [&](std::uint32_t number, float& cut) {
        float zEntry = 0;
        return setup.enters(boxes[number], cut, zEntry) && fn(number, zEntry, cut);
    };
    if (bvh.nodes.empty()) {
        for (const std::uint32_t number : bounded)
            if ((ask == Ask::All || !isBatched_[number]) && leaf(number, zCut)) return;
        return;
    }
    if (ask == Ask::All)
        for (const std::uint32_t number : batched)
            if (leaf(number, zCut)) return;
    traverse(bvh, setup, zCut,
             [&](std::uint32_t position, float& cut) { return leaf(inTree_[position], cut); });
}

// A total order, because shapes with triangles have numbers in a row (render/scene.cpp).
bool ShapeSet::isBefore(const Ray& ray, const Hit& a, const Hit& b) const {
    const auto orderA = shapes[a.shape]->tieOrder(ray, a);
    const auto orderB = shapes[b.shape]->tieOrder(ray, b);
    if (orderA && orderB && *orderA != *orderB) return orderA->isBefore(*orderB);
    return std::tie(a.shape, a.prim) < std::tie(b.shape, b.prim);
}

bool ShapeSet::takeNearer(const Ray& ray, Hit hit, std::uint32_t number, float tEntry,
                          Hit& best) const {
    hit.t = max(tEntry, hit.t);
    hit.shape = number;
    if (hit.t > best.t) return false;
    if (hit.t == best.t && best.isHit() && !isBefore(ray, hit, best)) return false;
    best = hit;
    return true;
}

bool ShapeSet::nearer(const Ray& ray, std::uint32_t number, float tEntry, Hit& best) const {
    Hit hit = best;
    return shapes[number]->intersect(ray, hit) && takeNearer(ray, hit, number, tEntry, best);
}

void ShapeSet::visitNearer(const Ray& ray, const RaySetup& setup, Ask ask, Hit& best) const {
    visit(setup, depthCut(1.0f / (best.t * setup.dz)), ask,
          [&](std::uint32_t number, float zEntry, float& zCut) {
              if (nearer(ray, number, zEntry / setup.dz, best))
                  zCut = min(depthCut(1.0f / (best.t * setup.dz)), zCut);
              return false;
          });
}

Hit ShapeSet::closest(const Ray& ray) const {
    Hit best;
    best.t = ray.tMax;
    if (!canHit(ray)) return best;
    visitNearer(ray, RaySetup(ray.org, ray.dir, extent), Ask::All, best);
    return best;
}

void ShapeSet::closest(const RaySpan& rays, std::vector<Hit>& hits) const {
    hits.resize(rays.size());
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = {.t = rays.tMax[i]};
    if (!batched.empty()) closestOfBatched(rays, hits);
    if (!unbounded.empty()) closestOfUnbounded(rays, hits);
    if (bounded.size() == batched.size()) return;
    if (kernel_) {
        const SolidCalls calls{
            this,
            [](const void* set, const Ray& ray, std::uint32_t number, float tEntry, Hit& best) {
                return static_cast<const ShapeSet*>(set)->nearer(ray, number, tEntry, best);
            },
            nullptr};
        if (!solids_.solids.empty()) closestSolids(*kernel_, solids_, calls, rays, hits);
        if (!placed_.isEmpty()) placed_.closest(*this, rays, hits);
        return;
    }
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray ray = rays[i];
        if (canHit(ray))
            visitNearer(ray, RaySetup(ray.org, ray.dir, extent), Ask::ButBatched, hits[i]);
    }
}

void ShapeSet::closestOfBatched(const RaySpan& rays, std::vector<Hit>& hits) const {
    thread_local std::vector<Hit> found;
    found.resize(rays.size());
    for (const std::uint32_t number : batched) {
        shapes[number]->intersectBatch(rays, number, found);
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

bool ShapeSet::isHidden(const Ray& ray, const RaySetup& setup, Ask ask) const {
    bool found = false;
    visit(setup, depthCut(1.0f / (ray.tMax * setup.dz)), ask,
          [&](std::uint32_t number, float, float&) {
              found = shadows[number] == Shadow::Opaque && shapes[number]->occludes(ray);
              return found;
          });
    return found;
}

bool ShapeSet::occluded(const Ray& ray) const {
    return canHit(ray) && isHidden(ray, RaySetup(ray.org, ray.dir, extent), Ask::All);
}

void ShapeSet::occluded(const RaySpan& rays, std::vector<std::uint8_t>& hidden) const {
    hidden.assign(rays.size(), 0);
    if (!batched.empty()) hideByBatched(rays, hidden);
    if (!unbounded.empty()) hideByUnbounded(rays, hidden);
    if (bounded.size() == batched.size()) return;
    if (kernel_) {
        const SolidCalls calls{
            this, nullptr, [](const void* set, const Ray& ray, std::uint32_t number) {
                return static_cast<const ShapeSet*>(set)->shapes[number]->occludes(ray);
            }};
        if (!solids_.solids.empty()) anySolids(*kernel_, solids_, calls, rays, hidden);
        if (!placed_.isEmpty()) placed_.occluded(*this, rays, hidden);
        return;
    }
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

void ShapeSet::closestOfUnbounded(const RaySpan& rays, std::vector<Hit>& hits) const {
    thread_local std::vector<PlaneHit> found;
    found.resize(std::max(found.size(), rays.size()));
    for (const Floor& floor : floors_) {
        const std::size_t count = planeKernel_->closest(floor.plane, rays, hits, found.data());
        for (const PlaneHit& at : std::span(found).first(count))
            takeNearer(rays[at.ray], {.t = at.t, .u = at.u}, floor.number, 0, hits[at.ray]);
    }
    if (askedAlone_.empty()) return;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray ray = rays[i];
        if (!canHit(ray)) continue;
        for (const std::uint32_t number : askedAlone_) nearer(ray, number, 0, hits[i]);
    }
}

void ShapeSet::hideByUnbounded(const RaySpan& rays, std::vector<std::uint8_t>& hidden) const {
    const auto isOpaque = [&](std::uint32_t number) { return shadows[number] == Shadow::Opaque; };
    for (const Floor& floor : floors_)
        if (isOpaque(floor.number)) planeKernel_->any(floor.plane, rays, hidden.data());
    if (askedAlone_.empty()) return;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray ray = rays[i];
        if (hidden[i] != 0 || !canHit(ray)) continue;
        hidden[i] = std::any_of(askedAlone_.begin(), askedAlone_.end(), [&](std::uint32_t number) {
            return isOpaque(number) && shapes[number]->occludes(ray);
        });
    }
}

void ShapeSet::seeThroughHits(const Ray& ray, std::vector<Hit>& hits) const {
    if (!canHit(ray)) return;
    const RaySetup setup(ray.org, ray.dir, extent);
    const std::size_t before = hits.size();
    visit(setup, depthCut(1.0f / (ray.tMax * setup.dz)), Ask::All,
          [&](std::uint32_t number, float, float&) {
              if (shadows[number] != Shadow::SeeThrough) return false;
              const std::size_t first = hits.size();
              shapes[number]->collect(ray, hits);
              for (std::size_t i = first; i < hits.size(); ++i) hits[i].shape = number;
              return false;
          });
    std::sort(
        hits.begin() + static_cast<std::ptrdiff_t>(before), hits.end(),
        [&](const Hit& a, const Hit& b) { return a.t != b.t ? a.t < b.t : isBefore(ray, a, b); });
}
