#include "scene/shape_set.h"

#include "accel/kernels/wide_walk.h"
#include "base/for_each.h"
#include "scene/frame.h"
#include "shape/analytic_shape.h"
#include "shape/mesh_instance.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace {

RawVector<Bounds> boxesOf(std::span<const std::uint32_t> numbers, std::span<const Bounds> all,
                          int threads) {
    constexpr std::size_t kTogether = 1 << 14;
    RawVector<Bounds> out(numbers.size());
    forEachPart(threads, numbers.size(), kTogether, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) out[i] = all[numbers[i]];
    });
    return out;
}

} // namespace

void ShapeSet::resize(std::size_t count) {
    shapes.resize(count), boxes.resize(count), shadows.resize(count), ways_.resize(count);
}

void ShapeSet::set(std::size_t number, std::unique_ptr<const Shape> shape, Shadow shadow) {
    boxes[number] = shape->bounds();
    shadows[number] = shadow;
    ways_[number] = shape->takesBatches()   ? Way::Batched
                    : shape->meshInstance() ? Way::Instance
                                            : Way::Alone;
    shapes[number] = std::move(shape);
}

void ShapeSet::add(std::unique_ptr<const Shape> shape, Shadow shadow) {
    resize(shapes.size() + 1);
    set(shapes.size() - 1, std::move(shape), shadow);
}

void ShapeSet::finish(bool withBvh, const Isa& kernel, int threads) {
    if (withBvh) kernel_ = kernel.solids;
    sortByBounds(threads);
    for (const std::uint32_t number : unbounded) {
        const SolidForm form = shapes[number]->solidForm();
        if (form.faces && form.faces->of == StillFaces::Of::Endless && kernel_)
            solids_.addEndless(number, shadows[number] == Shadow::Opaque, form);
        else
            askedAlone_.push_back(number);
    }
    for (const std::uint32_t number : bounded) {
        if (ways_[number] == Way::Batched && kernel_ && shapes[number]->solidForm().facets)
            ways_[number] = Way::Alone;
        if (ways_[number] == Way::Batched) batched.push_back(number);
    }
    hasTrees_ = withBvh;
    if (withBvh) buildTrees(kernel, threads);
}

void ShapeSet::sortByBounds(int threads) {
    constexpr std::size_t kTogether = 1 << 14;
    struct Part {
        std::vector<std::uint32_t> bounded, unbounded, distant;
        float extent = 0, distantExtent = 0;
    };
    std::vector<Part> parts((shapes.size() + kTogether - 1) / kTogether);
    forEachPart(threads, shapes.size(), kTogether, [&](std::size_t first, std::size_t last) {
        Part& part = parts[first / kTogether];
        part.bounded.reserve(last - first);
        for (std::size_t number = first; number < last; ++number) {
            const Bounds& box = boxes[number];
            const float farthest = max(maxAbs(box.lo), maxAbs(box.hi));
            if (box.isFinite() && isDistant(box, distantFrom)) {
                part.distant.push_back(static_cast<std::uint32_t>(number));
                part.distantExtent = max(farthest, part.distantExtent);
            } else if (box.isFinite()) {
                part.bounded.push_back(static_cast<std::uint32_t>(number));
                part.extent = max(farthest, part.extent);
            } else if (!box.isEmpty()) {
                part.unbounded.push_back(static_cast<std::uint32_t>(number));
            }
        }
    });
    bounded.reserve(shapes.size());
    for (const Part& part : parts) {
        bounded.insert(bounded.end(), part.bounded.begin(), part.bounded.end());
        unbounded.insert(unbounded.end(), part.unbounded.begin(), part.unbounded.end());
        distant.insert(distant.end(), part.distant.begin(), part.distant.end());
        extent = max(part.extent, extent);
        distantExtent_ = max(part.distantExtent, distantExtent_);
    }
}

