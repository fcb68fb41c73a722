// Laws of boundaries, in lanes: where light goes at a facet of a surface, and how much of it. All
// directions point away from the facet. `eta` is the index of refraction on the side of the eye
// over that on the other side.
#pragma once

#include "material/lobe.h"

LANES_BEGIN

// Returns the direction mirrored about h; cosIn is its cosine to toEye.
inline Floats3 mirroredBy(const Floats3& h, const Floats3& toEye, Floats cosIn) {
    return h * (cosIn + cosIn) - toEye;
}
// The same about z: exact, and never below the surface.
inline Floats3 mirroredAtZ(const Floats3& toEye) {
    return {Floats(0.0f) - toEye.x, Floats(0.0f) - toEye.y, toEye.z};
}

// What happens to unpolarised light at a smooth dielectric boundary: the part that is reflected
// (Fresnel), and the cosine on the other side. Total internal reflection reflects 1; its cosOut is
// 0. Equal media (eta = 1) reflect nothing, at any angle.
struct Boundary {
    Floats reflected, cosOut;
};
inline Boundary boundaryAt(Floats cosIn, Floats eta) {
    const Floats zero(0.0f), one(1.0f), c = min(max(cosIn, zero), one), through = eta * c;
    // 1 - eta^2 sin^2 without cancellation at grazing angles
    const Floats cos2Out = (one - eta) * (one + eta) + through * through;
    const Floats cosOut = sqrt(max(cos2Out, zero));
    const Floats parallel = (c - eta * cosOut) / (c + eta * cosOut);
    const Floats perpendicular = (through - cosOut) / (through + cosOut);
    const Floats part = Floats(0.5f) * (parallel * parallel + perpendicular * perpendicular);
    const Mask isSame = eta == one;
    return {select(isSame, zero, select(cos2Out > zero, part, one)), select(isSame, c, cosOut)};
}

// Returns the refracted direction (Snell's law), to some roundings of length 1.
inline Floats3 refractedBy(const Floats3& h, const Floats3& toEye, Floats cosIn, Floats cosOut,
                           Floats eta) {
    return (h * cosIn - toEye) * eta - h * cosOut; // without cancellation for large eta
}

// Schlick 1994: (1 - cos)^5, how far the reflectance has risen from its value at normal incidence.
inline Floats schlickPart(Floats cosIn) {
    const Floats m = min(max(Floats(1.0f) - cosIn, Floats(0.0f)), Floats(1.0f));
    return (m * m) * (m * m) * m;
}
inline Floats3 schlickReflected(const Floats3& color, Floats part) {
    return color + (rgbOf(1.0f) - color) * part;
}

// What layers that reflect this let through: the same for all colours, as Cycles 4.
inline Floats3 restOf(const Floats3& albedo) {
    return rgbOf(max(Floats(1.0f) - maxOf(albedo), Floats(0.0f)));
}

// Metal by two colours, as Cycles 4 has it: F = Schlick(color) - dip cos (1 - cos)^6, with the dip
// such that at cos = 1/7 (82 degrees) F is edgeTint times Schlick's value (Kutz et al. 2021).
struct MetalFresnel {
    Floats3 color, dip;

    MetalFresnel(const Floats3& atNormal, const Floats3& edgeTint) : color(atNormal) {
        constexpr float s = 6.0f / 7, s5 = s * s * s * s * s;
        dip = schlickReflected(color, Floats(s5)) * (rgbOf(1.0f) - edgeTint) * Floats(7 / (s5 * s));
    }
    // `part` and `bend` are schlickPart() and cos (1 - cos)^6, or means of them over `all` light.
    Floats3 of(Floats all, Floats part, Floats bend) const {
        const Floats3 f = color * (all - part) + rgbOf(part) - dip * bend;
        return {clampedPart(f.x), clampedPart(f.y), clampedPart(f.z)};
    }
    Floats3 at(Floats cosIn) const {
        const Floats c = min(max(cosIn, Floats(0.0f)), Floats(1.0f)), part = schlickPart(c);
        return of(Floats(1.0f), part, c * (Floats(1.0f) - c) * part);
    }
    // The mean over the hemisphere, weighted by the cosine: 2 times the integral of F cos.
    Floats3 mean() const { return of(Floats(1.0f), Floats(1.0f / 21), Floats(1.0f / 126)); }

private:
    static Floats clampedPart(Floats f) { return min(max(f, Floats(0.0f)), Floats(1.0f)); }
};

LANES_END
