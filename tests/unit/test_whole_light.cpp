// Lamps in closed form: the mean of their samples, in lanes as alone.
#include "check.h"
#include "light/area_light.h"
#include "light/point_light.h"
#include "light/sun_light.h"
#include "lit_kit.h"

#include <memory>

namespace test_whole_light {

using namespace litkit;

namespace {

std::unique_ptr<const Light> someLamp(Random& random) {
    const Vec3 at = toFloat(random.inBox(3));
    const auto size = static_cast<float>(random.logUniform(1e-2, 2));
    const std::uint32_t kind = random.below(5);
    const Rgb white{1, 1, 1};
    if (kind < 2)
        return std::make_unique<PointLight>(
            at, white, kind == 0 ? Attenuation{} : Attenuation{0, 0, 1}, size, std::nullopt, true);
    if (kind == 2) return std::make_unique<SphereLight>(at, size, white, true);
    const Vec3 way = toFloat(random.direction());
    if (kind == 3) return std::make_unique<SunLight>(way, white, random.uniform(0.01, 1.7), true);
    const Vec3d x = random.direction(), y = normalize(cross(x, random.direction()));
    return std::make_unique<FlatLight>(FlatLight::Outline::Rectangle, at, toFloat(x) * size,
                                       toFloat(y) * 0.5f, toFloat(normalize(cross(x, y))), white,
                                       kHalfPi, true);
}

} // namespace

// The whole lamp is the mean over 64 x 64 strata of its samples, all of which rise over both
// horizons: a stratum's centre is off by some (1/64)^2 of what the lamp varies by. Lamps nearer
// than a third of their size vary too much for that.
TEST(light_whole_is_the_mean_of_samples) {
    Random random(733);
    constexpr int kSide = 64;
    int known = 0, kinds[3] = {};
    for (int i = 0; i < check::scaled(1500); ++i) {
        const std::unique_ptr<const Light> lamp = someLamp(random);
        const Vec3 p = toFloat(random.inBox(3)), n = toFloat(random.direction());
        const Vec3 ng = toFloat(normalize(toDouble(n) + random.direction() * 0.3));
        const auto whole = lamp->whole(p, n, ng);
        if (!whole) continue;
        double sum = 0, most = 0;
        bool rises = true;
        for (int s = 0; s < kSide * kSide; ++s) {
            const Vec2 u{(static_cast<float>(s % kSide) + 0.5f) / kSide,
                         (static_cast<float>(s / kSide) + 0.5f) / kSide};
            const LightSample sample = lamp->sample(p, u);
            const double cosine = dot(toDouble(sample.toLight), toDouble(n));
            const double light = cosine * static_cast<double>(sample.irradiance.g);
            sum += light, most = std::max(most, light);
            rises = rises && cosine > 0 && dot(sample.toLight, ng) > 0;
        }
        CHECK_INFO(rises, "case " << i << " of seed 733");
        const double mean = sum / (kSide * kSide);
        if (most > 10 * mean) continue;
        const double closed =
            dot(toDouble(whole->toLight), toDouble(n)) * static_cast<double>(whole->irradiance.g);
        CHECK_INFO(std::fabs(closed / mean - 1) < 2e-3,
                   "case " << i << " of seed 733: " << closed << ", mean of samples " << mean);
        CHECK_NEAR(length(whole->toLight), 1, 3e-7);
        ++known, ++kinds[lamp->emission() ? 0 : whole->distance < kInfinityF ? 1 : 2];
    }
    CHECK_INFO(known > check::scaled(200), known);
    for (const int count : kinds) CHECK(count > check::scaled(20));
}

// What has no closed form: spots, mixed attenuation, ellipses, a narrowed spread; and lamps that a
// horizon may cut.
TEST(light_whole_is_not_said_of_others) {
    const Rgb white{1, 1, 1};
    const Vec3 up{0, 0, 1}, at{0, 0, 2};
    const SpotCone cone{{0, 0, -1}, 0.5f, 0, false};
    CHECK(!PointLight(at, white, {}, 0.5f, cone, true).whole({}, up, up));
    CHECK(!PointLight(at, white, {1, 0, 0.1f}, 0.5f, {}, true).whole({}, up, up));
    const auto flat = [&](FlatLight::Outline outline, double spread) {
        return FlatLight(outline, at, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}, white, spread, true);
    };
    CHECK(!flat(FlatLight::Outline::Ellipse, kHalfPi).whole({}, up, up));
    CHECK(!flat(FlatLight::Outline::Rectangle, 1).whole({}, up, up));
    CHECK(flat(FlatLight::Outline::Rectangle, kHalfPi).whole({}, up, up).has_value());
    CHECK(!flat(FlatLight::Outline::Rectangle, kHalfPi).whole({0, 0, 3}, -up, -up)); // behind it
    const PointLight lamp(at, white, {}, 0.5f, {}, true);
    CHECK(lamp.whole({}, up, up).has_value());
    const Vec3 level = normalize(Vec3{1, 0, 0.2f}); // 0.2 * 2 < 0.5
    CHECK(!lamp.whole({}, level, up) && !lamp.whole({}, up, level));
    CHECK(!SunLight({0, 0, -1}, white, 0.3, true).whole({}, level, up));
    CHECK(!SphereLight(at, 0.5f, white, true).whole({}, up, level));
}

