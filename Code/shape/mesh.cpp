#include "shape/mesh.h"

#include "accel/kernels/wide_walk.h"
#include "shape/mesh_surface.h"

#include <algorithm>
#include <utility>

Mesh::Mesh(const MeshGeometry& geometry, std::vector<std::uint32_t> materials,
           std::vector<MeshPart> parts)
    : geometry_(geometry), materials_(std::move(materials)), parts_(std::move(parts)) {}

template <class LeafFn>
void Mesh::candidates(const RaySetup& setup, float zCut, LeafFn&& leaf) const {
    const auto visit = [&](std::uint32_t triangle, float& cut) {
        return leaf(triangle, corners(triangle), cut);
    };
    if (!geometry_.wide.isEmpty())
        return traverse(
            geometry_.wide, setup, zCut, [](std::size_t) { return 0.0f; }, visit);
    for (std::uint32_t i = 0; i < geometry_.triangles.size(); ++i)
        if (visit(i, zCut)) return;
}

bool Mesh::intersect(const Ray& ray, Hit& hit) const {
    if (!isTraceable(ray)) return false;
    return nearestTriangle(ray, setupFor(ray), hit,
                           [this](auto&&... a) { candidates(std::forward<decltype(a)>(a)...); });
}

bool Mesh::occludes(const Ray& ray) const {
    if (!isTraceable(ray)) return false;
    return anyTriangle(ray, setupFor(ray),
                       [this](auto&&... a) { candidates(std::forward<decltype(a)>(a)...); });
}

void Mesh::collect(const Ray& ray, std::vector<Hit>& hits) const {
    if (!isTraceable(ray)) return;
    allTriangles(ray, setupFor(ray), hits,
                 [this](auto&&... a) { candidates(std::forward<decltype(a)>(a)...); });
}

void Mesh::intersectBatch(const RaySpan& rays, std::uint32_t number, std::span<Hit> hits) const {
    if (!takesBatches()) return Shape::intersectBatch(rays, number, hits);
    closestHits(*geometry_.isa, geometry_.wideMesh(), rays, number, hits);
}

void Mesh::occludesBatch(const RaySpan& rays, std::span<std::uint8_t> hidden) const {
    if (!takesBatches()) return Shape::occludesBatch(rays, hidden);
    anyHits(*geometry_.isa, geometry_.wideMesh(), rays, hidden);
}

SolidForm Mesh::solidForm() const {
    SolidForm form = Shape::solidForm();
    const std::size_t count = geometry_.triangles.size();
    if (count == 0 || count > Facets::kMost) return form;
    form.facets = Facets{.triangles = {}, .extent = geometry_.extent};
    for (std::uint32_t i = 0; i < count; ++i) form.facets->triangles.push_back(corners(i));
    return form;
}

std::uint32_t Mesh::objectOf(std::uint32_t triangle) const {
    const auto part = std::upper_bound(
        parts_.begin(), parts_.end(), triangle,
        [](std::uint32_t number, const MeshPart& other) { return number < other.firstTriangle; });
    return std::prev(part)->object;
}

bool Mesh::seesFront(const Ray& ray, const Hit& hit) const {
    const TriangleCorners v = corners(hit.prim);
    const Vec3d n = cross(toDouble(v[1]) - toDouble(v[0]), toDouble(v[2]) - toDouble(v[0]));
    const Vec3d dir = toDouble(ray.dir);
    const double facing = dot(n, dir);
    // The sign is asked of the surface's normal, which is rounded.
    const bool isSure = facing * facing > 0x1p-40 * dot(n, n) * dot(dir, dir);
    return isSure ? facing < 0 : Shape::seesFront(ray, hit);
}

SurfaceTriangle Mesh::surfaceTriangle(std::uint32_t triangle, SurfaceNeeds needs) const {
    SurfaceTriangle out{corners(triangle)};
    out.takeRest(geometry_, triangle, needs);
    return out;
}

Surface Mesh::surfaceFor(const Ray& ray, const Hit& hit, SurfaceNeeds needs) const {
    Surface s = surfaceOf(surfaceTriangle(hit.prim, needs), ray, hit, needs);
    s.material = materialOf(hit.prim);
    s.object = objectOf(hit.prim);
    return s;
}

void Mesh::surfaces(const SurfaceQuery& query, SurfacePlaces out) const {
    if (query.lanes.triangles == nullptr) return Shape::surfaces(query, out);
    surfacesOf(
        query, [&](std::uint32_t triangle) { return surfaceTriangle(triangle, query.needs); },
        [&](std::uint32_t triangle) {
            return TriangleSource{materialOf(triangle), objectOf(triangle)};
        },
        out);
}

SurfaceDerivatives Mesh::derivatives(const Ray&, const Hit& hit) const {
    return derivativesOf(surfaceTriangle(hit.prim, {}));
}

std::optional<TieOrder> Mesh::tieOrder(const Ray& ray, const Hit& hit) const {
    return TieOrder{canonicalKey(setupFor(ray), corners(hit.prim)), objectOf(hit.prim)};
}

void Mesh::forEachTriangle(TriangleFn fn) const {
    for (std::uint32_t i = 0; i < geometry_.triangles.size(); ++i) fn(i, corners(i), materialOf(i));
}
