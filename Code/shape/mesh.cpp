#include "shape/mesh.h"

#include "accel/kernels/wide_walk.h"
#include "shape/mesh_surface.h"

#include <algorithm>
#include <utility>

Mesh::Mesh(const MeshGeometry& geometry, std::vector<std::uint32_t> materials,
           std::vector<MeshPart> parts)
    : geometry_(geometry), materials_(std::move(materials)), parts_(std::move(parts)) {}

// Corners come from the leaves: where a tree is in vain, and rays try nearly all triangles, it takes
// 3 to 4 times as long as the plain list does (T24d); with corners from the mesh's lists, 9 times.
template <class LeafFn>
void Mesh::candidates(const RaySetup& setup, float zCut, LeafFn&& leaf) const {
    const WideTree& tree = geometry_.wide;
    const auto walk = [&]<int W>(std::integral_constant<int, W>) {
        wide_walk::walk<W>(
            tree.root, setup, zCut,
            [&](WideRef ref) -> const WideNode<W>& { return tree.at<WideNode<W>>(ref); },
            [](WideRef) { return 0.0f; },
            [&](WideRef ref, float& cut) {
                const auto& l = tree.at<WideLeaf<W>>(ref);
                const auto corner = [&](std::size_t c, std::uint32_t i) -> Vec3 {
                    const std::size_t at = l.corner[c][i];
                    return {l.point[0][at], l.point[1][at], l.point[2][at]};
                };
                for (std::uint32_t i = 0; i < l.count; ++i) {
                    const TriangleCorners v{corner(0, i), corner(1, i), corner(2, i)};
                    if (leaf(tree.triangleIds[l.first + i], v, cut)) return true;
                }
                return false;
            });
    };
    if (tree.width == 16) return walk(std::integral_constant<int, 16>());
    if (tree.width == 8) return walk(std::integral_constant<int, 8>());
    for (std::uint32_t i = 0; i < geometry_.triangles.size(); ++i)
        if (leaf(i, corners(i), zCut)) return;
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
