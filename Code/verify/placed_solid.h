// Closed meshes put into a scene: the subjects of the battery's rows about leaks and about rays
// that leave a surface.
#pragma once

#include "scene/shape_set.h"
#include "verify/meshes.h"

#include <string>

namespace battery {

// In mesh space. Not one of them is moved, so what lies inside is known without asking a ray.
struct Solid {
    const char* name;
    MeshDesc mesh;
    bool isConvex;
    double tube; // radius of the tube of a torus, 0 for the others
};
const std::vector<Solid>& solids();

// A point well inside: rounded to float, in any of the places below, it is still there.
Vec3d inside(meshes::Random& random, const Solid& solid);

// A solid alone in a ShapeSet, in the normalised space of a scene.
struct PlacedSolid {
    const Solid& solid;
    std::string name; // "torus, mirrored, as an instance"
    Transform sceneFromSolid;
    meshes::Ready ready;
    ShapeSet set;

    // `solid` must outlive it, `mesh` is the solid's, moved by meshFromSolid.
    PlacedSolid(const Solid& from, const MeshDesc& mesh, const Transform& meshFromSolid,
                const Transform& worldFromMesh, const SceneFrame& frame, bool asInstance,
                const char* place);

    const Shape& shape() const { return *set.shapes[0]; }
    // Corner c of triangle n in the scene's space.
    Vec3d corner(std::uint32_t n, std::size_t c) const;
    std::uint32_t someTriangle(meshes::Random& random) const;
    Vec3d onTriangle(meshes::Random& random, std::uint32_t n) const;
    // Is a point in a convex solid, behind every triangle as rays meet it? By the exact signs but
    // for 2^-50 of the products.
    bool contains(Vec3 p) const;
};

// As it is, turned and stretched, mirrored, or small in a large scene; baked or as an instance.
PlacedSolid placedNear(meshes::Random& random, const Solid& solid);
// Where floats are coarse: at (148376, 1234, -223423) or at 1e6 along each axis, moved by the
// transform of the object or with every point written there; baked or as an instance.
PlacedSolid placedFar(meshes::Random& random, const Solid& solid);

// The ray to the last bit, for a report.
std::string shown(const Ray& ray);

} // namespace battery
