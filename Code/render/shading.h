// From a hit to everything that shading needs: the point, the normals on the eye's side, and the
// material with its textures applied.
#pragma once

#include "render/scene.h"

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

// `dir` need not be a unit vector. Textures that bend normals are asked whatever `needs` says.
void shade(const Scene& scene, const Ray& ray, const Hit& hit, SurfaceNeeds needs, ShadedPoint& at);
inline ShadedPoint shade(const Scene& scene, const Ray& ray, const Hit& hit) {
    ShadedPoint at;
    shade(scene, ray, hit, {}, at);
    return at;
}

// The material's numbers at the point, textures applied.
Material materialAt(const ShadedPoint& at);

// Part of the light that goes straight through the surface at a hit: (1 - opacity) * filter.
Rgb straightTransmission(const Scene& scene, const Ray& ray, const Hit& hit);

// Where a ray starts that leaves the surface at `point` to the side of `side` (+-ng): far enough
// off, by the error bound of the hit, never to meet the same surface again by rounding.
inline Vec3 leave(const Surface& surface, Vec3 side) { return surface.p + side * surface.error; }
