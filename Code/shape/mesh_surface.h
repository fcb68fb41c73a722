// The point of a hit on a triangle: where rays leave it, its normals, its texture coordinates. Of a
// merged mesh and of an instance alike, in the scene's space.
#pragma once

#include "shape/mesh_geometry.h"
#include "shape/shape.h"
#include "shape/triangle_queries.h"

#include <algorithm>

struct SurfaceTriangle {
    TriangleCorners corners; // made in place: a copy would wait for what has just been written
    bool hasNormals = false, hasUvs = false;
    std::array<Vec3, 3> normals{};
    std::array<Vec2, 3> uvs{};

    // Normals and, if needed, coordinates as the lists have them.
    void takeRest(const MeshGeometry& geometry, std::uint32_t triangle, SurfaceNeeds needs = {});
};

// All but the material and the object.
Surface surfaceOf(const SurfaceTriangle& triangle, const Ray& ray, const Hit& hit,
                  SurfaceNeeds needs);

// surfaceOf() of a block of hits by the lanes of a kernel: put() or putAll(), find(), take().
class TriangleSurfaceBatch {
public:
    static constexpr std::size_t kHits = TrianglesMet::kHits;
    TriangleSurfaceBatch(TriangleSurfacesFn fn, SurfaceNeeds needs) : fn_(fn) {
        met_.wantsLift = needs.lift;
    }
    void clear() {
        met_.used = met_.smooth = 0;
        met_.onOne = false;
    }
    void put(std::size_t lane, const SurfaceTriangle& triangle, const Hit& hit, Vec3 dir);
    // All hits, on one triangle.
    void putAll(const SurfaceTriangle& triangle, std::span<const Hit> hits, const RaySpan& rays,
                std::span<const std::uint32_t> which);
    void find() { fn_(met_, found_); }
    // Those have to be asked by themselves.
    unsigned unknown() const { return found_.unknown; }
    // The surfaces that were found, but for what the triangles are made of and belong to.
    void take(std::size_t lane, SurfaceBlock& to, std::size_t place) const;
    void takeAll(SurfaceBlock& to) const;

private:
    void putTriangle(std::size_t lane, const SurfaceTriangle& triangle);

    TriangleSurfacesFn fn_;
    TrianglesMet met_;
    TriangleSurfaces found_;
    SurfaceBlock::Lane uv_[2];
};

// What a triangle is made of and belongs to.
struct TriangleSource {
    std::uint32_t material, object;
};

// The same of all hits of a query. triangleOf(number) is the SurfaceTriangle, sourceOf(number) its
// TriangleSource.
template <class TriangleFn, class SourceFn>
void surfacesOf(const SurfaceQuery& query, TriangleFn&& triangleOf, SourceFn&& sourceOf,
                SurfacePlaces out) {
    TriangleSurfaceBatch batch(query.lanes.triangles, query.needs);
    constexpr std::size_t kHits = TriangleSurfaceBatch::kHits;
    for (std::size_t first = 0; first < query.which.size(); first += kHits) {
        const std::size_t count = min(query.which.size() - first, kHits);
        const auto rays = query.which.subspan(first, count), to = query.to.subspan(first, count);
        const std::uint32_t number = query.hits[rays[0]].prim;
        const bool onOne = std::all_of(rays.begin() + 1, rays.end(), [&](std::uint32_t ray) {
            return query.hits[ray].prim == number;
        });
        batch.clear();
        if (onOne) {
            batch.putAll(triangleOf(number), query.hits, query.rays, rays);
        } else {
            for (std::size_t i = 0; i < count; ++i)
                batch.put(i, triangleOf(query.hits[rays[i]].prim), query.hits[rays[i]],
                          query.rays.dir[rays[i]]);
        }
        batch.find();
        SurfaceBlock* const whole = out.whole(to);
        if (whole != nullptr) batch.takeAll(*whole);
        TriangleSource source{};
        if (onOne && whole != nullptr && batch.unknown() == 0) {
            source = sourceOf(number);
            std::fill_n(whole->material, kHits, source.material);
            std::fill_n(whole->object, kHits, source.object);
            continue;
        }
        for (std::size_t i = 0; i < count; ++i) {
            const Hit& hit = query.hits[rays[i]];
            const SurfacePlaces::Place place = out[to[i]];
            if (i == 0 || !onOne) source = sourceOf(hit.prim);
            if ((batch.unknown() >> i & 1) != 0)
                place.put(surfaceOf(triangleOf(hit.prim), query.rays[rays[i]], hit, query.needs));
            else if (whole == nullptr)
                batch.take(i, place.block, place.lane);
            place.block.material[place.lane] = source.material;
            place.block.object[place.lane] = source.object;
        }
    }
}

SurfaceDerivatives derivativesOf(const SurfaceTriangle& triangle);
