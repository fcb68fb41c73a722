// Meshes and random numbers for the battery (battery.h) and for the tests of triangles, trees and
// scenes.
#pragma once

#include "desc/scene_desc.h"
#include "scene/merge.h"

#include <array>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

namespace meshes {

// The engine gives the same numbers everywhere; the distributions of <random> do not.
class Random {
public:
    explicit Random(std::uint64_t seed) : bits_(seed) {}
    double unit() { return static_cast<double>(bits_() >> 11) * 0x1p-53; } // [0,1)
    double uniform(double lo, double hi) { return lo + (hi - lo) * unit(); }
    double logUniform(double lo, double hi);
    std::uint32_t below(std::size_t count) { return static_cast<std::uint32_t>(bits_() % count); }
    bool chance(double p) { return unit() < p; }
    Vec3d inBox(double half);
    Vec3d direction(); // uniform on the unit sphere
    Vec2 square() { return {static_cast<float>(unit()), static_cast<float>(unit())}; }
    // Turn, scale along the axes by up to `stretch` or 1/stretch (mirrored half of the time), turn,
    // move by up to `shift` along each axis.
    Transform affine(double stretch, double shift);

private:
    std::mt19937_64 bits_;
};

// Closed, with outward faces, about the origin and of size 1 if not said otherwise.
MeshDesc uvSphere(int segments, int rings); // 2 segments (rings - 1) triangles; uvs and normals
MeshDesc icosphere(int level);              // 20 * 4^level triangles
MeshDesc torus(double tubeRadius, int around, int across); // the ring has radius 1
MeshDesc cube();                                           // [-1,1]^3 of 12 triangles
MeshDesc doubleFan(int valence);                           // two tips of that valence at z = +-0.3
// Haines' SPD tetra: 4^depth tetrahedra.
MeshDesc tetra(int depth);

// Adversarial triangles, on which all kernels must agree: needles of 1e3 to 1e7, coplanar stacks,
// duplicates, axis planes, tiny, huge, collinear and points, fans. Coordinates about 1, huge ones
// 100.
std::vector<std::array<Vec3, 3>> soup(Random& random, std::size_t count);
// Whole numbers up to +-half, zeros of both signs: products are exact, so that rays between such
// points meet edges and corners, and planes go through their origins, not almost but truly.
Vec3 latticePoint(Random& random, std::uint32_t half);
Transform quarterTurn(Random& random); // axes change places and directions
std::vector<std::array<Vec3, 3>> latticeSoup(Random& random, std::size_t count, std::uint32_t half);
MeshGeometry geometryOf(const std::vector<std::array<Vec3, 3>>& triangles, bool withBvh);

// A mesh as scene.cpp makes it ready: one that owns its geometry and its Shape. The frame is that
// of the world's box of the mesh; both share the scene's normalised space.
struct Ready {
    std::unique_ptr<MeshGeometry> geometry;
    std::unique_ptr<Shape> shape;
    Transform sceneFromMesh; // for the exact points of an instance
    // Corner c of triangle n of the geometry, where rays meet it.
    Vec3 corner(std::uint32_t n, std::size_t c) const;
};
Ready baked(const MeshDesc& mesh, const Transform& worldFromMesh, const SceneFrame& frame);
Ready instance(const MeshDesc& mesh, const Transform& worldFromMesh, const SceneFrame& frame);
// Frame of a scene with nothing but this mesh.
SceneFrame frameFor(const MeshDesc& mesh, const Transform& worldFromMesh);

// x moved by k floats.
float stepped(float x, int k);

} // namespace meshes
