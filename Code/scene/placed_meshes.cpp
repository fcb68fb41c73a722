#include "scene/placed_meshes.h"

#include "scene/shape_set.h"
#include "shape/mesh_instance.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

namespace {

// What a ray is doing.
struct Slot {
    Ray ray;
    std::uint32_t index = 0;       // in the batch
    std::optional<RaySetup> setup; // in the scene, from the first instance on
    // At an instance:
    std::optional<MeshInstance::Visit> visit;
    std::uint32_t number = 0;
    float tEntry = 0, zCut = 0; // in the scene
    NearestTriangle nearest;
};

class Query : public PlacedQuery {
public:
    Query(const ShapeSet& set, const RaySpan& rays) : set_(set), rays_(rays) {}

    void start(std::uint32_t slot, std::uint32_t ray) final {
        Slot& s = slots_[slot];
        s.index = ray;
        s.ray = rays_[ray];
        s.setup.reset();
    }

protected:
    // False when no tree can help.
    bool visit(Slot& s, std::uint32_t number, float zEntry) const {
        s.number = number;
        if (!s.setup) s.setup.emplace(s.ray.org, s.ray.dir, set_.extent);
        s.tEntry = zEntry / s.setup->dz;
        s.nearest = {};
        s.visit.emplace(*set_.shapes[number]->meshInstance(), s.ray,
                        MeshInstance::Visit::KnownSetup{&*s.setup, set_.extent});
        return s.visit->treeRay().has_value();
    }
    const Shape& shapeOf(const Slot& s) const { return *set_.shapes[s.number]; }

    const ShapeSet& set_;
    const RaySpan& rays_;
    std::array<Slot, PlacedKernel::kSlots> slots_;
};

class Closest final : public Query {
public:
    Closest(const ShapeSet& set, const RaySpan& rays, std::span<Hit> hits)
        : Query(set, rays), hits_(hits) {}

    float limit(std::uint32_t ray) const override { return hits_[ray].t; }
    bool enter(std::uint32_t slot, std::uint32_t number, float zEntry, TreeVisit& to) override {
        Slot& s = slots_[slot];
        Hit& best = hits_[s.index];
        if (!visit(s, number, zEntry)) {
            Hit hit = best;
            if (shapeOf(s).intersect(s.ray, hit))
                set_.takeNearer(s.ray, hit, number, s.tEntry, best);
            return false;
        }
        s.zCut = depthCut(1.0f / (best.t * s.visit->setup().dz));
        to = s.visit->inTree(s.zCut);
        return true;
    }
    float test(std::uint32_t slot, std::uint32_t triangle, const Vec3d& a, const Vec3d& b,
               const Vec3d& c) override {
        Slot& s = slots_[slot];
        s.nearest.show(s.visit->setup(), s.ray.tMin, triangle, s.visit->placed(a, b, c), s.zCut);
        return s.visit->treeCut(s.zCut);
    }
    float leave(std::uint32_t slot) override {
        Slot& s = slots_[slot];
        Hit& best = hits_[s.index];
        Hit hit = best;
        if (s.nearest.becomes(s.visit->setup(), hit) && shapeOf(s).seesHit(s.ray, best.t, hit))
            set_.takeNearer(s.ray, hit, s.number, s.tEntry, best);
        return depthCut(1.0f / (best.t * s.setup->dz));
    }

private:
    std::span<Hit> hits_;
};

class Any final : public Query {
public:
    Any(const ShapeSet& set, const RaySpan& rays, std::span<std::uint8_t> hidden)
        : Query(set, rays), hidden_(hidden) {}

    float limit(std::uint32_t ray) const override { return rays_.tMax[ray]; }
    bool enter(std::uint32_t slot, std::uint32_t number, float zEntry, TreeVisit& to) override {
        Slot& s = slots_[slot];
        const bool hasTree = visit(s, number, zEntry);
        s.zCut = depthCut(1.0f / (s.ray.tMax * s.setup->dz));
        if (!hasTree) {
            hidden_[s.index] = shapeOf(s).occludes(s.ray);
            return false;
        }
        to = s.visit->inTree(rangeOf(s).farthest());
        return true;
    }
    float test(std::uint32_t slot, std::uint32_t, const Vec3d& a, const Vec3d& b,
               const Vec3d& c) override {
        Slot& s = slots_[slot];
        const float key = canonicalKey(s.visit->setup(), s.visit->placed(a, b, c));
        if (!rangeOf(s).contains(key)) return s.visit->treeCut(rangeOf(s).farthest());
        hidden_[s.index] = 1;
        return -1;
    }
    float leave(std::uint32_t slot) override {
        const Slot& s = slots_[slot];
        return hidden_[s.index] != 0 ? -1.0f : s.zCut;
    }

private:
    static KeyRange rangeOf(const Slot& s) { return {s.visit->setup().dz, s.ray.tMin, s.ray.tMax}; }

    std::span<std::uint8_t> hidden_;
};

} // namespace

void PlacedMeshes::add(const Bounds& box, std::uint32_t number, bool hides, const WideTree& tree) {
    boxes_.push_back(box);
    tree_.boxes.add(box, number, hides, {});
    tree_.meshStack = std::max(tree.stackSize, tree_.meshStack);
}

void PlacedMeshes::build(const Isa& kernel, float extent, int threads) {
    kernel_ = kernel.placed;
    tree_.boxes.extent = extent;
    for (const Bounds& box : boxes_) tree_.whole.extend(box);
    tree_.boxes.build(kernel.nodeWidth(), threads);
    tree_.boxStack = stackSize(tree_.boxes);
}

void PlacedMeshes::closest(const ShapeSet& set, const RaySpan& rays, std::span<Hit> hits) const {
    thread_local std::vector<std::uint32_t> order;
    order.resize(rays.size());
    std::iota(order.begin(), order.end(), 0u);
    Closest query(set, rays, hits);
    kernel_->closest(tree_, query, rays, order);
}

void PlacedMeshes::occluded(const ShapeSet& set, const RaySpan& rays,
                            std::span<std::uint8_t> hidden) const {
    thread_local std::vector<std::uint32_t> order;
    order.clear();
    for (std::uint32_t i = 0; i < rays.size(); ++i)
        if (hidden[i] == 0) order.push_back(i);
    Any query(set, rays, hidden);
    kernel_->any(tree_, query, rays, order);
}
