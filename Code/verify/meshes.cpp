#include "verify/meshes.h"

#include "base/math.h"
#include "desc/validate.h"
#include "shape/mesh_instance.h"

#include <utility>

namespace meshes {

double Random::logUniform(double lo, double hi) {
    return lo * exact::exp(unit() * exact::log(hi / lo));
}

Vec3d Random::inBox(double half) {
    const double x = uniform(-half, half), y = uniform(-half, half);
    return {x, y, uniform(-half, half)};
}

Vec3d Random::direction() {
    for (;;) {
        const Vec3d v = inBox(1);
        const double l = length(v);
        if (l > 0.01 && l <= 1) return v / l;
    }
}

Transform Random::affine(double stretch, double shift) {
    Vec3d factors;
    for (std::size_t i = 0; i < 3; ++i)
        factors[i] = logUniform(1 / stretch, stretch) * (chance(0.5) ? 1 : -1);
    const Vec3d axis1 = direction(), axis2 = direction();
    const double turn1 = uniform(0, kTwoPi), turn2 = uniform(0, kTwoPi);
    const Vec3d offset = shift > 0 ? inBox(shift) : Vec3d{};
    return Transform::translate(offset) * Transform::rotate(axis1, turn1) *
           Transform::scale(factors) * Transform::rotate(axis2, turn2);
}

MeshGeometry geometryOf(const std::vector<std::array<Vec3, 3>>& triangles, bool withBvh) {
    MeshGeometry g;
    for (const auto& t : triangles) {
        const auto n = static_cast<std::uint32_t>(g.points.size());
        g.points.insert(g.points.end(), t.begin(), t.end());
        g.triangles.push_back({n, n + 1, n + 2});
    }
    g.finish(withBvh);
    return g;
}

SceneFrame frameFor(const MeshDesc& mesh, const Transform& worldFromMesh) {
    SceneDesc desc;
    desc.meshes.push_back(mesh);
    ObjectDesc object;
    object.kind = ObjectDesc::Kind::Mesh;
    object.mesh = 0;
    object.worldFromObject = {worldFromMesh.rows()};
    desc.objects.push_back(object);
    return frameAround(boundsOf(desc));
}

Vec3 Ready::corner(std::uint32_t n, std::size_t c) const {
    const std::uint32_t i = geometry->triangles[n][c];
    return geometry->exactPoints.empty() ? geometry->points[i]
                                         : placedPoint(sceneFromMesh, geometry->exactPoints[i]);
}

Ready baked(const MeshDesc& mesh, const Transform& worldFromMesh, const SceneFrame& frame) {
    MergedMesh merged;
    merged.add(mesh, frame.placed(worldFromMesh.rows()), {7}, 5);
    Ready out;
    out.geometry = std::make_unique<MeshGeometry>(std::move(merged.geometry));
    out.geometry->finish(true);
    out.shape = std::make_unique<Mesh>(*out.geometry, merged.materials, merged.parts);
    return out;
}

Ready instance(const MeshDesc& mesh, const Transform& worldFromMesh, const SceneFrame& frame) {
    Ready out;
    out.geometry = std::make_unique<MeshGeometry>(toSharedGeometry(mesh));
    out.geometry->dropDegenerate();
    out.geometry->finish(true);
    out.sceneFromMesh = frame.placed(worldFromMesh.rows());
    out.shape = std::make_unique<MeshInstance>(*out.geometry, MovingTransform(out.sceneFromMesh),
                                               std::vector<std::uint32_t>{7}, 5);
    return out;
}

float stepped(float x, int k) {
    for (; k > 0; --k) x = nextUp(x);
    for (; k < 0; ++k) x = nextDown(x);
    return x;
}

} // namespace meshes
