// The choice of one light of many: probabilities that sum up to 1 (picks that follow them: T22d),
// and trees that do not depend on the scale of the scene.
#include "check.h"
#include "light/tree/light_tree.h"
#include "light/tree/pick_lanes.h"
#include "verify/light_kit.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace test_light_picker {

using namespace light_kit;
using meshes::Random;

namespace {

struct OneChoice {
    explicit OneChoice(const LightPicker& picker) : choice(picker.view()) {}
    struct Picked {
        std::uint32_t light;
        float probability;
        double u;
    };
    Picked pick(Vec3 p, Vec3 n, std::uint32_t bits) const {
        const auto out = choice.pick(lane(p), lane(n), kernels::one::unitDoubles(bits));
        return {out.light.v, out.probability.v, out.u.v};
    }
    float probability(Vec3 p, Vec3 n, std::size_t light) const {
        return choice.probability(lane(p), lane(n), static_cast<std::uint32_t>(light)).v;
    }
    kernels::one::LightChoice choice;
};

std::uint32_t bits32(Random& random) { return static_cast<std::uint32_t>(random.unit() * 0x1p32); }

} // namespace

// Floats are rounded to 2^-24 of each, the sum of all is off by less.
TEST(light_picker_probabilities_sum_up_to_one) {
    constexpr std::uint64_t kSeed = 5120;
    Random random(kSeed);
    for (const std::size_t count : {1u, 2u, 3u, 5u, 16u, 17u, 40u, 200u}) {
        const auto rows = someLights(random, count, count != 2);
        const auto bounds = boundsOf(rows);
        const LightPicker picker(bounds);
        const OneChoice choice(picker);
        const bool isDark = std::all_of(bounds.begin(), bounds.end(),
                                        [](const LightBounds& b) { return b.isDark(); });
        const int points = count == 200 ? 3000 : 1500;
        for (int i = 0; i < points; ++i) {
            const Vec3 p = toFloat(random.inBox(random.chance(0.3) ? 10 : 1));
            const Vec3 n = random.chance(0.1) ? Vec3{} : unitVector(random);
            double sum = 0;
            for (std::size_t k = 0; k < rows.size(); ++k) {
                const auto probability = static_cast<double>(choice.probability(p, n, k));
                sum += probability;
                CHECK_INFO(bounds[k].isDark() ? probability == 0 : probability > 0,
                           "light " << k << " of " << count << " has " << probability);
            }
            CHECK_INFO(std::fabs(sum - (isDark ? 0 : 1)) < 1e-5,
                       "seed " << kSeed << " of " << count << " lights: " << sum);
            const auto picked = choice.pick(p, n, bits32(random));
            if (isDark) {
                CHECK(picked.probability == 0);
                continue;
            }
            CHECK_INFO(picked.probability == choice.probability(p, n, picked.light),
                       picked.probability << " for light " << picked.light);
            CHECK(picked.u >= 0 && picked.u < 1);
        }
    }
}

// Where only dim lights reach a point although bright ones could, no sample of a light is more than
// 20 * 2^depth times what all give together.
TEST(light_picker_weights_are_bounded) {
    constexpr std::uint64_t kSeed = 5121;
    Random random(kSeed);
    double worst = 0;
    for (int round = 0; round < 20; ++round) {
        const auto rows = someLights(random, 60, round % 2 == 0);
        const LightPicker picker(boundsOf(rows));
        const OneChoice choice(picker);
        for (int i = 0; i < 100; ++i) {
            const Vec3 p = toFloat(random.inBox(2)), n = unitVector(random);
            double sum = 0, most = 0;
            for (std::size_t k = 0; k < rows.size(); ++k) {
                double light = 0;
                kernels::one::forLight(rows[k].kind, [&]<class L>() {
                    const L lamp(kernels::one::LightNumbers{rows[k].numbers.data(), 1});
                    for (int s = 0; s < 4; ++s) {
                        const Sample at = plain(lamp.sample(lane(p), (float(s % 2) + 0.5f) / 2,
                                                            (float(s / 2) + 0.5f) / 2));
                        light += static_cast<double>(at.irradiance.g) *
                                 static_cast<double>(max(dot(at.toLight, n), 0.0f)) / 4;
                    }
                });
                if (!(light > 0)) continue;
                sum += light;
                most = max(most, light / static_cast<double>(choice.probability(p, n, k)));
            }
            if (sum > 0) worst = max(worst, most / sum / (20 * std::ldexp(1.0, picker.depth())));
        }
    }
    // One choice of twenty goes by chance at each group.
    CHECK_INFO(worst < 1, "seed " << kSeed << ": a light has " << worst << " times its most");
}

// Times a power of two everything is the same to the last bit.
TEST(light_picker_does_not_know_the_scale) {
    constexpr std::uint64_t kSeed = 5123;
    for (const float scale : {0x1p-9f, 0x1p12f}) {
        Random random(kSeed);
        std::vector<LightRow> rows, scaled;
        for (int i = 0; i < 100; ++i) {
            const Vec3 centre = toFloat(random.inBox(1));
            if (i % 3 == 0) {
                PointRow row = point(centre, 0.01f);
                rows.push_back(lightRow(row));
                row.position = row.position * scale, row.radius *= scale;
                row.intensity = row.intensity * (scale * scale);
                scaled.push_back(lightRow(row));
            } else if (i % 20 == 1) {
                rows.push_back(lightRow(sun(random, 0.1))), scaled.push_back(rows.back());
            } else {
                TriangleRow row = triangle(random, centre, 0.2f);
                rows.push_back(lightRow(row));
                row.a = row.a * scale, row.b = row.b * scale, row.c = row.c * scale;
                scaled.push_back(lightRow(row));
            }
        }
        const LightPicker one(boundsOf(rows)), other(boundsOf(scaled));
        for (int i = 0; i < 2000; ++i) {
            const Vec3 p = toFloat(random.inBox(2)), n = unitVector(random);
            const std::uint32_t u = bits32(random);
            const auto a = OneChoice(one).pick(p, n, u), b = OneChoice(other).pick(p * scale, n, u);
            CHECK_INFO(a.light == b.light && a.probability == b.probability && a.u == b.u,
                       "scale " << scale << ": " << a.light << ' ' << a.probability << ", "
                                << b.light << ' ' << b.probability);
        }
    }
}

// Many lights in one place, all on a line, and none: trees end, and are not too deep for a trail.
TEST(light_picker_of_degenerate_lights) {
    CHECK(OneChoice(LightPicker()).pick({}, {0, 0, 1}, 5).probability == 0);
    Random random(5124);
    for (const bool isLine : {false, true}) {
        std::vector<LightRow> rows;
        double at = 1;
        for (int i = 0; i < 3000; ++i) {
            const float x = isLine ? static_cast<float>(at) : 0.0f;
            at *= 0.98; // most are crowded at one end
            rows.push_back(lightRow(point({x, 0, 0}, 0)));
        }
        const LightPicker picker(boundsOf(rows));
        CHECK_INFO(picker.depth() <= 32, picker.depth());
        for (int i = 0; i < 20; ++i) {
            double sum = 0;
            const Vec3 p = i == 0 ? Vec3{} : toFloat(random.inBox(1)), n = unitVector(random);
            for (std::size_t k = 0; k < rows.size(); ++k)
                sum += static_cast<double>(OneChoice(picker).probability(p, n, k));
            CHECK_NEAR(sum, 1, 1e-5);
        }
    }
}

} // namespace test_light_picker
