// Materials: forms and the laws of optics at single points. Energy, and eye and light exchanged:
// T20 of the battery (Code/verify/furnace.cpp).
#include "base/math.h"
#include "check.h"
#include "material/fresnel.h"
#include "material/material.h"
#include "unit/material_kit.h"

#include <cmath>

namespace test_material {

using material_kit::above;
using material_kit::atAngle;
using material_kit::kUp;
using meshes::Random;

TEST(material_diffuse_is_kd) {
    Material m;
    m.diffuse = {0.2f, 0.5f, 0.9f};
    // f cos at every angle is kd / pi cos, whose integral is kd.
    for (double angle = 0; angle < 1.5; angle += 0.1) {
        const Rgb light = reflectedLight(m, kUp, atAngle(0.7), atAngle(-angle));
        const double cosine = static_cast<double>(atAngle(angle).z);
        CHECK_NEAR(light.r, static_cast<double>(m.diffuse.r) * kInvPi * cosine, 1e-7);
        CHECK_NEAR(light.b, static_cast<double>(m.diffuse.b) * kInvPi * cosine, 1e-7);
    }
    CHECK(isBlack(reflectedLight(m, kUp, kUp, {0, 0, -1}))); // light from behind
    CHECK(isBlack(reflectedLight(m, kUp, kUp, {1, 0, 0})));
}

// ks (N.H)^n, without a cosine: COMP 557 and NFF.
TEST(material_blinn_form) {
    Material m;
    m.diffuse = {};
    m.specular = {0.5f, 0.25f, 1};
    m.exponent = 40;
    Random random(91);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 v = above(random), l = above(random);
        const double nh = normalize(toDouble(v) + toDouble(l)).z;
        CHECK_NEAR(reflectedLight(m, kUp, v, l).r, 0.5 * std::pow(nh, 40), 2e-6);
    }
    CHECK_NEAR(reflectedLight(m, kUp, atAngle(0.8), atAngle(-0.8)).b, 1, 1e-5); // mirror direction
    CHECK(isBlack(reflectedLight(m, kUp, atAngle(0.1), atAngle(2)))); // light below the horizon
}

TEST(material_snell_and_fresnel) {
    const float eta = 1 / 1.5f; // air to glass
    Random random(93);
    for (int i = 0; i < 5000; ++i) {
        const Vec3 n = toFloat(random.direction());
        Vec3 v = toFloat(random.direction());
        if (dot(v, n) < 0) v = -v;
        for (const float e : {eta, 1.5f, 1.0f}) {
            const auto out = refractThrough(v, n, e);
            const double sinIn = length(cross(toDouble(v), toDouble(n)));
            if (static_cast<double>(e) * sinIn > 1.00001) CHECK(!out);
            if (!out) continue;
            CHECK_NEAR(length(*out), 1, 3e-7);
            CHECK(dot(*out, n) < 0);
            CHECK_NEAR(length(cross(toDouble(*out), toDouble(n))), static_cast<double>(e) * sinIn,
                       2e-6);
            // In the plane of v and n, on the other side.
            CHECK_NEAR(dot(toDouble(*out), cross(toDouble(v), toDouble(n))), 0, 1e-6);
            CHECK(dot(toDouble(*out) + toDouble(n) * -dot(toDouble(*out), toDouble(n)),
                      toDouble(v)) <= 1e-6);
            if (e == 1.0f) CHECK(length(*out + v) < 2e-7f); // the same on both sides: straight on
        }
        const Vec3 mirrored = reflectAbout(v, n);
        CHECK_NEAR(dot(mirrored, n), dot(v, n), 1e-6);
        CHECK(length(toDouble(mirrored) + toDouble(v) -
                     toDouble(n) * (2 * dot(toDouble(v), toDouble(n)))) < 1e-6);
    }
    // The critical angle of glass is asin(1/1.5).
    const double critical = std::asin(1 / 1.5);
    CHECK(refractThrough(atAngle(critical - 1e-4), kUp, 1.5f).has_value());
    CHECK(!refractThrough(atAngle(critical + 1e-4), kUp, 1.5f).has_value());
    CHECK_EQUAL(fresnelDielectric(atAngle(critical + 1e-4).z, 1.5f), 1.0f);

    for (const double ior : {1.1, 1.33, 1.5, 2.4}) {
        const double normal = sqr((ior - 1) / (ior + 1));
        const float e = static_cast<float>(1 / ior);
        CHECK_NEAR(fresnelDielectric(1, e), normal, 1e-6);
        CHECK_NEAR(fresnelDielectric(1, static_cast<float>(ior)), normal, 1e-6); // from inside too
        CHECK_EQUAL(fresnelDielectric(0, e), 1.0f);
        // At Brewster's angle the parallel part vanishes: half of what the other part reflects.
        const double brewster = std::atan(ior);
        const double c = std::cos(brewster), out = std::sqrt(1 - sqr(std::sin(brewster) / ior));
        const double perpendicular = sqr((c - ior * out) / (c + ior * out));
        CHECK_NEAR(fresnelDielectric(static_cast<float>(c), e), perpendicular / 2, 1e-6);
        // Reversible: the same part comes back along the refracted way.
        for (double angle = 0; angle < 1.55; angle += 0.05) {
            const double inside = std::asin(std::sin(angle) / ior);
            CHECK_NEAR(
                fresnelDielectric(static_cast<float>(std::cos(angle)), e),
                fresnelDielectric(static_cast<float>(std::cos(inside)), static_cast<float>(ior)),
                5e-5);
        }
    }
    CHECK_EQUAL(fresnelDielectric(0.3f, 1), 0.0f); // no boundary
    CHECK(schlickWeight(1) == 0 && schlickWeight(0) == 1 && schlickWeight(-0.1f) == 1 &&
          schlickWeight(1.1f) == 0);
    CHECK_NEAR(schlickWeight(0.5f), 1 / 32.0, 1e-8);
}

} // namespace test_material
