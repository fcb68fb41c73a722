// OneSided: a shape of which rays of sight see one side only, as polygons of NFF; a shape around
// another one, so that those with both sides pay nothing.
#pragma once

#include "shape/shape.h"

#include <memory>

class OneSided final : public Shape {
public:
    enum class Side { Front, Back }; // Front: the normal points towards the eye
    OneSided(std::unique_ptr<const Shape> shape, Side visible);

    Bounds bounds() const override { return shape_->bounds(); }
    // Passes over hits from the other side.
    bool intersect(const Ray& ray, Hit& hit) const override;
    // Shadows fall from both sides: light that is on the other side of a closed surface of
    // one-sided polygons must not get in.
    bool occludes(const Ray& ray) const override { return shape_->occludes(ray); }
    void collect(const Ray& ray, std::vector<Hit>& hits) const override {
        shape_->collect(ray, hits);
    }
    bool takesBatches() const override { return shape_->takesBatches(); }
    void intersectBatch(const RaySpan& rays, std::uint32_t number,
                        std::span<Hit> hits) const override;
    void occludesBatch(const RaySpan& rays, std::span<std::uint8_t> hidden) const override {
        shape_->occludesBatch(rays, hidden);
    }
    const MeshInstance* meshInstance() const override { return shape_->meshInstance(); }
    bool seesHit(const Ray& ray, float tMax, Hit& hit) const override;
    SolidForm solidForm() const override;
    bool seesFront(const Ray& ray, const Hit& hit) const override {
        return shape_->seesFront(ray, hit);
    }
    Surface surface(const Ray& ray, const Hit& hit) const override {
        return shape_->surface(ray, hit);
    }
    Surface surfaceFor(const Ray& ray, const Hit& hit, SurfaceNeeds needs) const override {
        return shape_->surfaceFor(ray, hit, needs);
    }
    void surfaces(const SurfaceQuery& query, SurfacePlaces out) const override {
        shape_->surfaces(query, out);
    }
    const StillShape* stillToShade() const override { return shape_->stillToShade(); }
    SurfaceDerivatives derivatives(const Ray& ray, const Hit& hit) const override {
        return shape_->derivatives(ray, hit);
    }
    std::optional<TieOrder> tieOrder(const Ray& ray, const Hit& hit) const override {
        return shape_->tieOrder(ray, hit);
    }

private:
    bool isVisible(const Ray& ray, const Hit& hit) const;
    // The nearest of all crossings that are visible and not behind hit.t.
    bool lookThrough(const Ray& ray, Hit& hit) const;

    std::unique_ptr<const Shape> shape_;
    Side visible_;
};
