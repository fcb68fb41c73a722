// Where light goes on from a material, and how much of it: mirrors and glass, smooth and rough.
#include "base/math.h"
#include "check.h"
#include "material/fresnel.h"
#include "material/material.h"
#include "sample/warp.h"
#include "unit/material_kit.h"

#include <cmath>
#include <utility>

namespace test_material_bounces {

using material_kit::above;
using material_kit::atAngle;
using material_kit::kUp;
using meshes::Random;

namespace {

// Exponent and width of a lobe that has Blender's roughness r (material.cpp).
double exponentOf(double r) { return clamp(2 / (r * r * r * r) - 2, 1.0, 1e5); }

// Integral of a function of the direction over the hemisphere, on a fine grid about `axis`, where
// it is peaked: angle from the axis in steps that grow with it.
template <class Fn> double integrate(Vec3d axis, Fn&& f) {
    const Vec3d a = normalize(axis);
    const Frame frame = frameAround(toFloat(a));
    double sum = 0;
    const int steps = 400, turns = 240;
    for (int i = 0; i < steps; ++i) {
        const double from = kPi * sqr(static_cast<double>(i) / steps);
        const double to = kPi * sqr(static_cast<double>(i + 1) / steps), angle = (from + to) / 2;
        double ring = 0;
        for (int j = 0; j < turns; ++j) {
            const double turn = kTwoPi * (j + 0.5) / turns;
            const Vec3d local{std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn),
                              std::cos(angle)};
            const Vec3 dir = frame.toWorld(toFloat(local));
            if (dir.z > 0) ring += f(normalize(dir));
        }
        sum += ring * (kTwoPi / turns) * (std::cos(from) - std::cos(to));
    }
    return sum;
}

Material glossy(double exponent) {
    Material m;
    m.diffuse = {};
    m.specular = {1, 1, 1};
    m.specularModel = SpecularModel::Ashikhmin;
    m.exponent = static_cast<float>(exponent);
    return m;
}

} // namespace

TEST(material_smooth_bounces) {
    Material m;
    m.mirror = {0.5f, 1, 1}, m.transmission = {1, 0.25f, 1};
    const Vec3 v = atAngle(0.6);
    const float eta = 1 / 1.5f;
    Bounces out = bounces(m, kUp, kUp, v, eta, {0.3f, 0.7f});
    CHECK(out.reflected && out.refracted);
    CHECK(length(out.reflected->dir - atAngle(-0.6)) < 1e-6f);
    CHECK(out.reflected->weight == m.mirror && out.refracted->weight == m.transmission);

    m.fresnel = FresnelModel::Dielectric;
    const float f = fresnelDielectric(v.z, eta);
    out = bounces(m, kUp, kUp, v, eta, {});
    CHECK(out.reflected->weight == m.mirror * f &&
          out.refracted->weight == m.transmission * (1 - f));

    m.fresnel = FresnelModel::Schlick;
    out = bounces(m, kUp, kUp, kUp, eta, {});
    CHECK(out.reflected->weight == m.mirror && out.refracted->weight == m.transmission);
    out = bounces(m, kUp, kUp, atAngle(kHalfPi - 1e-4), eta, {});
    CHECK_NEAR(out.reflected->weight.r, 1, 1e-3); // grazing: a mirror, whatever its colour
    CHECK(maxChannel(out.refracted->weight) < 1e-3f);

    // Total internal reflection: what was to be transmitted is reflected.
    m.fresnel = FresnelModel::None;
    m.mirror = {0.25f, 0, 0}, m.transmission = {0.75f, 1, 0.5f};
    out = bounces(m, kUp, kUp, atAngle(1), 1.5f, {});
    CHECK(out.reflected && !out.refracted && out.reflected->weight == Rgb({1, 1, 0.5f}));
    m.fresnel = FresnelModel::Dielectric;
    m.mirror = m.transmission = {1, 1, 1};
    out = bounces(m, kUp, kUp, atAngle(1), 1.5f, {});
    CHECK(!out.refracted && out.reflected->weight == Rgb({1, 1, 1}));

    m.mirror = m.transmission = {}; // neither
    out = bounces(m, kUp, kUp, v, eta, {});
    CHECK(!out.reflected && !out.refracted);
}

