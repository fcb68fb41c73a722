#include "render/shading.h"

#include "sample/warp.h"

namespace {

// Mikkelsen 2010: the normal of a surface that is raised by a height h(u,v), from the surface
// gradient; dpdu and dpdv in the space of the normal.
Vec3 bumped(Vec3 n, const SurfaceDerivatives& d, Vec2 slope, float height) {
    const Vec3 alongU = cross(d.dpdv, n), alongV = cross(n, d.dpdu);
    const float det = dot(d.dpdu, alongU);
    if (det == 0) return n;
    const Vec3 gradient = (alongU * slope.x + alongV * slope.y) * (height / std::fabs(det));
    const Vec3 bent = n - gradient * (det < 0 ? -1.0f : 1.0f);
    return normalize(bent);
}

// Tangent-space normal map: red along +u, green along +v, blue along the normal.
Vec3 mapped(Vec3 n, const SurfaceDerivatives& d, Rgb texel, float strength) {
    const Vec3 along = d.dpdu - n * dot(n, d.dpdu);
    if (!(dot(along, along) > 0)) return n;
    const Vec3 t = normalize(along);
    const Vec3 side = cross(n, t);
    const Vec3 b = dot(side, d.dpdv) < 0 ? -side : side;
    const Vec3 bent = t * (2 * texel.r - 1) + b * (2 * texel.g - 1) + n * (2 * texel.b - 1);
    const float length2 = dot(bent, bent);
    if (!(length2 > 0)) return n;
    const Vec3 full = bent / std::sqrt(length2);
    const Vec3 mixed = n + (full - n) * strength;
    return dot(mixed, mixed) > 0 ? normalize(mixed) : n;
}

// Textures that change numbers, not normals.
Material textured(const SceneMaterial& material, Vec2 uv) {
    Material m = material.base;
    if (material.diffuse) m.diffuse *= material.diffuse->color(uv);
    if (material.specular) m.specular *= material.specular->color(uv);
    if (material.emission) m.emission *= material.emission->color(uv);
    if (material.opacity) m.opacity *= material.opacity->value(uv);
    return m;
}

} // namespace

ShadedPoint shade(const Scene& scene, const Ray& ray, const Hit& hit) {
    const Shape& shape = *scene.shapes().shapes[hit.shape];
    ShadedPoint at;
    at.surface = shape.surface(ray, hit);
    at.materialId = at.surface.material;
    const SceneMaterial& material = scene.materials()[at.materialId];
    at.material = textured(material, at.surface.uv);
    at.isLamp = material.isLamp;
    at.toEye = -normalize(ray.dir);
    at.front = dot(at.toEye, at.surface.ng) >= 0;
    Vec3 n = at.surface.ns;
    if (material.bendsNormals()) {
        const SurfaceDerivatives d = shape.derivatives(ray, hit);
        const Vec2 uv = at.surface.uv;
        if (material.normalMap)
            n = mapped(n, d, material.normalMap->color(uv), material.normalStrength);
        if (material.bumpMap) n = bumped(n, d, material.bumpMap->gradient(uv), material.bumpHeight);
        if (!(dot(n, at.surface.ng) > 0)) n = at.surface.ns;
    }
    at.ng = at.front ? at.surface.ng : -at.surface.ng;
    at.ns = at.front ? at.surface.ns : -at.surface.ns;
    at.n = at.front ? n : -n;
    // A normal that faces away from the eye would reflect light that the eye can't see.
    if (!(dot(at.n, at.toEye) > 0)) {
        const Vec3 level = at.n - at.toEye * (dot(at.n, at.toEye) * 1.001f);
        at.n = dot(level, level) > 1e-12f && dot(level, at.ng) > 0 ? normalize(level) : at.ng;
        if (!(dot(at.n, at.toEye) > 0)) at.n = at.ng;
    }
    return at;
}

Rgb straightTransmission(const Scene& scene, const Ray& ray, const Hit& hit) {
    const Surface surface = scene.shapes().shapes[hit.shape]->surface(ray, hit);
    const SceneMaterial& material = scene.materials()[surface.material];
    float opacity = material.base.opacity;
    if (material.opacity) opacity *= material.opacity->value(surface.uv);
    return material.base.filter * (1 - opacity);
}

Vec3 leave(const Surface& surface, Vec3 side, float reach) {
    const float error = surface.error + 0x1p-20f * reach;
    return surface.p + side * error;
}
