#include "shape/mesh_instance.h"

#include <utility>

MeshInstance::MeshInstance(const MeshGeometry& geometry, MovingTransform sceneFromObject,
                           std::vector<std::uint32_t> materials, std::uint32_t object)
    : geometry_(geometry), motion_(std::move(sceneFromObject)), atFirstKey_(placeOfKey(0)),
      materials_(std::move(materials)), object_(object) {
    for (std::size_t key = 1; key < motion_.keys().size(); ++key)
        atLaterKeys_.push_back(placeOfKey(key));
    if (geometry.triangles.empty()) return;
    if (motion_.isStatic())
        for (const Vec3d p : geometry.exactPoints)
            bounds_.extend(placedPoint(atFirstKey_.sceneFromObject, p));
    else
        bounds_ = outward(motion_.bounds(geometry.exactBox));
    extent_ = max(max(maxAbs(bounds_.lo), maxAbs(bounds_.hi)), extent_);
}

MeshInstance::Place MeshInstance::placeOfKey(std::size_t key) const {
    const auto keys = motion_.keys();
    const Vec3d toNext =
        key + 1 < keys.size() ? keys[key + 1].translation() - keys[key].translation() : Vec3d{};
    return Place(geometry_, keys[key], toNext);
}

MeshInstance::Place MeshInstance::Place::moved(Vec3d offset) const {
    Place out = *this;
    for (std::size_t i = 0; i < 3; ++i) out.sceneFromObject[4 * i + 3] += offset[i];
    out.filter = filter.moved(offset);
    return out;
}

TriangleCorners MeshInstance::corners(const Transform& sceneFromObject,
                                      std::uint32_t triangle) const {
    const auto& c = geometry_.triangles[triangle];
    const auto& points = geometry_.exactPoints;
    return placedCorners(sceneFromObject.rows(), sceneFromObject.mirrors(), points[c[0]],
                         points[c[1]], points[c[2]]);
}

MeshInstance::Visit::Visit(const MeshInstance& instance, const Ray& ray, KnownSetup inScene)
    : instance_(instance), place_(&instance.atFirstKey_), setup_(inScene.setup) {
    if (setup_ == nullptr || inScene.extent != instance.extent_)
        setup_ = &ownSetup_.emplace(instance.setupFor(ray));
    if (!instance.motion_.isStatic()) {
        const auto shift = instance.motion_.shiftAt(static_cast<double>(ray.time));
        place_ = shift ? &moved_.emplace(instance.atKey(shift->key).moved(shift->offset))
                       : &moved_.emplace(instance.geometry_, instance.placeAt(ray.time));
    }
    if (instance.geometry_.hasTree()) treeRay_ = place_->filter.treeRay(ray, instance.extent_);
}

template <class LeafFn> void MeshInstance::Visit::candidates(float zCut, LeafFn&& leaf) const {
    const MeshGeometry& geometry = instance_.geometry_;
    const auto test = [&](std::uint32_t triangle) {
        const auto& c = geometry.triangles[triangle];
        const auto& points = geometry.exactPoints;
        return leaf(triangle, placed(points[c[0]], points[c[1]], points[c[2]]), zCut);
    };
    if (!treeRay_) {
        for (std::uint32_t i = 0; i < geometry.triangles.size(); ++i)
            if (test(i)) return;
        return;
    }
    const auto& points = geometry.points;
    treeRay_->traverse(geometry, treeCut(zCut), [&](std::uint32_t triangle, float& cut) {
        const auto& c = geometry.triangles[triangle];
        if (!treeRay_->mayMeet(points[c[0]], points[c[1]], points[c[2]])) return false;
        const bool stop = test(triangle);
        cut = min(treeCut(zCut), cut);
        return stop;
    });
}

// query(candidates), as triangle_queries.h wants them, at the time of the ray.
template <class Query> bool MeshInstance::ask(const Ray& ray, Query&& query) const {
    if (!isTraceable(ray)) return false;
    const Visit visit(*this, ray);
    return query([&](const RaySetup&, float zCut, auto&& leaf) { visit.candidates(zCut, leaf); });
}

bool MeshInstance::intersect(const Ray& ray, Hit& hit) const {
    return ask(ray, [&](auto&& found) { return nearestTriangle(ray, setupFor(ray), hit, found); });
}

bool MeshInstance::occludes(const Ray& ray) const {
    return ask(ray, [&](auto&& found) { return anyTriangle(ray, setupFor(ray), found); });
}

void MeshInstance::collect(const Ray& ray, std::vector<Hit>& hits) const {
    ask(ray, [&](auto&& found) {
        allTriangles(ray, setupFor(ray), hits, found);
        return true;
    });
}

SurfaceTriangle MeshInstance::surfaceTriangle(const Transform& sceneFromObject,
                                              std::uint32_t triangle) const {
    SurfaceTriangle out{corners(sceneFromObject, triangle)};
    out.takeRest(geometry_, triangle);
    if (out.hasNormals)
        for (Vec3& n : out.normals) n = placedNormal(sceneFromObject, n);
    if (sceneFromObject.mirrors()) {
        std::swap(out.normals[1], out.normals[2]);
        std::swap(out.uvs[1], out.uvs[2]);
    }
    return out;
}

Surface MeshInstance::surfaceFor(const Ray& ray, const Hit& hit, SurfaceNeeds needs) const {
    Surface s = surfaceOf(surfaceTriangle(placeAt(ray.time), hit.prim), ray, hit, needs);
    s.material = materialOf(hit.prim);
    s.object = object_;
    return s;
}

void MeshInstance::surfaces(const SurfaceQuery& query, SurfacePlaces out) const {
    if (query.lanes.triangles == nullptr || !motion_.isStatic()) return Shape::surfaces(query, out);
    const Transform place = placeAt(0);
    surfacesOf(
        query, [&](std::uint32_t triangle) { return surfaceTriangle(place, triangle); },
        [&](std::uint32_t triangle) {
            return TriangleSource{materialOf(triangle), object_};
        },
        out);
}

SurfaceDerivatives MeshInstance::derivatives(const Ray& ray, const Hit& hit) const {
    SurfaceDerivatives d = derivativesOf(surfaceTriangle(placeAt(ray.time), hit.prim));
    d.isEven = motion_.isStatic();
    return d;
}

std::optional<TieOrder> MeshInstance::tieOrder(const Ray& ray, const Hit& hit) const {
    return TieOrder{canonicalKey(setupFor(ray), corners(placeAt(ray.time), hit.prim)), object_};
}

void MeshInstance::forEachTriangle(TriangleFn fn) const {
    if (!motion_.isStatic()) return;
    const Transform place = placeAt(0);
    for (std::uint32_t i = 0; i < geometry_.triangles.size(); ++i)
        fn(i, corners(place, i), materialOf(i));
}
