// Laws of reflection and refraction of a smooth boundary.
#pragma once

#include "base/math.h"
#include "base/vec.h"

#include <optional>

// Mirror direction; `toEye` and the result both point away from the surface.
inline Vec3 reflectAbout(Vec3 toEye, Vec3 n) { return n * (2 * dot(n, toEye)) - toEye; }

// Squared cosine on the other side, not above 0 under total internal reflection. 1 - eta^2 sin^2
// without cancellation at grazing angles; eta = 1 gives cosIn^2, so that the ray goes straight on.
inline float cos2Refracted(float cosIn, float eta) {
    return (1 - eta) * (1 + eta) + (eta * cosIn) * (eta * cosIn);
}

// Snell's law: direction on the other side of n, nothing under total internal reflection.
// eta = ior on the side of the eye / ior on the other side; dot(n, toEye) > 0.
inline std::optional<Vec3> refractThrough(Vec3 toEye, Vec3 n, float eta) {
    const float cosIn = dot(n, toEye);
    const float cos2Out = cos2Refracted(cosIn, eta);
    if (!(cos2Out > 0)) return {};
    const float cosOut = std::sqrt(cos2Out);
    return normalize(n * (eta * cosIn - cosOut) - toEye * eta);
}

// Part of unpolarised light that a dielectric boundary reflects, 1 under total internal reflection.
inline float fresnelDielectric(float cosIn, float eta) {
    const float c = clamp(cosIn, 0.0f, 1.0f);
    const float cos2Out = cos2Refracted(c, eta);
    if (!(cos2Out > 0)) return 1;
    const float cosOut = std::sqrt(cos2Out);
    const float parallel = (c - eta * cosOut) / (c + eta * cosOut);
    const float perpendicular = (eta * c - cosOut) / (eta * c + cosOut);
    return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

// Schlick 1994: (1 - cos)^5, how far the reflectance has risen from its value at normal incidence.
inline float schlickWeight(float cosIn) {
    const float m = clamp(1 - cosIn, 0.0f, 1.0f);
    return (m * m) * (m * m) * m;
}
