#include "verify/placed_solid.h"

#include "base/text.h"

#include <cstdio>
#include <utility>

namespace battery {

namespace {

using meshes::Random;

// Each triangle is split at a point 1e-5 of its height beside the middle of its first edge: one of
// the three is a sliver of 1:1e5.
MeshDesc slivered(const MeshDesc& from) {
    MeshDesc mesh;
    mesh.points = from.points;
    for (const auto& [a, b, c] : from.triangles) {
        const auto n = static_cast<std::uint32_t>(mesh.points.size());
        const Vec3d middle = (from.points[a] + from.points[b]) * 0.5;
        mesh.points.push_back(lerp(middle, from.points[c], 1e-5));
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, n}, {b, c, n}, {c, a, n}});
    }
    return mesh;
}

// Hills and valleys on a ball, in place of a scan: seen from the centre it hides nothing of itself.
MeshDesc boulder() {
    MeshDesc mesh = meshes::icosphere(4);
    Random random(7);
    for (Vec3d& p : mesh.points) p = p * random.uniform(0.6, 1);
    return mesh;
}

// The same outside, also where the map mirrors.
MeshDesc moved(const MeshDesc& from, const Transform& map) {
    MeshDesc mesh = from;
    for (Vec3d& p : mesh.points) p = map.point(p);
    for (auto& n : mesh.normals) n = toFloat(normalize(map.normal(toDouble(n))));
    if (map.mirrors())
        for (MeshDesc::Corners& c : mesh.triangles) std::swap(c[1], c[2]);
    return mesh;
}

} // namespace

const std::vector<Solid>& solids() {
    static const std::vector<Solid> all = {
        {"sphere of 39600", meshes::uvSphere(200, 100), true, 0},
        {"icosphere", meshes::icosphere(4), true, 0},
        {"slivers", slivered(meshes::icosphere(3)), false, 0},
        {"boulder", boulder(), false, 0},
        {"cube", meshes::cube(), true, 0},
        {"fan", meshes::doubleFan(256), true, 0},
        {"torus", meshes::torus(0.3, 96, 48), false, 0.3},
        {"thin torus", meshes::torus(0.005, 64, 8), false, 0.005},
    };
    return all;
}

Vec3d inside(Random& random, const Solid& solid) {
    if (solid.tube == 0) return random.inBox(0.1);
    const double a = random.uniform(0, kTwoPi);
    // The polygon of the ring lies up to 1 - cos(pi/64) = 0.0012 inside the circle.
    return Vec3d{exact::cos(a), exact::sin(a), 0} * 0.9994 + random.inBox(solid.tube * 0.2);
}

PlacedSolid::PlacedSolid(const Solid& from, const MeshDesc& mesh, const Transform& meshFromSolid,
                         const Transform& worldFromMesh, const SceneFrame& frame, bool asInstance,
                         const char* place)
    : solid(from), name(cat(from.name, ", ", place, asInstance ? ", as an instance" : ", baked")),
      sceneFromSolid(frame.placed((worldFromMesh * meshFromSolid).rows())),
      ready(asInstance ? meshes::instance(mesh, worldFromMesh, frame)
                       : meshes::baked(mesh, worldFromMesh, frame)) {
    set.add(std::move(ready.shape), ShapeSet::Shadow::Opaque);
    set.finish(true);
}

Vec3d PlacedSolid::corner(std::uint32_t n, std::size_t c) const {
    return toDouble(ready.corner(n, c));
}

std::uint32_t PlacedSolid::someTriangle(Random& random) const {
    return random.below(ready.geometry->triangles.size());
}

Vec3d PlacedSolid::onTriangle(Random& random, std::uint32_t n) const {
    const double u = 1 - std::sqrt(random.unit()), v = random.unit() * (1 - u);
    return corner(n, 0) * (1 - u - v) + corner(n, 1) * u + corner(n, 2) * v;
}

bool PlacedSolid::contains(Vec3 p) const {
    const double turned = ready.sceneFromMesh.mirrors() ? -1 : 1; // an instance keeps the order
    for (std::uint32_t n = 0; n < ready.geometry->triangles.size(); ++n) {
        const Vec3d v = corner(n, 0);
        const Vec3d normal = cross(corner(n, 1) - v, corner(n, 2) - v) * turned;
        if (dot(normal, toDouble(p) - v) > 0) return false;
    }
    return true;
}

PlacedSolid placedNear(Random& random, const Solid& solid) {
    const bool asInstance = random.chance(0.5);
    const auto alone = [&](const Transform& map, const char* place) {
        return PlacedSolid(solid, solid.mesh, {}, map, meshes::frameFor(solid.mesh, map),
                           asInstance, place);
    };
    switch (random.below(4)) {
    case 0: return alone({}, "plain");
    case 1: return alone(random.affine(8, 1), "turned and stretched");
    case 2: {
        const Transform map = random.affine(2, 1);
        return alone(map.mirrors() ? map : map * Transform::scale({-1, 1, 1}), "mirrored");
    }
    default: {
        const Transform place = Transform::translate(random.inBox(0.7));
        const SceneFrame large; // of extent [1,2)
        return {solid,
                solid.mesh,
                {},
                place * random.affine(2, 0) * Transform::scale(0.01),
                large,
                asInstance,
                "small in a large scene"};
    }
    }
}

PlacedSolid placedFar(Random& random, const Solid& solid) {
    const bool asInstance = random.chance(0.5), isAtMillion = random.chance(0.5);
    const Transform there =
        Transform::translate(isAtMillion ? Vec3d{1e6, 1e6, 1e6} : Vec3d{148376, 1234, -223423});
    const Transform map =
        there * random.affine(2, 0) * Transform::scale(random.chance(0.5) ? 1 : 7);
    const char* place = isAtMillion ? "at 1e6" : "at (148376,1234,-223423)";
    if (random.chance(0.5))
        return {solid, solid.mesh, {}, map, meshes::frameFor(solid.mesh, map), asInstance, place};
    const MeshDesc mesh = moved(solid.mesh, map);
    return {solid, mesh, map, {}, meshes::frameFor(mesh, {}), asInstance, place};
}

std::string shown(const Ray& ray) {
    char text[200];
    const auto d = [](float x) { return static_cast<double>(x); };
    static_cast<void>(std::snprintf(text, sizeof text, "from %a %a %a along %a %a %a", d(ray.org.x),
                                    d(ray.org.y), d(ray.org.z), d(ray.dir.x), d(ray.dir.y),
                                    d(ray.dir.z)));
    return text;
}

} // namespace battery
