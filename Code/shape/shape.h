// Shape: the interface between geometry and everything else. One file per shape beside this one;
// to add one, derive, add it to scene/make_shape.cpp and the tables of desc/, and write its test.
// Shapes know rays and transforms; they never see materials, lights or the scene.
//
// World space here is the scene's normalised space (scene/scene.h). Shapes compute in double in
// their own object space: the ray's floats are taken as exact, so that a hit depends on nothing but
// the ray and the shape.
#pragma once

#include "accel/kernels/surface_lanes.h"
#include "accel/solid_form.h"
#include "base/bounds.h"
#include "base/function_ref.h"
#include "base/ray.h"
#include "base/surface_block.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

// Who is first of two triangles that a ray hits at the same t: the larger key, 1/depth before it
// was rounded to t, then the object that the scene names first.
struct TieOrder {
    float key = 0;
    std::uint32_t object = 0;
    bool operator==(const TieOrder&) const = default;
    bool isBefore(const TieOrder& other) const {
        return key != other.key ? key > other.key : object < other.object;
    }
};

// Surfaces that are asked for together: of the hits of some rays of a batch, all on one shape.
struct SurfaceQuery {
    RaySpan rays;
    std::span<const Hit> hits;            // of all rays
    std::span<const std::uint32_t> which; // rays
    std::span<const std::uint32_t> to;    // places of their surfaces
    SurfaceNeeds needs;
    SurfaceLanes lanes; // of the kernel, for who has use for them
};

class MeshInstance;

class Shape {
public:
    virtual ~Shape() = default;

    // World box over the whole shutter, rounded outward; infinite for an unbounded shape.
    virtual Bounds bounds() const = 0;

    // Nearest hit with ray.tMin < t <= hit.t. Writes t, u, v and prim (never shape) and returns
    // true; leaves `hit` alone otherwise. Equal t is accepted: the caller prefers the lower shape.
    virtual bool intersect(const Ray& ray, Hit& hit) const = 0;

    // Is there any hit with ray.tMin < t < ray.tMax?
    virtual bool occludes(const Ray& ray) const = 0;

    // Appends every hit with ray.tMin < t < ray.tMax, in any order (t, u, v, prim set).
    virtual void collect(const Ray& ray, std::vector<Hit>& hits) const = 0;

    // Batches: the same answers for many rays. A shape that is faster this way says so; the others
    // are asked ray by ray.
    virtual bool takesBatches() const { return false; }
    // hits[i] becomes what intersect() finds up to rays[i].tMax, with its shape = number; isHit()
    // is false where there is nothing.
    virtual void intersectBatch(const RaySpan& rays, std::uint32_t number,
                                std::span<Hit> hits) const {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            hits[i] = {.t = rays.tMax[i]};
            if (intersect(rays[i], hits[i])) hits[i].shape = number;
        }
    }
    // hidden[i] = occludes(rays[i])
    virtual void occludesBatch(const RaySpan& rays, std::span<std::uint8_t> hidden) const {
        for (std::size_t i = 0; i < rays.size(); ++i) hidden[i] = occludes(rays[i]);
    }

    // The mesh that this is an instance of, if it is one: kernels take the rays through its tree.
    virtual const MeshInstance* meshInstance() const { return nullptr; }
    // What intersect() makes of the instance's nearest hit not behind tMax, as not all of its sides
    // may be seen. False: nothing.
    virtual bool seesHit(const Ray& /*ray*/, float /*tMax*/, Hit& /*hit*/) const { return true; }

    // What helps a kernel to find candidates; the hull is not asked for of unbounded shapes.
    virtual SolidForm solidForm() const { return {ballAround(toDouble(bounds())), {}}; }

    // Does the ray come from the outside of the surface at this hit?
    virtual bool seesFront(const Ray& ray, const Hit& hit) const {
        return dot(surfaceFor(ray, hit, {false, false}).ng, ray.dir) <= 0;
    }

    // Describes the point of a hit that intersect() or collect() found for this ray.
    virtual Surface surface(const Ray& ray, const Hit& hit) const = 0;
    // The same, where a shape may leave out what is not asked for.
    virtual Surface surfaceFor(const Ray& ray, const Hit& hit, SurfaceNeeds) const {
        return surface(ray, hit);
    }
    // out[to[k]] becomes surfaceFor(ray, hit) of ray which[k].
    virtual void surfaces(const SurfaceQuery& query, SurfacePlaces out) const {
        for (std::size_t k = 0; k < query.which.size(); ++k) {
            const std::uint32_t i = query.which[k];
            out[query.to[k]].put(surfaceFor(query.rays[i], query.hits[i], query.needs));
        }
    }
    // What lanes need that do the hits of many shapes together, but no texture coordinates; null:
    // they can't.
    virtual const StillShape* stillToShade() const { return nullptr; }
    virtual SurfaceDerivatives derivatives(const Ray& ray, const Hit& hit) const = 0;

    // Calls fn(number as hits have it, corners, material) for all triangles of a mesh that stands
    // still; other shapes have none.
    using TriangleFn = FunctionRef<void(std::uint32_t, const std::array<Vec3, 3>&, std::uint32_t)>;
    virtual void forEachTriangle(TriangleFn) const {}

    // Of a hit on a triangle, which may have come into one mesh with others or not; shapes of other
    // kinds go by their numbers.
    virtual std::optional<TieOrder> tieOrder(const Ray&, const Hit&) const { return {}; }
};