// As PointLight::whole() and reflectedLight() have it point by point; points that the lamp can't
// reach are known to be dark.
TEST(whole_lamps_in_lanes_have_the_bits_of_single_points) {
    for (const Isa& kernel : allIsas()) {
        const WholeLightFn inLanes =
            kernel.supported() ? lanesOf(kernel.lamps).wholeLight : nullptr;
        if (!inLanes) continue;
        Random random(80);
        long long lit = 0, dark = 0, unknown = 0, wrong = 0;
        for (int i = 0; i < check::scaled(2000); ++i) {
            const Vec3 at = toFloat(random.direction() * random.logUniform(0.1, 100));
            const Attenuation fade = random.chance(0.4)   ? Attenuation{}
                                     : random.chance(0.8) ? Attenuation{0, 0, 0.5f}
                                                          : Attenuation{0.2f, 0, 0.5f};
            const auto radius = static_cast<float>(random.logUniform(1e-3, 3));
            const PointLight lamp(at, someLight(random, 0.02), fade, radius, {}, true);
            std::vector<Point> points;
            const std::size_t used = random.chance(0.5) ? 1 + random.below(16) : 16;
            for (std::size_t k = 0; k < used; ++k) points.push_back(somePoint(random, at));
            const unsigned asked = random.chance(0.8) ? ~0u : random.below(1u << 16);
            const unsigned unhidden = random.chance(0.5) ? ~0u : random.below(1u << 16);
            WholeLight out;
            const LitBlock block = blockOf(points);
            inLanes(*lamp.emission(), block, block.used & asked, unhidden, out);
            for (std::size_t k = 0; k < LitBlock::kPoints; ++k) {
                const bool isAsked = k < used && (asked >> k & 1) != 0;
                Rgb light;
                bool isKnown = false;
                if (isAsked) {
                    const auto& [s, n, toEye, weight, material] = points[k];
                    isKnown = lamp.cannotReach(s.p, n);
                    auto whole = lamp.whole(s.p, n, s.ng);
                    if (!whole && s.lift != Vec3{}) whole = lamp.whole(s.p, n, s.ns);
                    if (whole && isBlack(material.specular) && (unhidden >> k & 1) != 0)
                        light = weight * reflectedLight(material, n, toEye, whole->toLight) *
                                whole->irradiance;
                    isKnown |= !isBlack(light);
                }
                const bool same = ((out.known >> k & 1) != 0) == isKnown &&
                                  sameBits(taken(out.light, k), {light.r, light.g, light.b});
                ++(!isKnown ? unknown : isBlack(light) ? dark : lit);
                if (!same && ++wrong <= 3)
                    CHECK_INFO(false, kernel.name << " block " << i << " point " << k);
            }
        }
        CHECK_INFO(lit > check::scaled(1000) && dark > check::scaled(5000) &&
                       unknown > check::scaled(5000),
                   kernel.name << ": " << lit << " lit, " << dark << " dark, " << unknown);
        CHECK_EQUAL(wrong, 0);
    }
}

} // namespace test_whole_light
