// Light by the register: every lane has the bits of asking the lamp, the material and the shadow
// ray for its point alone.
#include "check.h"
#include "light/area_light.h"
#include "light/point_light.h"
#include "light/sun_light.h"
#include "lit_kit.h"
#include "render/lamp_ray.h"
#include "render/occluders.h"
#include "render/shading.h"
#include "sample/hash.h"
#include "sample/sampler.h"
#include "sample/sobol.h"
#include "sample/warp.h"
#include "verify/meshes.h"

#include <array>
#include <bit>
#include <cstring>
#include <memory>

namespace test_lamp_lanes {

using namespace litkit;

namespace {

std::optional<SpotCone> someCone(Random& random, Vec3 at) {
    if (random.chance(0.5)) return {};
    SpotCone cone;
    cone.axis = random.chance(0.5) ? toFloat(random.direction()) // or towards the points
                                   : toFloat(normalize(-toDouble(at)));
    cone.cosHalfAngle = static_cast<float>(random.uniform(-0.5, 1));
    cone.blend = random.chance(0.3) ? 0 : static_cast<float>(random.unit());
    cone.cosineFalloff = random.chance(0.5);
    return cone;
}

Attenuation someFade(Random& random) {
    if (random.chance(0.5)) return {};
    return {0.2f, 0.3f, random.chance(0.5) ? 0.5f : 0};
}

std::unique_ptr<Light> someSoftLamp(Random& random, Vec3 at) {
    const Rgb power = someLight(random, 0.02);
    const auto size = static_cast<float>(random.logUniform(1e-3, 3));
    const Vec3 away = toFloat(random.chance(0.8) ? normalize(-toDouble(at)) : random.direction());
    switch (random.below(4)) {
    case 0:
        return std::make_unique<PointLight>(at, power, someFade(random), size, someCone(random, at),
                                            true);
    case 1: {
        const double angle =
            random.chance(0.1) ? random.uniform(1, kPi) : random.logUniform(1e-8, 1);
        return std::make_unique<SunLight>(away, power, angle, true);
    }
    case 2: {
        const Frame frame = frameAround(away);
        const double spread = random.chance(0.5) ? kHalfPi : random.uniform(0.01, 1.5);
        return std::make_unique<FlatLight>(
            random.chance(0.5) ? FlatLight::Outline::Rectangle : FlatLight::Outline::Ellipse, at,
            frame.x * size, frame.y * static_cast<float>(random.logUniform(1e-3, 3)), away, power,
            spread, true);
    }
    default: break;
    }
    return std::make_unique<SphereLight>(at, size, power, true);
}

} // namespace

TEST(lamp_lanes_have_the_bits_of_single_points) {
    for (const Isa& kernel : allIsas()) {
        const LightByLampFn inLanes = kernel.supported() ? lanesOf(kernel.lamps).byLamp : nullptr;
        if (!inLanes) continue;
        Random random(77);
        long long asked = 0, lit = 0, highlights = 0, wrong = 0;
        for (int i = 0; i < check::scaled(3000); ++i) {
            const Vec3 at = toFloat(random.direction() * random.logUniform(0.1, 100));
            const double kind = random.unit();
            const Attenuation fade = kind < 0.6   ? Attenuation{}
                                     : kind < 0.8 ? Attenuation{0.2f, 0.3f, 0.5f}
                                                  : Attenuation{0, 0, 1};
            const float radius = random.chance(0.2) ? 0.3f : 0;
            const PointLight lamp(at, someLight(random, 0.02), fade, radius, someCone(random, at),
                                  true);
            const auto emission = lamp.emission();
            CHECK(emission.has_value());
            std::vector<Point> points;
            const std::size_t count = random.chance(0.3) ? 1 + random.below(16) : 16;
            for (std::size_t k = 0; k < count; ++k) points.push_back(somePoint(random, at));
            const LitBlock block = blockOf(points);
            LitByLamp out;
            inLanes(*emission, block, ~0u, out);
            CHECK_INFO((out.lit & ~block.used) == 0, kernel.name << " block " << i);
            for (std::size_t k = 0; k < count; ++k) {
                const Point& p = points[k];
                LightSample sample;
                Rgb light;
                const bool isBlocked =
                    !lamp.shine(p.surface.p, p.n, sample) || isBlack(sample.irradiance) ||
                    !(dot(p.surface.ng, sample.toLight) > 0 ||
                      (p.surface.lift != Vec3{} && dot(p.surface.ns, sample.toLight) > 0));
                if (!isBlocked)
                    light = p.weight * reflectedLight(p.material, p.n, p.toEye, sample.toLight) *
                            sample.irradiance;
                const bool isLit = (out.lit >> k & 1) != 0;
                bool same = isLit == !isBlack(light);
                if (same && isLit) {
                    const Ray ray = rayFromLamp(p.surface, p.surface.ng, at, 0);
                    same = sameBits(taken(out.light, k), {light.r, light.g, light.b}) &&
                           sameBits(taken(out.dir, k), ray.dir) && sameBits(out.tMax[k], ray.tMax);
                    highlights += !isBlack(p.material.specular);
                }
                ++asked, lit += isLit;
                if (!same && ++wrong <= 3)
                    CHECK_INFO(false, kernel.name << " block " << i << " point " << k << ": lit "
                                                  << isLit << ", light " << light.r);
            }
        }
        std::printf("%s: %lld points, %lld lit, %lld of them shiny\n", kernel.name, asked, lit,
                    highlights);
        CHECK_INFO(lit > asked / 8 && highlights > asked / 20, kernel.name);
        CHECK_EQUAL(wrong, 0);
    }
}

namespace {

struct Rays {
    static constexpr std::size_t kRoom = LitBySamples::kRoom + LitBlock::kPoints;
    std::vector<Vec3> org = std::vector<Vec3>(kRoom), dir = org;
    std::vector<float> tMax = std::vector<float>(kRoom);
    std::vector<std::uint32_t> sum = std::vector<std::uint32_t>(kRoom);
    std::vector<Rgb> weight = std::vector<Rgb>(kRoom);
    ShadowRayPlaces places() {
        return {org.data(), dir.data(), tMax.data(), sum.data(), weight.data()};
    }
};

// What a sample of the lamp sends from the point to the eye; black: nothing.
Rgb lightOf(const Light& lamp, const Point& p, const LightSample& sample, float share) {
    if (lamp.cannotReach(p.surface.p, p.n) || isBlack(sample.irradiance)) return {};
    const bool rises = dot(p.surface.ng, sample.toLight) > 0 ||
                       (p.surface.lift != Vec3{} && dot(p.surface.ns, sample.toLight) > 0);
    if (!rises) return {};
    return p.weight * reflectedLight(p.material, p.n, p.toEye, sample.toLight) * sample.irradiance *
           share;
}

} // namespace

TEST(lamp_samples_in_lanes_have_the_bits_of_single_samples) {
    for (const Isa& kernel : allIsas()) {
        const LightBySamplesFn inLanes =
            kernel.supported() ? lanesOf(kernel.lamps).bySamples : nullptr;
        if (!inLanes) continue;
        Random random(78);
        long long asked = 0, lit = 0, wrong = 0;
        for (int i = 0; i < check::scaled(1500); ++i) {
            const Vec3 at = toFloat(random.direction() * random.logUniform(0.1, 100));
            const std::unique_ptr<Light> made = someSoftLamp(random, at);
            const Light& lamp = *made;
            const bool inCentre = random.chance(0.3) && lamp.lampEmission(true);
            std::vector<Point> points;
            const std::size_t used = random.chance(0.5) ? 1 + random.below(16) : 16;
            for (std::size_t k = 0; k < used; ++k) points.push_back(somePoint(random, at));
            const Sampler sampler =
                Sampler(SamplerKind::Sobol, 4, random.below(std::size_t{1} << 32))
                    .stream(random.below(4), 16);
            SamplesOnLamp samples;
            samples.points = random.chance(0.8) ? ~0u : random.below(1u << 16);
            samples.count = inCentre             ? 1
                            : random.chance(0.4) ? LitBySamples::kMost
                            : random.chance(0.2) ? 8
                                                 : 1 + random.below(16);
            samples.share = 1.0f / static_cast<float>(samples.count);
            std::uint32_t pixel[16], dimension = 8 * random.below(3);
            // Samples in step differ from each other in the lower four bits only.
            const std::uint32_t step = random.chance(0.5) ? 1 : random.chance(0.5) ? 8 : 16;
            for (std::size_t k = 0; k < used; ++k) {
                pixel[k] = random.below(std::size_t{1} << 32);
                samples.first[k] = step * random.below(1000);
                const Sampler::PairSeeds seeds = sampler.pairSeeds(pixel[k], dimension);
                samples.index[k] = seeds.index, samples.x[k] = seeds.x, samples.y[k] = seeds.y;
            }
            // Points with rays, and points with sums that begin with the lamp before.
            const unsigned withRays = random.below(1u << 16);
            LitBySamples out;
            Rgb sums[16];
            for (std::size_t k = 0; k < used; ++k) {
                sums[k] = someLight(random, 0.5);
                put(out.sum, k, {sums[k].r, sums[k].g, sums[k].b});
            }
            HiddenPoints hidden;
            hidden.maybe = withRays;
            Rays rays;
            out.to = rays.places(), out.firstSum = 32;
            inLanes(*lamp.lampEmission(inCentre), blockOf(points), samples, Occluders(ShapeSet()),
                    hidden, out);
            const auto tell = [&](std::size_t k, std::size_t s) {
                if (++wrong <= 3)
                    CHECK_INFO(false, kernel.name << " block " << i << " point " << k << " sample "
                                                  << s << " of " << samples.count << ", lamp "
                                                  << lamp.lampEmission(inCentre)->index());
            };
            std::array<std::vector<std::size_t>, 16> sent; // of each point, in order
            for (std::size_t r = 0; r < out.rays; ++r) sent[rays.sum[r] - 32].push_back(r);
            for (std::size_t k = 0; k < used; ++k) {
                const Point& p = points[k];
                const bool hasRays = (withRays >> k & 1) != 0;
                std::size_t next = 0;
                for (std::size_t s = 0; s < samples.count; ++s) {
                    const std::uint32_t number = samples.first[k] + static_cast<std::uint32_t>(s);
                    const Vec2 place = sampler.get2D(pixel[k], number, dimension);
                    const LightSample sample =
                        inCentre ? lamp.centre(p.surface.p) : lamp.sample(p.surface.p, place);
                    const bool isAsked = (samples.points >> k & 1) != 0;
                    const Rgb light = isAsked ? lightOf(lamp, p, sample, samples.share) : Rgb{};
                    ++asked, lit += !isBlack(light);
                    if (!hasRays) sums[k] += light;
                    if (!hasRays || isBlack(light)) continue;
                    const bool isThere = next < sent[k].size();
                    const std::size_t r = isThere ? sent[k][next++] : 0;
                    const Vec3 org = leave(p.surface, p.surface.ng) + p.surface.lift;
                    const Rgb weight = rays.weight[r];
                    if (!isThere ||
                        !sameBits({weight.r, weight.g, weight.b}, {light.r, light.g, light.b}) ||
                        !sameBits(rays.org[r], org) || !sameBits(rays.dir[r], sample.toLight) ||
                        !sameBits(rays.tMax[r], sample.distance * (1 - 0x1p-20f)))
                        tell(k, s);
                }
                if (next != sent[k].size() ||
                    !sameBits(taken(out.sum, k), {sums[k].r, sums[k].g, sums[k].b}))
                    tell(k, samples.count);
            }
        }
        std::printf("%s: %lld samples, %lld lit\n", kernel.name, asked, lit);
        CHECK_INFO(lit > asked / 8, kernel.name);
        CHECK_EQUAL(wrong, 0);
    }
}

// Sobol numbers in the middle of the square, with a half, and on both diagonals: there the disk has
// other ways.
TEST(lamp_samples_in_lanes_take_the_seams_of_the_disk) {
    Random random(79);
    const Vec3 at{0, 0, 3};
    const PointLight lamp(at, {1, 1, 1}, {}, 1, {}, true);
    struct Seam {
        std::uint32_t sample, x, y; // number and seeds
    };
    for (const auto& [sample, x, y] : {Seam{0, 48784392, 12573123}, Seam{3323653, 2, 3},
                                       Seam{17871133, 2, 3}, Seam{26008033, 2, 3}}) {
        for (const Isa& kernel : allIsas()) {
            const LightBySamplesFn inLanes =
                kernel.supported() ? lanesOf(kernel.lamps).bySamples : nullptr;
            if (!inLanes) continue;
            Point point = somePoint(random, at);
            point.surface.p = {0.25f, 0.5f, 0}, point.surface.ng = point.n = {0, 0, 1};
            point.surface.lift = {}, point.weight = {1, 1, 1};
            point.material = {};
            SamplesOnLamp samples;
            samples.count = samples.points = 1;
            samples.index[0] = 1, samples.x[0] = x, samples.y[0] = y, samples.first[0] = sample;
            const kernels::one::Pair<std::uint32_t> bits =
                kernels::one::sobolPair<std::uint32_t>(sample, 1, x, y);
            const Vec2 u{unitFloat(bits.x), unitFloat(bits.y)};
            CHECK_INFO(u.x == 0.5f || u.y == 0.5f || u.x == u.y || u.x + u.y == 1, sample);
            LitBySamples out;
            HiddenPoints hidden;
            hidden.maybe = 1;
            Rays rays;
            out.to = rays.places();
            inLanes(*lamp.lampEmission(false), blockOf({point}), samples, Occluders(ShapeSet()),
                    hidden, out);
            const LightSample alone = lamp.sample(point.surface.p, u);
            CHECK_INFO(out.rays == 1 && sameBits(rays.dir[0], alone.toLight),
                       kernel.name << " sample " << sample);
        }
    }
}

TEST(lamps_for_lanes) {
    const SpotCone cone{{0, 0, -1}, 0.5f, 0, false};
    CHECK(PointLight({}, {1, 1, 1}, {}, 0, cone, true).emission()->cone.has_value());
    CHECK(!PointLight({}, {1, 1, 1}, {}, 0, {}, true).lampEmission(false));
    CHECK(!SunLight({0, 0, -1}, {1, 1, 1}, 0, true).lampEmission(false));
    CHECK(SunLight({0, 0, -1}, {1, 1, 1}, 0, true).lampEmission(true).has_value());
    CHECK(!SphereLight({}, 1, {1, 1, 1}, true).lampEmission(true));
    // Too small for what lanes know of rounding.
    CHECK(!SunLight({0, 0, -1}, {1, 1, 1}, 1e-10, true).lampEmission(false));
    CHECK(SunLight({0, 0, -1}, {1, 1, 1}, 1e-8, true).lampEmission(false).has_value());
    CHECK(oneLane().lamps == nullptr);
    CHECK(oneLane().lamps == nullptr);
}

} // namespace test_lamp_lanes
