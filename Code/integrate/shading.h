// From a hit to everything that shading needs: the point, the normals on the eye's side, and the
// material with its textures applied.
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

// The rest of a point whose surface is known. `dir` need not be a unit vector. Textures that bend
// normals are asked for the point, unless kMayBend says that the scene has none.
template <bool kMayBend = true>
void shadeSurface(const Scene& scene, const Ray& ray, const Hit& hit, ShadedPoint& at);
inline ShadedPoint shade(const Scene& scene, const Ray& ray, const Hit& hit) {
    ShadedPoint at;
    at.surface = scene.shapes().shapes[hit.shape]->surface(ray, hit);
    shadeSurface(scene, ray, hit, at);
    return at;
}

// The material's numbers at a place on its pictures.
Rgb emissionAt(const SceneMaterial& of, Vec2 uv);
float opacityAt(const SceneMaterial& of, Vec2 uv);

// Part of the light that goes straight through the surface at a hit: (1 - opacity) * filter.
Rgb straightTransmission(const Scene& scene, const Ray& ray, const Hit& hit);

// Where a ray starts that leaves the surface at `point` to the side of `side` (+-ng): far enough
// off, by the error bound of the hit, never to meet the same surface again by rounding.
inline Vec3 leave(const Surface& surface, Vec3 side) { return surface.p + side * surface.error; }

namespace shading {
// surface.ns with the material's bump and normal maps.
Vec3 bentNormal(const Scene& scene, const Ray& ray, const Hit& hit, const Surface& surface);
// side.n, or if that faces away from the eye, as it would reflect light that the eye can't see, one
// that does not.
Vec3 turnedAway(Vec3 toEye, const ShadedPoint::Side& side);
} // namespace shading

template <bool kMayBend>
void shadeSurface(const Scene& scene, const Ray& ray, const Hit& hit, ShadedPoint& at) {
    const Surface& surface = at.surface;
    const SceneMaterial& material = scene.materials()[surface.material];
    at.of = &material;
    at.toEye = -normalize(ray.dir);
    at.front = dot(at.toEye, surface.ng) >= 0;
    Vec3 n = surface.ns;
    if constexpr (kMayBend)
        if (material.bendsNormals()) n = shading::bentNormal(scene, ray, hit, surface);
    const float side = at.front ? 1.0f : -1.0f; // times it is exact
    at.eye = {surface.ng * side, surface.ns * side, n * side};
    if (!(dot(at.eye.n, at.toEye) > 0)) at.eye.n = shading::turnedAway(at.toEye, at.eye);
    at.lit = at.eye;
    if (material.litOutside && !at.front) {
        at.lit = {surface.ng, surface.ns, n};
        at.surface.lift = {}; // it was for the side of the eye
    }
}

// The questions that integrators ask about batches of rays. Kernels live behind them; the answers
// are functions of scene and ray alone.

// hits[i] is the nearest hit of ray i (Hit::isHit() false: none). Resizes hits.
void closest(const Scene& scene, const RayBatch& rays, std::vector<Hit>& hits);

// transmittance[i]: the part of the light that passes along ray i between tMin and tMax. Black
// where an opaque surface is in between, white where nothing is. Resizes transmittance.
void transmitted(const Scene& scene, const RayBatch& rays, std::vector<Rgb>& transmittance);
