// T20: materials under a white sky and with the light and the eye exchanged. Lobes that are meant
// to keep the energy must not make any; the classic highlights of Blinn and Phong are unnormalised
// by definition, and what holds for them is their closed form and that the eye and the lamp may
// change places.
#include "base/math.h"
#include "base/text.h"
#include "material/lobe_types.h"
#include "material/lobes.h"
#include "sample/warp.h"
#include "verify/groups.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

namespace battery {

namespace {

constexpr Vec3 kUp{0, 0, 1};
constexpr std::array kLobeNames = {"diffuse", "ashikhmin", "blinn", "phong"};
constexpr int kRoughnesses = 10; // 0.1 to 1

double roughnessOf(int step) { return 0.1 * (step + 1); }
// Blender's roughness as the width of a Blinn lobe.
double exponentOf(double r) { return clamp(2 / (r * r * r * r) - 2, 1.0, 1e5); }

// A lobe of the list with its numbers, by one lane. Directions are in the shading frame.
class OneLobe {
public:
    OneLobe(std::string_view name, double exponent) : name_(name) {
        const std::span<const LobeType> types = lobeTypes();
        while (name != types[kind_].name) ++kind_;
        numbers_[0] = static_cast<float>(exponent); // of the highlights; others have none
    }
    // Sets a number of the lobe, colours to grey.
    void set(std::string_view field, double value) {
        std::size_t at = 0;
        for (const LobeField& of : lobeTypes()[kind_].fields) {
            const auto count = static_cast<std::size_t>(of.count);
            if (field == of.name)
                std::fill_n(numbers_.begin() + static_cast<std::ptrdiff_t>(at), count,
                            static_cast<float>(value));
            at += count;
        }
    }
    void setEta(double eta) { eta_ = static_cast<float>(eta); }
    const std::string& name() const { return name_; }
    double exponent() const { return static_cast<double>(numbers_[0]); }

    // f |cos| of what comes from `toLight`.
    double eval(Vec3 toEye, Vec3 toLight) const {
        double out = 0;
        withLobe([&](const auto& lobe) {
            out = static_cast<double>(lobe.eval(lanesOf(toEye), lanesOf(toLight)).y.v);
        });
        return out;
    }
    // The light that all rays of one sample carry on.
    double carriedOn(Vec3 toEye, Vec2 u) const {
        double out = 0;
        withLobe([&]<class L>(const L& lobe) {
            if constexpr ((L::kFlags & kReflects) != 0 && (L::kFlags & kTransmits) != 0)
                for (const bool transmits : {false, true})
                    out += weightOf(lobe.branch(lanesOf(toEye), transmits, u.x, u.y));
            else if constexpr ((L::kFlags & kSpawnsRays) != 0)
                out = weightOf(lobe.sample(lanesOf(toEye), 0.5f, u.x, u.y));
        });
        return out;
    }

private:
    static kernels::one::Floats3 lanesOf(Vec3 v) { return {v.x, v.y, v.z}; }
    static double weightOf(const kernels::one::LobeSample& sample) {
        return sample.pdf.v > 0 ? static_cast<double>(sample.weight.y.v) : 0;
    }
    template <class Fn> void withLobe(const Fn& fn) const {
        kernels::one::forLobe(static_cast<std::uint8_t>(kind_), [&]<class L> {
            fn(L(kernels::one::LobeNumbers{numbers_.data(), 1, eta_}));
        });
    }

    std::string name_;
    std::size_t kind_ = 0;
    std::array<float, kLobeNumbers> numbers_{};
    float eta_ = 1;
};

Vec3 tilted(double angle, double turn) {
    return toFloat(
        Vec3d{std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle)});
}

// The light of a white sky that comes back: rings about the mirrored direction, where lobes are
// peaked, finer towards it. `reach`: the angle of the last ring.
double albedo(const OneLobe& lobe, Vec3 toEye, double reach) {
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
            ring += lobe.eval(toEye, toLight);
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
        for (const char* const name : {"diffuse", "ashikhmin"}) {
            const bool isRough = name == std::string_view("ashikhmin");
            for (int r = 0; r < (isRough ? kRoughnesses : 1); ++r) {
                const double value = albedo({name, exponentOf(roughnessOf(r))}, toEye, kPi);
                ++tally.cases;
                tally.measure(value, [&] {
                    return cat(name, ", roughness ", roughnessOf(r), ", eye at ", angle);
                });
            }
        }
    });
}