void ShapeSet::buildTrees(const Isa& kernel, int threads) {
    std::vector<std::uint32_t> numbers; // of the solids
    numbers.reserve(bounded.size());
    for (const std::uint32_t number : bounded) {
        if (ways_[number] == Way::Batched) continue;
        const auto isOf = [&](const MeshGeometry& mesh) { return kernel_ && mesh.isa == &kernel; };
        if (ways_[number] == Way::Instance && isOf(shapes[number]->meshInstance()->geometry()))
            placed_.add(boxes[number], number, shadows[number] == Shadow::Opaque,
                        shapes[number]->meshInstance()->geometry().wide);
        else
            numbers.push_back(number);
    }
    const auto describe = [&](std::uint32_t i, std::uint32_t next) -> SolidTree::Described {
        const auto* const soon = reinterpret_cast<const char*>(shapes[numbers[next]].get());
        for (std::size_t at = 0; at < sizeof(AnalyticShape); at += 64)
            __builtin_prefetch(soon + at);
        const std::uint32_t number = numbers[i];
        return {number, shadows[number] == Shadow::Opaque,
                kernel_ ? shapes[number]->solidForm() : SolidForm()};
    };
    const RawVector<Bounds> some =
        numbers.size() < boxes.size() ? boxesOf(numbers, boxes, threads) : RawVector<Bounds>();
    const std::span<const Bounds> of = some.empty() ? std::span<const Bounds>(boxes) : some;
    solids_.extent = extent;
    if (!numbers.empty()) solids_.build(kernel.nodeWidth(), of, describe, threads);
    if (!placed_.isEmpty()) placed_.build(kernel, extent, threads);
    for (const std::uint32_t number : distant) distantTree_.add(boxes[number], number, true, {});
    distantTree_.build(kernel.nodeWidth(), threads);
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
    if (!hasTrees_) {
        for (const std::uint32_t number : bounded)
            if ((ask == Ask::All || ways_[number] != Way::Batched) && leaf(number, zCut)) return;
        return;
    }
    if (ask == Ask::All)
        for (const std::uint32_t number : batched)
            if (leaf(number, zCut)) return;
    if (!traverse(solids_, setup, zCut, leaf)) traverse(placed_.boxes(), setup, zCut, leaf);
}

// fn(shape, zEntry, zCut) for every distant shape whose box the ray enters in front of tMax; true
// stops and is returned.
template <class VisitFn>
bool ShapeSet::visitDistant(const Ray& ray, float tMax, VisitFn&& fn) const {
    if (distant.empty()) return false;
    const RaySetup setup(ray.org, ray.dir, distantExtent_);
    float zCut = depthCut(1.0f / (tMax * setup.dz));
    const auto leaf = [&](std::uint32_t number, float& cut) {
        float zEntry = 0;
        return setup.enters(boxes[number], cut, zEntry) && fn(setup, number, zEntry, cut);
    };
    if (hasTrees_) return traverse(distantTree_, setup, zCut, leaf);
    return std::any_of(distant.begin(), distant.end(),
                       [&](std::uint32_t number) { return leaf(number, zCut); });
}

// A total order, because shapes with triangles have numbers in a row (scene/scene.cpp).
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

void ShapeSet::nearerOfDistant(const Ray& ray, Hit& best) const {
    visitDistant(ray, best.t,
                 [&](const RaySetup& setup, std::uint32_t number, float zEntry, float& zCut) {
                     if (nearer(ray, number, zEntry / setup.dz, best))
                         zCut = min(depthCut(1.0f / (best.t * setup.dz)), zCut);
                     return false;
                 });
}

bool ShapeSet::isHiddenByDistant(const Ray& ray) const {
    return visitDistant(ray, ray.tMax, [&](const RaySetup&, std::uint32_t number, float, float&) {
        return shadows[number] == Shadow::Opaque && shapes[number]->occludes(ray);
    });
}

void ShapeSet::visitNearer(const Ray& ray, const RaySetup& setup, Ask ask, Hit& best) const {
    if (ask == Ask::All) nearerOfDistant(ray, best);
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

bool ShapeSet::isHidden(const Ray& ray, const RaySetup& setup, Ask ask) const {
    bool found = ask == Ask::All && isHiddenByDistant(ray);
    if (found) return true;
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

void ShapeSet::seeThroughHits(const Ray& ray, std::vector<Hit>& hits) const {
    if (!canHit(ray)) return;
    const RaySetup setup(ray.org, ray.dir, extent);
    const std::size_t before = hits.size();
    const auto collect = [&](std::uint32_t number) {
        if (shadows[number] != Shadow::SeeThrough) return false;
        const std::size_t first = hits.size();
        shapes[number]->collect(ray, hits);
        for (std::size_t i = first; i < hits.size(); ++i) hits[i].shape = number;
        return false;
    };
    visitDistant(ray, ray.tMax, [&](const RaySetup&, std::uint32_t number, float, float&) {
        return collect(number);
    });
    visit(setup, depthCut(1.0f / (ray.tMax * setup.dz)), Ask::All,
          [&](std::uint32_t number, float, float&) { return collect(number); });
    std::sort(
        hits.begin() + static_cast<std::ptrdiff_t>(before), hits.end(),
        [&](const Hit& a, const Hit& b) { return a.t != b.t ? a.t < b.t : isBefore(ray, a, b); });
}
