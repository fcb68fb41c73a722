// Checkered: a shape with two materials on alternating unit squares of its texture coordinates.
#pragma once

#include "shape/shape.h"

#include <memory>

class Checkered final : public Shape {
public:
    // The shape's own material where floor(u) + floor(v) is even, the other one elsewhere.
    Checkered(std::unique_ptr<const Shape> shape, std::uint32_t otherMaterial);

    Bounds bounds() const override { return shape_->bounds(); }
    bool intersect(const Ray& ray, Hit& hit) const override { return shape_->intersect(ray, hit); }
    bool occludes(const Ray& ray) const override { return shape_->occludes(ray); }
    void collect(const Ray& ray, std::vector<Hit>& hits) const override {
        shape_->collect(ray, hits);
    }
    bool takesBatches() const override { return shape_->takesBatches(); }
    void intersectBatch(const RaySpan& rays, std::uint32_t number,
                        std::span<Hit> hits) const override {
        shape_->intersectBatch(rays, number, hits);
    }
    void occludesBatch(const RaySpan& rays, std::span<std::uint8_t> hidden) const override {
        shape_->occludesBatch(rays, hidden);
    }
    SolidForm solidForm() const override { return shape_->solidForm(); }
    const StillShape* stillToShade() const override { return inLanes_ ? &*inLanes_ : nullptr; }
    bool seesFront(const Ray& ray, const Hit& hit) const override {
        return shape_->seesFront(ray, hit);
    }
    Surface surface(const Ray& ray, const Hit& hit) const override;
    SurfaceDerivatives derivatives(const Ray& ray, const Hit& hit) const override {
        return shape_->derivatives(ray, hit);
    }

private:
    std::unique_ptr<const Shape> shape_;
    std::uint32_t otherMaterial_;
    std::optional<StillShape> inLanes_; // of planes
};
