// Batches of rays that are hard on kernels, at the triangles of a mesh: loose ones, and from few
// points as the rays of cameras and lamps are.
#pragma once

#include "base/ray.h"
#include "verify/meshes.h"

#include <array>
#include <bit>

namespace battery {

struct RayList {
    std::vector<Vec3> org, dir;
    std::vector<float> tMin, tMax, time;

    void push(const Ray& ray);
    std::size_t size() const { return org.size(); }
    RaySpan span() const { return {org, dir, tMin, tMax, time}; }
};

// Also of u and v, and of zeros.
inline bool haveSameBits(const Hit& a, const Hit& b) {
    using Words = std::array<std::uint32_t, sizeof(Hit) / 4>;
    return std::bit_cast<Words>(a) == std::bit_cast<Words>(b);
}

// At a corner, on an edge, inside, or close beside one of them.
Vec3d targetOn(meshes::Random& random, const MeshGeometry& mesh);

// From outside, inside, surfaces, close beside them, far away, and the lines of edges, along which
// triangles are seen from their edge; at targets, along axes, with ends and late starts.
RayList looseRays(meshes::Random& random, const MeshGeometry& mesh, std::size_t count);
// Narrow pencils as of a camera's tiles, and rays from one point to all over the place.
RayList raysFromPoints(meshes::Random& random, const MeshGeometry& mesh, std::size_t count);
// Side by side, as the samples of a pixel send them to a lamp or through a lens: packets that start
// close together and go nearly the same way, with strangers among some of them.
RayList raysInBeams(meshes::Random& random, const MeshGeometry& mesh, std::size_t count);
// Within the planes of triangles, up to 1e-6: where along them a ray hits is rounding, and the
// clamps of the canonical key decide.
RayList raysInPlanes(meshes::Random& random, const MeshGeometry& mesh, std::size_t count);
// The same side by side, from points of the triangles or near them, with ends on them: what such
// rays hit need not be where their lines come closest to it.
RayList beamsInPlanes(meshes::Random& random, const MeshGeometry& mesh, std::size_t count);
// Between points of the lattice of meshes::latticePoint(), some from one point, with ends and
// starts on it.
RayList raysOnLattice(meshes::Random& random, std::uint32_t half, std::size_t count);

} // namespace battery