// Bent normals and roughness at any angle: reflections stay above the true surface, refractions
// below it, unit directions, finite weights of at most what there is. Only what is rough may send
// nothing at all.
TEST(material_no_bounce_on_the_wrong_side) {
    Random random(94);
    long long wrong = 0, count = 0;
    for (int i = 0; i < 200000; ++i) {
        Material m;
        m.mirror = m.transmission = {0.5f, 0.5f, 0.5f};
        m.roughness = random.chance(0.3) ? 0.0f : static_cast<float>(random.unit());
        m.fresnel = static_cast<FresnelModel>(random.below(3));
        const Vec3 ng = toFloat(random.direction());
        const auto onSide = [&](Vec3 side) {
            for (;;) {
                const Vec3 d = toFloat(random.direction());
                if (dot(d, side) > 1e-4f) return d;
            }
        };
        const Vec3 n = random.chance(0.5) ? ng : onSide(ng);
        Vec3 v = onSide(ng);
        if (dot(v, n) <= 0) continue; // shade() sees to that
        const float eta = static_cast<float>(random.logUniform(0.4, 2.5));
        const Bounces out = bounces(m, n, ng, v, eta, random.square());
        ++count;
        for (const auto& [bounce, side] :
             {std::pair(out.reflected, ng), std::pair(out.refracted, -ng)}) {
            if (!bounce) continue;
            const float weight = maxChannel(bounce->weight);
            if (!(dot(bounce->dir, side) > 0) || !(std::fabs(length(bounce->dir) - 1) < 1e-6f) ||
                !(weight >= 0 && weight <= 1.000001f))
                ++wrong;
        }
        if (m.roughness <= 0 && !out.reflected && !out.refracted) ++wrong;
    }
    std::printf("%lld bounces, seed 94\n", count);
    CHECK(count > 80000);
    CHECK_EQUAL(wrong, 0);
}

// What is bent is bent about the shading normal by Snell's law, and about the true one only where
// the first leads to the side of the eye.
TEST(material_bent_refraction_is_about_the_shading_normal) {
    Random random(95);
    const Vec3 ng{0, 0, 1};
    Material m;
    m.transmission = {1, 1, 1};
    int bent = 0, fallen = 0;
    const int count = check::scaled(20000);
    for (int i = 0; i < count; ++i) {
        const Vec3 n = above(random), v = above(random);
        if (dot(v, n) <= 0) continue;
        const float eta = static_cast<float>(random.logUniform(0.4, 2.5));
        const auto first = refractThrough(v, n, eta), second = refractThrough(v, ng, eta);
        if (!first) continue;
        const bool isBelow = dot(*first, ng) < 0;
        const Bounces out = bounces(m, n, ng, v, eta, {0.5f, 0.5f});
        const auto& expected = isBelow ? first : second; // none: total internal reflection
        CHECK_INFO(out.refracted.has_value() == expected.has_value() &&
                       (!expected || out.refracted->dir == *expected),
                   "case " << i << " of seed 95");
        ++(isBelow ? bent : fallen);
    }
    CHECK_INFO(bent > count / 10 && fallen > count / 1000,
               bent << " bent, " << fallen << " fell back");
}

