#include "material/material.h"

#include "base/math.h"
#include "sample/warp.h"

namespace {

constexpr float kInvPiF = static_cast<float>(kInvPi);

// A rough surface reflects about a half vector h instead of n.
Vec3 microNormal(const Material& material, Vec3 n, Vec2 u) {
    if (material.roughness <= 0) return n;
    const Vec3 local = cosinePowerFromSquare(u, lobeExponent(material.roughness));
    return normalize(frameAround(n).toWorld(local));
}

// Under total internal reflection nothing gets through: all the light of both goes back.
Rgb totallyReflected(const Material& material) {
    if (material.fresnel == FresnelModel::None) return material.mirror + material.transmission;
    if (material.fresnel == FresnelModel::Schlick) return {1, 1, 1}; // mirror is its F at 0 degrees
    return isBlack(material.mirror) ? material.transmission : material.mirror;
}

} // namespace

float lobeExponent(float roughness) {
    const float alpha = roughness * roughness;
    return clamp(2 / (alpha * alpha) - 2, 1.0f, 1e5f);
}

Rgb highlight(const Material& material, Vec3 n, Vec3 toEye, Vec3 toLight) {
    const float cosLight = dot(n, toLight);
    if (material.specularModel == SpecularModel::Phong) {
        // R.V with R = 2 N.L N - L, in a form that eye and light enter alike.
        const float cosMirror = min(2 * (cosLight * dot(n, toEye)) - dot(toLight, toEye), 1.0f);
        return cosMirror > 0 ? material.specular * exact::pow(cosMirror, material.exponent) : Rgb{};
    }
    const Vec3 half = toEye + toLight;
    const float length2 = dot(half, half);
    if (!(length2 > 0)) return {};
    const float sumLength = std::sqrt(length2);
    const Vec3 h = half / sumLength;
    const float cosHalf = min(dot(n, h), 1.0f);
    if (!(cosHalf > 0)) return {};
    const float lobe = exact::pow(cosHalf, material.exponent);
    if (material.specularModel == SpecularModel::Blinn) return material.specular * lobe;
    const float cosEye = dot(n, toEye);
    const float norm = (material.exponent + 1) * (kInvPiF / 8);
    // Half the length of V + L is H.V and H.L: the same when eye and light change places.
    const float cosHalfEye = 0.5f * sumLength;
    return material.specular * (norm * lobe * cosLight / (cosHalfEye * max(cosLight, cosEye)));
}

Bounces bounces(const Material& material, Vec3 n, Vec3 ng, Vec3 toEye, float eta, Vec2 u) {
    Bounces out;
    const bool reflects = !isBlack(material.mirror), transmits = !isBlack(material.transmission);
    if (!reflects && !transmits) return out;
    const Vec3 h = microNormal(material, n, u);
    const float cosIn = dot(h, toEye);
    const bool isRough = material.roughness > 0;
    if (isRough && !(cosIn > 0)) return out;

    Rgb reflected = material.mirror, transmitted = material.transmission;
    if (material.fresnel == FresnelModel::Dielectric) {
        const float f = fresnelDielectric(cosIn, eta);
        reflected = reflected * f;
        transmitted = transmitted * (1 - f);
    } else if (material.fresnel == FresnelModel::Schlick) {
        const float rise = schlickWeight(cosIn);
        const Rgb white{1, 1, 1};
        reflected = reflected + (white - reflected) * rise;
        transmitted = transmitted * (1 - rise);
    }

    if (transmits) {
        auto dir = refractThrough(toEye, h, eta);
        // A bent normal may refract to the side of the eye: fall back to the true surface.
        if (dir && !(dot(*dir, ng) < 0) && !isRough) dir = refractThrough(toEye, ng, eta);
        if (dir && dot(*dir, ng) < 0)
            out.refracted = Bounce{*dir, transmitted};
        else if (!dir)
            reflected = totallyReflected(material);
    }
    if (isBlack(reflected)) return out;
    if (!isRough) {
        out.reflected = Bounce{mirrored(toEye, h, ng), reflected};
        return out;
    }
    const Vec3 dir = normalize(reflectAbout(toEye, h));
    const float cosOut = dot(n, dir), cosEye = dot(n, toEye);
    if (!(cosOut > 0 && dot(dir, ng) > 0)) return out;
    // Importance sampling of the Ashikhmin-Shirley lobe leaves N.L / max(N.L, N.V).
    out.reflected = Bounce{dir, cosOut < cosEye ? reflected * (cosOut / cosEye) : reflected};
    return out;
}
