// ShapeSet: all shapes of a scene and the top tree over them. Nearest and any-hit queries for one
// ray, and for batches of rays with the same answers.
#pragma once

#include "accel/bvh.h"
#include "accel/kernels/solids.h"
#include "shape/shape.h"

#include <cstdint>
#include <memory>
#include <vector>

struct ShapeSet {
    // How shadow rays see a shape.
    enum class Shadow : std::uint8_t { Opaque, SeeThrough, None };

    std::vector<std::unique_ptr<const Shape>> shapes; // number = Hit::shape
    std::vector<Bounds> boxes;
    std::vector<Shadow> shadows;
    std::vector<std::uint32_t> bounded, unbounded; // shape numbers; `bounded` in ascending order
    Bvh bvh;          // over the bounded ones, by position in `bounded`; empty: linear search
    float extent = 0; // largest |coordinate| of a finite box

    void add(std::unique_ptr<const Shape> shape, Shadow shadow);
    // Call once after the last add(). Batches are answered by the kernel, if it has a part for
    // solids and a tree is wanted; else as single rays are.
    void finish(bool withBvh, const Kernel& kernel = chooseKernel("scalar"), int threads = 1);
    // Bounded shapes that take batches themselves; the batch queries ask them first.
    std::vector<std::uint32_t> batched;

    // The hit with the smallest (t, shape) in (tMin, tMax]; Hit::isHit() tells if there is one.
    // t is at least the entry into the shape's own box, so that no tree can change the answer.
    Hit closest(const Ray& ray) const;
    // Is an opaque shape in (tMin, tMax)?
    bool occluded(const Ray& ray) const;
    // The same for all rays of a batch.
    void closest(const RaySpan& rays, std::vector<Hit>& hits) const;
    void occluded(const RaySpan& rays, std::vector<std::uint8_t>& hidden) const;
    // Appends every hit of the see-through shapes in (tMin, tMax), nearest first, ties by number.
    void seeThroughHits(const Ray& ray, std::vector<Hit>& hits) const;

private:
    // Which bounded shapes a query still has to ask.
    enum class Ask : std::uint8_t { All, ButBatched };
    template <class VisitFn>
    void visit(const RaySetup& setup, float zCut, Ask ask, VisitFn&& fn) const;
    void visitNearer(const Ray& ray, const RaySetup& setup, Ask ask, Hit& best) const;
    bool isHidden(const Ray& ray, const RaySetup& setup, Ask ask) const;
    void buildSolids(int width);
    void closestOfBatched(const RaySpan& rays, std::vector<Hit>& hits) const;
    void hideByBatched(const RaySpan& rays, std::vector<std::uint8_t>& hidden) const;

    std::vector<std::uint8_t> isBatched_; // by shape
    const SolidKernel* kernel_ = nullptr; // null: the scalar code answers
    SolidTree solids_;                    // the bounded shapes that take no batches themselves
};