// A half vector that the eye does not see reflects nothing, nor does one that sends light below the
// shading normal or the surface.
TEST(material_rough_half_vectors_face_the_eye) {
    Random random(96);
    const Vec3 ng{0, 0, 1}, n = normalize(Vec3{0.1f, 0.2f, 1}), v = normalize(Vec3{1, 0, 0.05f});
    Material m;
    m.mirror = {1, 1, 1};
    m.roughness = 1; // of exponent 1
    int turnedAway = 0, below = 0;
    const int count = check::scaled(2000);
    for (int i = 0; i < count; ++i) {
        const Vec2 u = random.square();
        const Vec3 h = normalize(frameAround(n).toWorld(cosinePowerFromSquare(u, 1)));
        const Vec3 dir = normalize(reflectAbout(v, h));
        const bool isAway = !(dot(h, v) > 0), isBelow = !(dot(dir, n) > 0 && dot(dir, ng) > 0);
        const Bounces out = bounces(m, n, ng, v, 1, u);
        CHECK_INFO(out.reflected.has_value() == !(isAway || isBelow) &&
                       (!out.reflected || out.reflected->dir == dir),
                   "case " << i << " of seed 96");
        turnedAway += isAway, below += !isAway && isBelow;
    }
    CHECK_INFO(turnedAway > count / 10 && below > count / 20,
               turnedAway << " turned away, " << below << " below");
}

// Rough reflection draws half vectors from the Blinn lobe: the mean direction and the mean weight
// are those of the Ashikhmin lobe with that exponent, integrated by a rule.
TEST(material_rough_reflection_is_the_lobe) {
    Random random(95);
    for (const double roughness : {0.1, 0.3, 0.5, 0.8}) {
        const Material lobe = glossy(exponentOf(roughness));
        Material m;
        m.mirror = {1, 1, 1};
        m.roughness = static_cast<float>(roughness);
        for (const double angle : {0.0, 0.6, 1.1}) {
            const Vec3 v = atAngle(angle);
            Vec3d mean{}; // of direction times weight
            double weight = 0, weight2 = 0;
            const int side = 300;
            for (int i = 0; i < side * side; ++i) {
                const Vec2 u{static_cast<float>((i % side + random.unit()) / side),
                             static_cast<float>((i / side + random.unit()) / side)};
                const Vec2 inside{min(u.x, kOneMinusUlp), min(u.y, kOneMinusUlp)};
                // A half vector whose reflection is below the surface gives the mirror direction
                // instead of nothing: not a part of the lobe.
                const Vec3 h = normalize(frameAround(kUp).toWorld(
                    cosinePowerFromSquare(inside, static_cast<float>(exponentOf(roughness)))));
                if (!(dot(h, v) > 0) || !(reflectAbout(v, h).z > 0)) continue;
                const Bounces out = bounces(m, kUp, kUp, v, 1, inside);
                const double w = static_cast<double>(out.reflected->weight.g);
                mean += toDouble(out.reflected->dir) * w;
                weight += w, weight2 += w * w;
            }
            const double count = static_cast<double>(side) * side;
            mean = mean / count, weight /= count;
            const auto moment = [&](auto&& value) {
                return integrate(toDouble(atAngle(-angle)), [&](Vec3 l) {
                    return static_cast<double>(reflectedLight(lobe, kUp, v, l).g) * value(l);
                });
            };
            const double albedo = moment([](Vec3) { return 1.0; });
            const double x = moment([](Vec3 l) { return static_cast<double>(l.x); });
            const double z = moment([](Vec3 l) { return static_cast<double>(l.z); });
            // Three sigma of 90,000 plain samples of a value in [0,1] are below 0.005.
            CHECK_INFO(std::fabs(weight - albedo) < 0.003, "roughness " << roughness << " angle "
                                                                        << angle << ": " << weight
                                                                        << " lobe " << albedo);
            CHECK_INFO(std::fabs(mean.x - x) < 0.003 && std::fabs(mean.z - z) < 0.003 &&
                           std::fabs(mean.y) < 0.003,
                       "roughness " << roughness << " angle " << angle << ": " << mean.x << ' '
                                    << mean.z << " lobe " << x << ' ' << z);
        }
    }
}

} // namespace test_material_bounces
