// ShapeSet: all shapes of a scene and the top tree over them. Nearest and any-hit queries for one
// ray, and for batches of rays with the same answers.
#pragma once

#include "accel/kernels/solids.h"
#include "scene/placed_meshes.h"
#include "shape/mesh_geometry.h"
#include "shape/shape.h"

#include <cstdint>
#include <memory>
#include <vector>

// Rays of NaN or without a range would look for what there can't be.
inline bool canHit(const Ray& ray) { return isTraceable(ray) && ray.tMin < ray.tMax; }

struct ShapeSet {
    // How shadow rays see a shape.
    enum class Shadow : std::uint8_t { Opaque, SeeThrough, None };

    std::vector<std::unique_ptr<const Shape>> shapes; // number = Hit::shape
    RawVector<Bounds> boxes;
    std::vector<Shadow> shadows;

    // Room for so many.
    void resize(std::size_t count);
    // Once for each of them, by any thread.
    void set(std::size_t number, std::unique_ptr<const Shape> shape, Shadow shadow);
    // One more.
    void add(std::unique_ptr<const Shape> shape, Shadow shadow);
    // Call once when all are there. Batches are answered by the kernel, if it has a part for
    // solids and a tree is wanted; else as single rays are.
    void finish(bool withBvh, const Isa& kernel = oneLane(), int threads = 1);

    // Shape numbers in ascending order; `bounded` without those that isDistant().
    std::vector<std::uint32_t> bounded, unbounded, distant;
    float distantFrom = kInfinityF; // SceneFrame::distantFrom
    float extent = kSceneExtent;    // no |coordinate| of a box of `bounded` is larger
    // Bounded shapes that take batches themselves and are no solids of the kernel; the batch
    // queries ask them first.
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

    const SolidTree& solids() const { return solids_; }
    const PlacedMeshes& placed() const { return placed_; }

    // Takes the hit of a shape if it is nearer than the best one.
    bool takeNearer(const Ray& ray, Hit hit, std::uint32_t number, float tEntry, Hit& best) const;

private:
    // Which bounded shapes a query still has to ask.
    enum class Ask : std::uint8_t { All, ButBatched };
    template <class VisitFn>
    void visit(const RaySetup& setup, float zCut, Ask ask, VisitFn&& fn) const;
    template <class VisitFn> bool visitDistant(const Ray& ray, float tMax, VisitFn&& fn) const;
    void nearerOfDistant(const Ray& ray, Hit& best) const;
    bool isHiddenByDistant(const Ray& ray) const;
    void visitNearer(const Ray& ray, const RaySetup& setup, Ask ask, Hit& best) const;
    bool isHidden(const Ray& ray, const RaySetup& setup, Ask ask) const;
    // Which of two hits at the same t is first.
    bool isBefore(const Ray& ray, const Hit& a, const Hit& b) const;
    // Asks the shape for a nearer hit than the best one, which then becomes it.
    bool nearer(const Ray& ray, std::uint32_t number, float tEntry, Hit& best) const;
    void sortByBounds(int threads);
    void buildTrees(const Isa& kernel, int threads);
    void closestOfBatched(const RaySpan& rays, std::vector<Hit>& hits) const;
    void hideByBatched(const RaySpan& rays, std::vector<std::uint8_t>& hidden) const;
    void closestOfOthers(const RaySpan& rays, std::vector<Hit>& hits) const;
    void hideByOthers(const RaySpan& rays, std::vector<std::uint8_t>& hidden) const;

    // By shape: what it is asked for when it comes, as memory of millions is slow to come back to.
    enum class Way : std::uint8_t { Alone, Batched, Instance };
    std::vector<Way> ways_;
    std::vector<std::uint32_t> askedAlone_; // unbounded shapes that are not in solids_
    SolidTree distantTree_;                 // over `distant`
    float distantExtent_ = 0;               // as `extent`, of `distant`
    const SolidKernel* kernel_ = nullptr;   // null: the scalar code answers
    bool hasTrees_ = false;                 // else: linear search
    SolidTree solids_;                      // the shapes of the tree that are no instances
    PlacedMeshes placed_;                   // those that are, where the kernel traces them
};