// Seen straight on, with a = angle of the half vector and n the exponent.
double albedoStraightOn(const OneLobe& lobe) {
    const double n = lobe.exponent();
    const auto above = [](double power) { return 1 - std::exp2(-power / 2); }; // a < 45 degrees
    // (n+1) * integral of cos^n a (2 cos^2 a - 1) d cos a
    if (lobe.name() == "ashikhmin") return (n + 1) * 2 / (n + 3) * above(n + 3) - above(n + 1);
    // 8 pi * integral of cos^(n+1) a d cos a
    if (lobe.name() == "blinn") return 8 * kPi / (n + 2) * above(n + 2);
    if (lobe.name() == "phong") return kTwoPi / (n + 1);
    return 1;
}

Tally straightOn(const Effort& effort) {
    const Effort once{.factor = 1, .threads = effort.threads, .batch = effort.batch};
    return inBatches(once, 202, kRoughnesses, [](meshes::Random& random, Tally& tally) {
        // Roughnesses between 0.1 and 1: the exponents between 20,000 and 1.
        const double exponent = exponentOf(random.uniform(0.1, 1));
        for (const char* const name : kLobeNames) {
            const OneLobe lobe(name, exponent);
            const double found = albedo(lobe, kUp, kHalfPi), wanted = albedoStraightOn(lobe);
            ++tally.cases;
            tally.measure(std::fabs(found / wanted - 1), [&] {
                return cat(name, ", exponent ", exponent, ": ", found, ", wanted ", wanted);
            });
        }
    });
}

// Diffuse and ashikhmin, the first two: f, which is what comes back over the cosine of the light.
// Blinn and phong stand for f times the cosine already, and that is what is symmetric.
Tally reciprocity(const Effort& effort) {
    return inBatches(effort, 203, 20, [](meshes::Random& random, Tally& tally) {
        const auto above = [&] {
            const Vec3 d = toFloat(random.direction());
            return Vec3{d.x, d.y, std::fabs(d.z)};
        };
        for (int i = 0; i < 2000; ++i) {
            const std::size_t which = random.below(kLobeNames.size());
            const double r = roughnessOf(static_cast<int>(random.below(kRoughnesses)));
            const OneLobe lobe(kLobeNames[which], exponentOf(r));
            const Vec3 eye = above();
            // Half of the lights near the mirrored direction, where narrow lobes are.
            const Vec3 light = random.chance(0.5)
                                   ? above()
                                   : normalize(Vec3{-eye.x, -eye.y, eye.z} +
                                               toFloat(random.direction() * (0.3 * r)));
            if (eye.z < 0.01f || light.z < 0.01f) continue;
            const auto answer = [&](Vec3 from, Vec3 to) {
                const double value = lobe.eval(to, from);
                return which < 2 ? value / static_cast<double>(from.z) : value;
            };
            const double a = answer(light, eye), b = answer(eye, light);
            ++tally.cases;
            if (max(a, b) < 1e-30) continue; // far outside of a lobe: both are as good as nothing
            tally.measure(std::fabs(a - b) / max(a, b),
                          [&] { return cat(lobe.name(), ", roughness ", r, ": ", a, " and ", b); });
        }
    });
}

// Sharp mirrors and glass of every ior: the rays of one hit carry on what arrived.
Tally tracedRays(const Effort& effort) {
    return inBatches(effort, 204, 20, [](meshes::Random& random, Tally& tally) {
        for (int i = 0; i < 5000; ++i) {
            constexpr std::array kNames = {"mirror", "schlick_mirror", "dielectric", "refraction"};
            OneLobe lobe(kNames[random.below(kNames.size())], 0);
            for (const char* const white : {"color", "reflect_tint", "transmit_tint"})
                lobe.set(white, 1);
            const double eta = random.logUniform(1 / 2.5, 2.5);
            lobe.setEta(eta);
            const double angle = random.uniform(0, 1.5);
            const double sum =
                lobe.carriedOn(tilted(angle, random.uniform(0, kTwoPi)), random.square());
            const auto text = [&] {
                return cat(lobe.name(), ", eta ", eta, ", eye at ", angle, ": ", sum);
            };
            ++tally.cases;
            if (!(sum > 1 - 1e-6)) tally.fail(text);
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
