// What shading needs of one point: the normals on the eye's side, bent by pictures, and the
// material's numbers there.
#pragma once

#include "integrate/batch.h"
#include "scene/scene.h"

#include <vector>

struct ShadedPoint {
    Surface surface;
    const SceneMaterial* of = nullptr; // surface.material
    bool front = true;                 // the ray came from the outside
    Vec3 toEye;                        // unit
    // Geometric, interpolated and bumped normal.
    struct Side {
        Vec3 ng, ns, n;
    };
    Side eye; // on the side of the eye
    Side lit; // on the side whose lamps count
};

// The material's numbers around a place on its pictures.
Rgb emissionAt(const SceneMaterial& of, Vec2 uv, const UvFootprint& footprint = {});
float opacityAt(const SceneMaterial& of, Vec2 uv, const UvFootprint& footprint = {});

// Part of the light that goes straight through the surface at a hit: (1 - opacity) * filter.
Rgb straightTransmission(const Scene& scene, const Ray& ray, const Hit& hit);

// Where a ray starts that leaves the surface at `point` to the side of `side` (+-ng): far enough
// off, by the error bound of the hit, never to meet the same surface again by rounding.
inline Vec3 leave(const Surface& surface, Vec3 side) { return surface.p + side * surface.error; }

namespace shading {
// Returns surface.ns bent by the material's bump and normal maps, on the outside.
Vec3 bentNormal(const Scene& scene, const Ray& ray, const Hit& hit, const Surface& surface);
// Returns a normal that faces the eye, near side.n, which doesn't: that would reflect light that
// the eye can't see.
Vec3 turnedAway(Vec3 toEye, const ShadedPoint::Side& side);
} // namespace shading

// The questions that integrators ask about batches of rays. Kernels live behind them; the answers
// are functions of scene and ray alone.

// hits[i] is the nearest hit of ray i (Hit::isHit() false: none). Resizes hits.
void closest(const Scene& scene, const RayBatch& rays, std::vector<Hit>& hits);

// transmittance[i]: the part of the light that passes along ray i between tMin and tMax. Black
// where an opaque surface is in between, white where nothing is. Resizes transmittance.
void transmitted(const Scene& scene, const RayBatch& rays, std::vector<Rgb>& transmittance);
