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
    if (!withBvh || bounded.size() < kFewestForTree) return;
    std::vector<Bounds> inOrder;
    for (const std::uint32_t number : bounded) inOrder.push_back(boxes[number]);
    bvh = buildBvh(inOrder);
    bvh.nodes.shrink_to_fit();
}

// fn(shape, zEntry, zCut) for every shape whose box the ray enters in front of zCut; true stops.
template <class VisitFn>
void ShapeSet::visit(const RaySetup& setup, float zCut, VisitFn&& fn) const {
    for (const std::uint32_t number : unbounded)
        if (fn(number, 0.0f, zCut)) return;
    const auto leaf = [&](std::uint32_t position, float& cut) {
        const std::uint32_t number = bounded[position];
        float zEntry = 0;
        return setup.enters(boxes[number], cut, zEntry) && fn(number, zEntry, cut);
    };
    if (!bvh.nodes.empty()) return traverse(bvh, setup, zCut, leaf);
    for (std::uint32_t i = 0; i < bounded.size(); ++i)
        if (leaf(i, zCut)) return;
}

Hit ShapeSet::closest(const Ray& ray) const {
    Hit best;
    best.t = ray.tMax;
    if (!isTraceable(ray)) return best;
    const RaySetup setup(ray.org, ray.dir, extent);
    visit(setup, depthCut(1.0f / (best.t * setup.dz)),
          [&](std::uint32_t number, float zEntry, float& zCut) {
              Hit hit = best;
              if (!shapes[number]->intersect(ray, hit)) return false;
              hit.t = max(zEntry / setup.dz, hit.t);
              if (hit.t > best.t || (hit.t == best.t && number > best.shape)) return false;
              best = hit;
              best.shape = number;
              zCut = min(depthCut(1.0f / (hit.t * setup.dz)), zCut);
              return false;
          });
    return best;
}

bool ShapeSet::occluded(const Ray& ray) const {
    if (!isTraceable(ray)) return false;
    const RaySetup setup(ray.org, ray.dir, extent);
    bool found = false;
    visit(setup, depthCut(1.0f / (ray.tMax * setup.dz)), [&](std::uint32_t number, float, float&) {
        found = shadows[number] == Shadow::Opaque && shapes[number]->occludes(ray);
        return found;
    });
    return found;
}

void ShapeSet::seeThroughHits(const Ray& ray, std::vector<Hit>& hits) const {
    if (!isTraceable(ray)) return;
    const RaySetup setup(ray.org, ray.dir, extent);
    const std::size_t before = hits.size();
    visit(setup, depthCut(1.0f / (ray.tMax * setup.dz)), [&](std::uint32_t number, float, float&) {
        if (shadows[number] != Shadow::SeeThrough) return false;
        const std::size_t first = hits.size();
        shapes[number]->collect(ray, hits);
        for (std::size_t i = first; i < hits.size(); ++i) hits[i].shape = number;
        return false;
    });
    std::sort(hits.begin() + static_cast<std::ptrdiff_t>(before), hits.end(),
              [](const Hit& a, const Hit& b) {
                  return std::tie(a.t, a.shape, a.prim) < std::tie(b.t, b.shape, b.prim);
              });
}
