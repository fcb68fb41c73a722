// Material: how a surface answers light, as numbers at one point of it; textures are applied
// already. Materials turn directions and light into light and directions; they never trace rays.
#pragma once

#include "base/math.h"
#include "base/vec.h"
#include "material/fresnel.h"

#include <optional>

enum class SpecularModel { Blinn, Ashikhmin, Phong };
enum class FresnelModel { None, Dielectric, Schlick };

struct Material {
    Rgb diffuse{0.8f, 0.8f, 0.8f}; // reflectance
    Rgb specular;
    SpecularModel specularModel = SpecularModel::Blinn;
    float exponent = 50;
    Rgb mirror, transmission;
    float ior = 1.5f;
    FresnelModel fresnel = FresnelModel::None;
    float roughness = 0; // of mirror and transmission, Blender's scale
    Rgb emission;        // radiance
    float opacity = 1;
    Rgb filter{1, 1, 1}; // of the light that goes straight through where opacity is below 1
};

// Radiance towards `toEye` per unit of irradiance on a surface facing the light that comes from
// `toLight`: f * cos. All unit vectors; n on the side of the eye. 0 when the light is behind n.
// Blinn: diffuse/pi * N.L + specular * (N.H)^n (the classic form has no cosine in its highlight).
// Phong: the same with R.V for N.H, where R is the mirrored direction to the light.
// Ashikhmin: specular * (n+1)/(8 pi) (N.H)^n / ((H.V) max(N.L, N.V)) * N.L, Cycles' lobe.
inline Rgb reflectedLight(const Material& material, Vec3 n, Vec3 toEye, Vec3 toLight);
// The specular part of it, where N.L > 0.
Rgb highlight(const Material& material, Vec3 n, Vec3 toEye, Vec3 toLight);

// A traced continuation of the light path: the radiance that comes back is multiplied by weight.
struct Bounce {
    Vec3 dir; // unit
    Rgb weight;
};

// Is all that leaves a point of it one ray that does not depend on what is behind the surface?
inline bool isPlainMirror(const Material& material) {
    return isBlack(material.transmission) && material.roughness <= 0 &&
           material.fresnel == FresnelModel::None;
}

// The mirrored direction about h, or, where that leads below the surface, about ng. All on the side
// of the eye.
inline Vec3 mirrored(Vec3 toEye, Vec3 h, Vec3 ng) {
    const Vec3 dir = normalize(reflectAbout(toEye, h));
    return dot(dir, ng) > 0 ? dir : normalize(reflectAbout(toEye, ng));
}

// Exponent n of the Blinn lobe (n+1)/(2 pi) cos^n of half vectors that has Blender's roughness: n =
// 2/r^4 - 2, kept in 1..1e5. Roughness above 0.
float lobeExponent(float roughness);

// The rays that leave a point of a mirroring or transmitting surface. `n` is the shading normal and
// `ng` the geometric one, both on the side of the eye; `eta` is the ior on the eye's side over the
// ior on the other side; `u` spreads the directions when the surface is rough. Total internal
// reflection sends all the light into the reflection. What a rough surface draws below its horizon,
// or about half vectors that are turned away from the eye, is lost: the lobe has no light there.
struct Bounces {
    std::optional<Bounce> reflected, refracted;
};
Bounces bounces(const Material& material, Vec3 n, Vec3 ng, Vec3 toEye, float eta, Vec2 u);

inline Rgb reflectedLight(const Material& material, Vec3 n, Vec3 toEye, Vec3 toLight) {
    const float cosLight = dot(n, toLight);
    if (!(cosLight > 0)) return {};
    const Rgb diffuse = material.diffuse * (static_cast<float>(kInvPi) * cosLight);
    return isBlack(material.specular) ? diffuse : diffuse + highlight(material, n, toEye, toLight);
}
