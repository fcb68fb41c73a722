// ShapeSet: all shapes of a scene and the top tree over them. Nearest and any-hit queries for one
// ray, and for batches of rays with the same answers.
#pragma once

#include "accel/bvh.h"
#include "shape/mesh_geometry.h"
#include "shape/shape.h"

#include <algorithm>
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
    Bvh bvh; // over the bounded ones, by position in `bounded`; empty: linear search
    float extent = kSceneExtent; // no |coordinate| of a finite box is larger

    void add(std::unique_ptr<const Shape> shape, Shadow shadow);
    // Call once after the last add().
    void finish(bool withBvh);
    // Shapes that are faster for batches; the batch queries ask them first.
    std::vector<std::uint32_t> batched;

    // The nearest hit in (tMin, tMax]; Hit::isHit() tells if there is one. Of several at the same t
    // the first one by the order of triangles (TieOrder), else by the number of the shape.
    // t is at least the entry into the shape's own box, so that no tree can change the answer.
    Hit closest(const Ray& ray) const;
    // Is an opaque shape in (tMin, tMax)?
    bool occluded(const Ray& ray) const;
    // The same for all rays of a batch.
    void closest(const RaySpan& rays, std::vector<Hit>& hits) const;
    void occluded(const RaySpan& rays, std::vector<std::uint8_t>& hidden) const;
    // Appends every hit of the see-through shapes in (tMin, tMax), nearest first, ties as above.
    void seeThroughHits(const Ray& ray, std::vector<Hit>& hits) const;

private:
    // Which shapes a query still has to ask.
    enum class Ask : std::uint8_t { All, ButBatched };
    template <class VisitFn>
    void visit(const RaySetup& setup, float zCut, Ask ask, VisitFn&& fn) const;
    void visitNearer(const Ray& ray, const RaySetup& setup, Ask ask, Hit& best) const;
    bool isHidden(const Ray& ray, const RaySetup& setup, Ask ask) const;
    // Which of two hits at the same t is first.
    bool isBefore(const Ray& ray, const Hit& a, const Hit& b) const;
    // Takes the hit of a shape if it is nearer than the best one.
    bool takeNearer(const Ray& ray, Hit hit, std::uint32_t number, float tEntry, Hit& best) const;
    bool isBatched(std::uint32_t number) const {
        return std::find(batched.begin(), batched.end(), number) != batched.end();
    }
};
