#include "integrate/shading.h"

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

// Returns the unit normal that a texel of a tangent-space normal map means: red along +u, green
// along +v, blue along the normal n; n itself where that has no direction.
Vec3 carved(Vec3 n, const SurfaceDerivatives& d, Rgb texel) {
    const Vec3 along = d.dpdu - n * dot(n, d.dpdu);
    if (!(dot(along, along) > 0)) return n;
    const Vec3 t = normalize(along);
    const Vec3 side = cross(n, t);
    const Vec3 b = dot(side, d.dpdv) < 0 ? -side : side;
    const Vec3 bent = t * (2 * texel.r - 1) + b * (2 * texel.g - 1) + n * (2 * texel.b - 1);
    const float length2 = dot(bent, bent);
    return length2 > 0 ? bent / std::sqrt(length2) : n;
}

// Returns the normal of a surface that was carved before `worldFromObject` stretched it, as Cycles
// does it: the frame of the texel is square in the object's space, and its normal becomes one of
// the world.
Vec3 carvedUnder(const Transform& worldFromObject, Vec3 n, const SurfaceDerivatives& d, Rgb texel) {
    const Transform back = worldFromObject.inverse();
    const Vec3d flat = back.normal(toDouble(n));
    if (!(dot(flat, flat) > 0)) return n;
    const SurfaceDerivatives inObject{toFloat(back.vector(toDouble(d.dpdu))),
                                      toFloat(back.vector(toDouble(d.dpdv)))};
    const Vec3 bent = carved(toFloat(normalize(flat)), inObject, texel);
    return toFloat(normalize(worldFromObject.normal(toDouble(bent))));
}

Vec3 mapped(Vec3 n, Vec3 full, float strength) {
    const Vec3 mixed = n + (full - n) * strength;
    return dot(mixed, mixed) > 0 ? normalize(mixed) : n;
}

} // namespace

Vec3 shading::turnedAway(Vec3 toEye, const ShadedPoint::Side& side) {
    const Vec3 level = side.n - toEye * (dot(side.n, toEye) * 1.001f);
    const Vec3 n =
        dot(level, level) > 1e-12f && dot(level, side.ng) > 0 ? normalize(level) : side.ng;
    return dot(n, toEye) > 0 ? n : side.ng;
}

Vec3 shading::bentNormal(const Scene& scene, const Ray& ray, const Hit& hit,
                         const Surface& surface) {
    const Shape& shape = *scene.shapes().shapes[hit.shape];
    const MaterialPictures& pictures = *scene.materials()[surface.material].pictures;
    const SurfaceDerivatives d = shape.derivatives(ray, hit);
    Vec3 n = surface.ns;
    if (pictures.normalMap) {
        const Rgb texel = pictures.normalMap->color(surface.uv);
        const MovingTransform* const place = scene.unevenPlace(surface.object);
        const Vec3 full = place ? carvedUnder(place->at(static_cast<double>(ray.time)), n, d, texel)
                                : carved(n, d, texel);
        n = mapped(n, full, pictures.normalStrength);
    }
    if (pictures.bumpMap)
        n = bumped(n, d, pictures.bumpMap->gradient(surface.uv), pictures.bumpHeight);
    return dot(n, surface.ng) > 0 ? n : surface.ns;
}

Rgb emissionAt(const SceneMaterial& of, Vec2 uv, const UvFootprint& footprint) {
    const Texture* const picture = of.pictures->emission;
    if (picture == nullptr) return of.emission;
    const Rgb color = of.emission * picture->color(uv, footprint);
    return {max(color.r, 0.0f), max(color.g, 0.0f), max(color.b, 0.0f)};
}

float opacityAt(const SceneMaterial& of, Vec2 uv, const UvFootprint& footprint) {
    const Texture* const picture = of.pictures->opacity;
    if (picture == nullptr) return of.opacity;
    return clamp(of.opacity * picture->valueOf(picture->color(uv, footprint)), 0.0f, 1.0f);
}

Rgb straightTransmission(const Scene& scene, const Ray& ray, const Hit& hit) {
    const Surface surface = scene.shapes().shapes[hit.shape]->surface(ray, hit);
    const SceneMaterial& of = scene.materials()[surface.material];
    return of.filter * (1 - opacityAt(of, surface.uv));
}

void closest(const Scene& scene, const RayBatch& rays, std::vector<Hit>& hits) {
    scene.shapes().closest(rays.span(), hits);
}

void transmitted(const Scene& scene, const RayBatch& rays, std::vector<Rgb>& transmittance) {
    transmittance.resize(rays.size());
    std::vector<std::uint8_t> hidden;
    scene.shapes().occluded(rays.span(), hidden);
    std::vector<Hit> hits;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Rgb passed{1, 1, 1};
        if (hidden[i] != 0)
            passed = {};
        else if (scene.hasSeeThrough()) {
            const Ray ray = rays.ray(i);
            hits.clear();
            scene.shapes().seeThroughHits(ray, hits);
            for (const Hit& hit : hits) passed *= straightTransmission(scene, ray, hit);
        }
        transmittance[i] = passed;
    }
}
