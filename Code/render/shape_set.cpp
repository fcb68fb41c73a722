#include "render/shape_set.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace {

// A tree over fewer shapes costs more than it saves; the answer is the same either way.
constexpr std::size_t kFewestForTree = 5;

} // namespace

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

void ShapeSet::finish(bool withBvh) {
    for (const std::uint32_t number : bounded)
        if (shapes[number]->takesBatches()) batched.push_back(number);
    if (!withBvh || bounded.size() < kFewestForTree) return;
    std::vector<Bounds> inOrder;
    for (const std::uint32_t number : bounded) inOrder.push_back(boxes[number]);
    bvh = buildBvh(inOrder);
    bvh.nodes.shrink_to_fit();
}

// fn(shape, zEntry, zCut) for every shape whose box the ray enters in front of zCut; true stops.
template <class VisitFn>
void ShapeSet::visit(const RaySetup& setup, float zCut, Ask ask, VisitFn&& fn) const {
    for (const std::uint32_t number : unbounded)
        if (fn(number, 0.0f, zCut)) return;
    const auto leaf = [&](std::uint32_t position, float& cut) {
        const std::uint32_t number = bounded[position];
        if (ask == Ask::ButBatched && isBatched(number)) return false;
        float zEntry = 0;
        return setup.enters(boxes[number], cut, zEntry) && fn(number, zEntry, cut);
    };
    if (!bvh.nodes.empty()) return traverse(bvh, setup, zCut, leaf);
    for (std::uint32_t i = 0; i < bounded.size(); ++i)
        if (leaf(i, zCut)) return;
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

void ShapeSet::visitNearer(const Ray& ray, const RaySetup& setup, Ask ask, Hit& best) const {
    visit(setup, depthCut(1.0f / (best.t * setup.dz)), ask,
          [&](std::uint32_t number, float zEntry, float& zCut) {
              Hit hit = best;
              if (!shapes[number]->intersect(ray, hit)) return false;
              if (takeNearer(ray, hit, number, zEntry / setup.dz, best))
                  zCut = min(depthCut(1.0f / (best.t * setup.dz)), zCut);
              return false;
          });
}

Hit ShapeSet::closest(const Ray& ray) const {
    Hit best;
    best.t = ray.tMax;
    if (!isTraceable(ray)) return best;
    visitNearer(ray, RaySetup(ray.org, ray.dir, extent), Ask::All, best);
    return best;
}

void ShapeSet::closest(const RaySpan& rays, std::vector<Hit>& hits) const {
    hits.resize(rays.size());
    if (batched.empty()) {
        for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = closest(rays[i]);
        return;
    }
    thread_local std::vector<std::vector<Hit>> found;
    found.resize(std::max(found.size(), batched.size()));
    for (std::size_t b = 0; b < batched.size(); ++b) {
        found[b].resize(rays.size());
        shapes[batched[b]]->intersectBatch(rays, batched[b], found[b]);
    }
    const bool others = shapes.size() > batched.size();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray ray = rays[i];
        Hit& best = hits[i];
        best = {.t = ray.tMax};
        bool any = others;
        for (std::size_t b = 0; b < batched.size(); ++b) any |= found[b][i].isHit();
        if (!any || !isTraceable(ray)) continue;
        const RaySetup setup(ray.org, ray.dir, extent);
        for (std::size_t b = 0; b < batched.size(); ++b) {
            float zEntry = 0;
            const float zCut = depthCut(1.0f / (best.t * setup.dz));
            if (found[b][i].isHit() && setup.enters(boxes[batched[b]], zCut, zEntry))
                takeNearer(ray, found[b][i], batched[b], zEntry / setup.dz, best);
        }
        if (others) visitNearer(ray, setup, Ask::ButBatched, best);
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
    return isTraceable(ray) && isHidden(ray, RaySetup(ray.org, ray.dir, extent), Ask::All);
}

void ShapeSet::occluded(const RaySpan& rays, std::vector<std::uint8_t>& hidden) const {
    hidden.assign(rays.size(), 0);
    thread_local std::vector<std::uint8_t> found;
    found.resize(rays.size());
    for (const std::uint32_t number : batched) {
        if (shadows[number] != Shadow::Opaque) continue;
        shapes[number]->occludesBatch(rays, found);
        for (std::size_t i = 0; i < rays.size(); ++i) hidden[i] |= found[i];
    }
    if (shapes.size() == batched.size()) return;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Ray ray = rays[i];
        if (hidden[i] != 0 || !isTraceable(ray)) continue;
        hidden[i] = isHidden(ray, RaySetup(ray.org, ray.dir, extent), Ask::ButBatched);
    }
}

void ShapeSet::seeThroughHits(const Ray& ray, std::vector<Hit>& hits) const {
    if (!isTraceable(ray)) return;
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
