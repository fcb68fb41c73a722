// T20: materials under a white sky and with the light and the eye exchanged. Lobes that are meant
// to keep the energy must not make any; the classic highlights of Blinn and Phong are unnormalised
// by definition, and what holds for them is their closed form and that the eye and the lamp may
// change places.
#include "base/math.h"
#include "base/text.h"
#include "material/material.h"
#include "sample/warp.h"
#include "verify/groups.h"

#include <array>

namespace battery {

namespace {

constexpr Vec3 kUp{0, 0, 1};
constexpr Rgb kWhite{1, 1, 1};
enum class Lobe { Diffuse, Ashikhmin, Blinn, Phong };
constexpr std::array kLobeNames = {"diffuse", "ashikhmin", "blinn", "phong"};
constexpr int kRoughnesses = 10; // 0.1 to 1

double roughnessOf(int step) { return 0.1 * (step + 1); }
// Blender's roughness as the width of a Blinn lobe.
double exponentOf(double r) { return clamp(2 / (r * r * r * r) - 2, 1.0, 1e5); }

Material materialOf(Lobe lobe, double exponent) {
    Material m;
    m.diffuse = lobe == Lobe::Diffuse ? kWhite : Rgb{};
    if (lobe == Lobe::Diffuse) return m;
    m.specular = kWhite;
    m.specularModel = lobe == Lobe::Ashikhmin ? SpecularModel::Ashikhmin
                      : lobe == Lobe::Blinn   ? SpecularModel::Blinn
                                              : SpecularModel::Phong;
    m.exponent = static_cast<float>(exponent);
    return m;
}

Vec3 tilted(double angle, double turn) {
    return toFloat(
        Vec3d{std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle)});
}

std::string nameOf(Lobe lobe) { return kLobeNames[static_cast<std::size_t>(lobe)]; }

// The light of a white sky that comes back: rings about the mirrored direction, where lobes are
// peaked, finer towards it. `reach`: the angle of the last ring.
double albedo(const Material& m, Vec3 toEye, double reach) {
    const Frame frame = frameAround(Vec3{-toEye.x, -toEye.y, toEye.z});
    constexpr int kRings = 500, kTurns = 240;
    double sum = 0;
    for (int i = 0; i < kRings; ++i) {
        const auto edge = [&](int k) {
            const double part = static_cast<double>(k) / kRings;
            return reach * part * part * part;
        };
        const double from = edge(i), to = edge(i + 1), angle = (from + to) / 2;
        double ring = 0;
        for (int j = 0; j < kTurns; ++j) {
            const Vec3 toLight =
                normalize(frame.toWorld(tilted(angle, kTwoPi * (j + 0.5) / kTurns)));
            ring += static_cast<double>(reflectedLight(m, kUp, toEye, toLight).g);
        }
        sum += ring * (kTwoPi / kTurns) * 2 * std::sin((to - from) / 2) * std::sin(angle);
    }
    return sum;
}

// One batch is one direction of the eye for every lobe that keeps energy and every roughness.
Tally whiteSky(const Effort& effort) {
    return inBatches(effort, 201, 2, [](meshes::Random& random, Tally& tally) {
        const double angle = random.uniform(0, 1.55);
        const Vec3 toEye = tilted(angle, random.uniform(0, kTwoPi));
        for (const Lobe lobe : {Lobe::Diffuse, Lobe::Ashikhmin}) {
            for (int r = 0; r < (lobe == Lobe::Diffuse ? 1 : kRoughnesses); ++r) {
                const double value =
                    albedo(materialOf(lobe, exponentOf(roughnessOf(r))), toEye, kPi);
                ++tally.cases;
                tally.measure(value, [&] {
                    return cat(nameOf(lobe), ", roughness ", roughnessOf(r), ", eye at ", angle);
                });
            }
        }
    });
}

// Seen straight on, with a = angle of the half vector and n the exponent.
double albedoStraightOn(Lobe lobe, double n) {
    const auto above = [](double power) { return 1 - std::exp2(-power / 2); }; // a < 45 degrees
    switch (lobe) {
    case Lobe::Diffuse: return 1;
    // (n+1) * integral of cos^n a (2 cos^2 a - 1) d cos a
    case Lobe::Ashikhmin: return (n + 1) * 2 / (n + 3) * above(n + 3) - above(n + 1);
    // 8 pi * integral of cos^(n+1) a d cos a
    case Lobe::Blinn: return 8 * kPi / (n + 2) * above(n + 2);
    case Lobe::Phong: return kTwoPi / (n + 1);
    }
    return 0;
}

Tally straightOn(const Effort& effort) {
    const Effort once{.factor = 1, .threads = effort.threads, .batch = effort.batch};
    return inBatches(once, 202, kRoughnesses, [](meshes::Random& random, Tally& tally) {
        // Roughnesses between 0.1 and 1: the exponents between 20,000 and 1.
        const double exponent = exponentOf(random.uniform(0.1, 1));
        for (const Lobe lobe : {Lobe::Diffuse, Lobe::Ashikhmin, Lobe::Blinn, Lobe::Phong}) {
            const Material m = materialOf(lobe, exponent);
            const double found = albedo(m, kUp, kHalfPi);
            const double wanted = albedoStraightOn(lobe, static_cast<double>(m.exponent));
            ++tally.cases;
            tally.measure(std::fabs(found / wanted - 1), [&] {
                return cat(nameOf(lobe), ", exponent ", exponent, ": ", found, ", wanted ", wanted);
            });
        }
    });
}

// Diffuse and ashikhmin: f, which is what comes back over the cosine of the light. Blinn and phong
// stand for f times the cosine already, and that is what is symmetric.
Tally reciprocity(const Effort& effort) {
    return inBatches(effort, 203, 20, [](meshes::Random& random, Tally& tally) {
        const auto above = [&] {
            const Vec3 d = toFloat(random.direction());
            return Vec3{d.x, d.y, std::fabs(d.z)};
        };
        for (int i = 0; i < 2000; ++i) {
            const Lobe lobe = static_cast<Lobe>(random.below(kLobeNames.size()));
            const double r = roughnessOf(static_cast<int>(random.below(kRoughnesses)));
            const Material m = materialOf(lobe, exponentOf(r));
            const Vec3 eye = above();
            // Half of the lights near the mirrored direction, where narrow lobes are.
            const Vec3 light = random.chance(0.5)
                                   ? above()
                                   : normalize(Vec3{-eye.x, -eye.y, eye.z} +
                                               toFloat(random.direction() * (0.3 * r)));
            if (eye.z < 0.01f || light.z < 0.01f) continue;
            const Frame frame = frameAround(toFloat(random.direction()));
            const bool hasCosine = lobe == Lobe::Diffuse || lobe == Lobe::Ashikhmin;
            const auto answer = [&](Vec3 from, Vec3 to) {
                const double value = static_cast<double>(
                    reflectedLight(m, frame.z, frame.toWorld(to), frame.toWorld(from)).g);
                return hasCosine ? value / dot(toDouble(frame.z), toDouble(frame.toWorld(from)))
                                 : value;
            };
            const double a = answer(light, eye), b = answer(eye, light);
            ++tally.cases;
            if (max(a, b) < 1e-30) continue; // far outside of a lobe: both are as good as nothing
            tally.measure(std::fabs(a - b) / max(a, b), [&] {
                return cat(nameOf(lobe), ", roughness ", r, ": ", a, " and ", b);
            });
        }
    });
}

// Mirror and glass of every law, roughness and ior: the rays of one hit carry on what arrived.
Tally tracedRays(const Effort& effort) {
    return inBatches(effort, 204, 20, [](meshes::Random& random, Tally& tally) {
        for (int i = 0; i < 5000; ++i) {
            Material m;
            m.fresnel = static_cast<FresnelModel>(random.below(3));
            m.roughness =
                random.chance(0.2)
                    ? 0.0f
                    : static_cast<float>(roughnessOf(static_cast<int>(random.below(kRoughnesses))));
            const float part = static_cast<float>(random.unit());
            const bool shared = m.fresnel != FresnelModel::Dielectric; // by Fresnel's formula there
            m.mirror = shared ? kWhite * part : kWhite;
            m.transmission = shared ? kWhite * (1 - part) : kWhite;
            const float eta = static_cast<float>(random.logUniform(1 / 2.5, 2.5));
            const double angle = random.uniform(0, 1.5);
            const Bounces out = bounces(m, kUp, kUp, tilted(angle, random.uniform(0, kTwoPi)), eta,
                                        random.square());
            double sum = 0;
            for (const auto& bounce : {out.reflected, out.refracted})
                if (bounce) sum += static_cast<double>(bounce->weight.g);
            const auto text = [&] {
                return cat("fresnel ", static_cast<int>(m.fresnel), ", roughness ", m.roughness,
                           ", eta ", eta, ", eye at ", angle, ": ", sum);
            };
            ++tally.cases;
            // A sharp surface loses nothing either; a rough one does where its facets shade it.
            if (m.roughness == 0 && !(sum > 1 - 1e-6)) tally.fail(text);
            tally.measure(sum, text);
        }
    });
}

constexpr Row kFurnaceRows[] = {
    {"T20a", "white sky on diffuse and ashikhmin: what comes back", "albedo", 1.001, true,
     whiteSky},
    {"T20b", "all four lobes seen straight on: albedo by formula", "relative", 0.001, true,
     straightOn},
    {"T20c", "light and eye exchanged, four lobes x 10 roughnesses", "relative", 1e-4, true,
     reciprocity},
    {"T20d", "mirror and glass: light that the rays of a hit carry on", "of the light", 1.001, true,
     tracedRays},
};

} // namespace

std::span<const Row> furnaceRows() { return kFurnaceRows; }

} // namespace battery
