// GGX: a surface of small facets (Trowbridge and Reitz 1975; Walter et al. 2007), with Smith's
// shadowing, in which the heights of facets count once for both directions, and facets sampled as
// the eye sees them. No formula here divides by a cosine or subtracts what is nearly equal, so that
// floats do from alpha = 1e-3 to 1 and from the horizon to the zenith (test_lobe_formulas.cpp).
#pragma once

#include "material/boundary.h"

#include <limits>

LANES_BEGIN

// What scatters from one direction into another. `pdf` is the density per steradian with which
// visible facets send light there; `ratio` times it is what they send, apart from Fresnel's part,
// whose cosine is `cosIn`. Both are 0 where no facet does.
struct FacetPair {
    Floats cosIn, pdf, ratio;
};

struct Ggx {
    Floats x, y;     // alpha along the axes of the facets
    Floats sin, cos; // of the angle from the frame's x to the first axis
    Floats alpha;    // of both, if they were alike
    Mask smooth;     // so narrow that floats would not resolve it: single directions

    // Up to this roughness (Blender's scale) it is smooth; alpha is the square of roughness.
    static constexpr float kSmoothRoughness = 1e-3f, kSmooth = 1e-6f; // alpha

    explicit Ggx(Floats roughness) : sin(0.0f), cos(1.0f), smooth(maskOf(0)) { set(roughness); }
    // anisotropy from -1 to 1, above 0 wider along the first axis, with the aspect of Cycles; below
    // 0 wider along the second. rotation in turns.
    Ggx(Floats roughness, Floats anisotropy, Floats rotation) : smooth(maskOf(0)) {
        set(roughness);
        const Floats zero(0.0f), one(1.0f), part = min(abs(anisotropy), one);
        const Floats aspect = sqrt(one - part * Floats(0.9f));
        const Floats wide = min(alpha / aspect, one), narrow = max(alpha * aspect, Floats(kSmooth));
        x = select(anisotropy < zero, narrow, wide), y = select(anisotropy < zero, wide, narrow);
        const SineCosine turn = sinCosOfTurns(rotation - floor(rotation));
        sin = turn.sin, cos = turn.cos;
    }

    // Returns these facets, but along both axes at least as wide as this.
    Ggx atLeast(Floats least) const {
        Ggx wide = *this;
        wide.x = max(x, least), wide.y = max(y, least), wide.alpha = max(alpha, least);
        wide.smooth = smooth & (least <= Floats(kSmooth));
        return wide;
    }

    // Returns these facets, but along both axes as narrow as along the narrower one.
    Ggx narrowed() const {
        Ggx narrow = *this;
        narrow.x = narrow.y = min(x, y);
        return narrow;
    }

    // Between the shading frame and the frame of the facets' axes.
    Floats3 inward(const Floats3& v) const {
        return {v.x * cos + v.y * sin, v.y * cos - v.x * sin, v.z};
    }
    Floats3 outward(const Floats3& v) const {
        return {v.x * cos - v.y * sin, v.y * cos + v.x * sin, v.z};
    }

    // All directions from here on are in the frame of the axes.

    // The length of a direction in the space in which facets are uniform.
    Floats stretched(const Floats3& v) const { return sqrt(slope2(v) + v.z * v.z); }

    // The density of facets with this normal: per steradian, times its z, it sums up to 1.
    Floats density(const Floats3& h) const {
        const Floats a = h.x / x, b = h.y / y, q = (a * a + b * b) + h.z * h.z;
        return Floats(static_cast<float>(kInvPi)) / ((x * y * q) * q);
    }

    // Returns the normal of a facet, with the density with which the eye sees them (Dupuy and
    // Benyoub 2023: uniform on the cap that mirrors into the hemisphere).
    Floats3 visibleNormal(const Floats3& toEye, Floats u, Floats v) const {
        const Floats one(1.0f), scale = one / stretched(toEye);
        const Floats eyeX = toEye.x * x * scale, eyeY = toEye.y * y * scale, eyeZ = toEye.z * scale;
        const Floats3 cap = coneFromSquare(u, v, one + eyeZ);
        return normalize({(cap.x + eyeX) * x, (cap.y + eyeY) * y, (one - u) * (one + eyeZ)});
    }

    // Light that comes along toLight and is reflected to the eye, or refracted where toLight.z < 0.
    FacetPair pairOf(const Floats3& toEye, const Floats3& toLight, Floats eta) const {
        const Floats zero(0.0f), one(1.0f), least(1e-30f);
        const Mask isBehind = toLight.z < zero;
        const Floats3 sum = toEye * select(isBehind, eta, one) + toLight;
        const Floats length2 = dot(sum, sum), length = sqrt(length2);
        const Floats3 h = sum * (select(isBehind & (eta < one), Floats(-1.0f), one) / length);
        const Floats cosIn = dot(toEye, h), cosLight = dot(toLight, h);
        const Floats cosOut = select(isBehind, zero - cosLight, cosLight);

        const Floats eyeZ = toEye.z, lightZ = abs(toLight.z);
        const Floats eyeLength = stretched(toEye), sumLength = eyeZ + eyeLength;
        const Floats both = lightZ * eyeLength + eyeZ * stretched(toLight);
        const Floats spread = select(isBehind, Floats(4.0f) * cosIn * cosOut / length2, one);
        const Floats pdf = density(h) / (sumLength + sumLength) * spread;
        const Floats ratio =
            lightZ * sumLength / max(both, Floats(std::numeric_limits<float>::min()));
        const Mask is = (length2 > least) & (eyeZ > zero) & (lightZ > zero) & (h.z > zero) &
                        (cosIn > zero) & (cosOut > zero);
        const auto orNone = [&](Floats a) { return select(smooth, zero, select(is, a, zero)); };
        return {select(is, cosIn, one), orNone(pdf), orNone(ratio)};
    }

    // The roughness of facets alike along both axes that Cycles scales metal and layers as, and of
    // those that lose about as much light as these in one bounce.
    Floats meanRoughness() const { return sqrt(sqrt(x * y)); }
    Floats lossyRoughness() const { return sqrt(sqrt((x * x + y * y) * Floats(0.5f))); }

    // Where the tables of energy.h have this direction: 0 at the horizon, 1 at the zenith, finer
    // towards both; as a function of this the energy of narrow and of wide facets is smooth.
    Floats tablePlace(const Floats3& toEye) const { return placeOf(slope2(toEye), toEye.z); }
    // The same for glass, half-way to the angle itself, by which Fresnel's law goes.
    Floats glassPlace(const Floats3& toEye) const {
        const Floats lossy = lossyRoughness();
        return placeOf(slope2(toEye) / (lossy * lossy), toEye.z);
    }

private:
    void set(Floats roughness) {
        const Floats r = min(max(roughness, Floats(0.0f)), Floats(1.0f));
        smooth = r <= Floats(kSmoothRoughness);
        alpha = max(r * r, Floats(kSmooth));
        x = y = alpha;
    }
    static Floats placeOf(Floats slope2, Floats z) {
        const Floats length = sqrt(slope2 + z * z), up = sqrt(max(z, Floats(0.0f)) / length);
        const Floats off = sqrt(slope2 / (length * (length + z)));
        return up / (up + off);
    }
    Floats slope2(const Floats3& v) const {
        const Floats a = v.x * x, b = v.y * y;
        return a * a + b * b;
    }
};

LANES_END
