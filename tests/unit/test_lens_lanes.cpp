// Camera rays by the register: every lane has the bits of asking the sampler and the camera alone.
#include "accel/kernels/kernels.h"
#include "check.h"
#include "camera/lens_lanes.h"
#include "sample/sampler.h"
#include "sample/warp.h"
#include "verify/meshes.h"

#include <array>
#include <bit>
#include <vector>

namespace test_lens_lanes {

using meshes::Random;

namespace {

bool sameBits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
bool sameBits(Vec3 a, Vec3 b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z);
}

// Rays of the first places of a block, and one behind them that nobody may touch.
struct SomeRays {
    std::size_t count;
    std::vector<Vec3> org = std::vector<Vec3>(count + 1), dir = std::vector<Vec3>(count + 1);
    std::vector<float> tMin = std::vector<float>(count + 1, -1.0f);

    RaySpans spans() {
        return {std::span(org).first(count), std::span(dir).first(count),
                std::span(tMin).first(count)};
    }
    bool isRestUntouched() const {
        return org.back() == Vec3{} && dir.back() == Vec3{} && tMin.back() == -1;
    }
};

CameraParams someCamera(Random& random) {
    CameraParams params;
    params.worldFromCamera = Transform::lookAt(random.direction() * random.logUniform(1e-2, 1e2),
                                               random.direction(), random.direction());
    params.width = 1 + static_cast<int>(random.below(2000));
    params.height = 1 + static_cast<int>(random.below(2000));
    params.lensMm = random.logUniform(5, 500);
    params.shiftX = random.uniform(-1, 1);
    params.clipStart = random.chance(0.5) ? 0 : random.logUniform(1e-3, 1);
    params.apertureRadius = random.logUniform(1e-4, 1);
    params.focusDistance = random.logUniform(1e-2, 1e3);
    params.apertureRatio = random.chance(0.5) ? 1 : random.uniform(0.5, 2);
    if (random.chance(0.4)) params.apertureBlades = static_cast<int>(3 + random.below(6));
    params.apertureRotationRad = random.uniform(-4, 4);
    return params;
}

} // namespace

TEST(lens_lanes_have_the_bits_of_single_rays) {
    for (const Isa& kernel : allIsas()) {
        const auto rays = kernel.supported() ? lanesOf(kernel.camera).rays : nullptr;
        if (!rays) continue;
        Random random(41);
        long long wrong = 0;
        for (int i = 0; i < check::scaled(3000); ++i) {
            const CameraParams params = someCamera(random);
            const Camera camera(params);
            const auto lens = camera.lens();
            CHECK(lens.has_value());
            PlaceBlock block;
            for (std::size_t k = 0; k < PlaceBlock::kPlaces; ++k) {
                block.x[k] = random.uniform(-1, params.width + 1.0);
                block.y[k] = random.uniform(-1, params.height + 1.0);
                // Sobol's grid, or that of other samplers, whose numbers have bits below 2^-24;
                // with the seams of the disk: its centre, sides, and diagonals.
                const bool isSobol = i % 2 == 0;
                const auto onGrid = [&] {
                    return isSobol ? static_cast<float>(random.below(1u << 24)) * 0x1p-24f
                                   : static_cast<float>(random.unit() * 0x0.ffffffp0);
                };
                block.u[k] = random.chance(0.1) ? 0.5f : onGrid();
                block.v[k] = random.chance(0.1)   ? 0.5f
                             : random.chance(0.1) ? block.u[k]
                             : random.chance(0.1) ? 0
                                                  : onGrid();
            }
            SomeRays made{1 + random.below(PlaceBlock::kPlaces)};
            rays(*lens, block, made.spans());
            CHECK(made.isRestUntouched());
            for (std::size_t k = 0; k < made.count; ++k) {
                const Ray ray =
                    camera.ray({block.x[k], block.y[k]}, {block.u[k], block.v[k]}, 0.5f);
                const bool same = sameBits(ray.org, made.org[k]) &&
                                  sameBits(ray.dir, made.dir[k]) &&
                                  sameBits(ray.tMin, made.tMin[k]);
                if (!same && ++wrong <= 3)
                    CHECK_INFO(false, kernel.name << " camera " << i << " ray " << k << ": lens "
                                                  << block.u[k] << ' ' << block.v[k]);
            }
        }
        CHECK_EQUAL(wrong, 0);
    }
}

TEST(pinhole_lanes_have_the_bits_of_single_rays) {
    for (const Isa& kernel : allIsas()) {
        const auto rays = kernel.supported() ? lanesOf(kernel.camera).pinhole : nullptr;
        if (!rays) continue;
        Random random(43);
        long long wrong = 0;
        for (int i = 0; i < check::scaled(1000); ++i) {
            CameraParams params = someCamera(random);
            params.apertureRadius = 0;
            const Camera camera(params);
            const auto pinhole = camera.pinhole();
            CHECK(pinhole.has_value());
            PlaceBlock block{};
            SomeRays made{1 + random.below(PlaceBlock::kPlaces)};
            for (std::size_t k = 0; k < made.count; ++k) {
                block.x[k] = random.uniform(-1, params.width + 1.0);
                block.y[k] = random.uniform(-1, params.height + 1.0);
            }
            RaySpans to = made.spans();
            to.org = {};
            rays(*pinhole, block, to);
            CHECK(made.isRestUntouched());
            for (std::size_t k = 0; k < made.count; ++k) {
                const Ray ray = camera.ray({block.x[k], block.y[k]}, {0.5f, 0.5f}, 0.5f);
                const bool same =
                    sameBits(ray.dir, made.dir[k]) && sameBits(ray.tMin, made.tMin[k]);
                if (!same && ++wrong <= 3)
                    CHECK_INFO(false, kernel.name << " camera " << i << " ray " << k << " of "
                                                  << made.count);
            }
        }
        CHECK_EQUAL(wrong, 0);
    }
}

TEST(only_cameras_whose_rays_start_in_one_point_are_pinholes) {
    CameraParams params;
    CHECK(Camera(params).pinhole().has_value());
    params.kind = CameraParams::Kind::Orthographic;
    CHECK(!Camera(params).pinhole().has_value());
    params.kind = CameraParams::Kind::Perspective;
    params.apertureRadius = 1;
    CHECK(!Camera(params).pinhole().has_value());
}

// Lanes reckon places on the disk less exactly and have to notice where that might show: in units
// of 2^-24, some of the few in a million where it does.
TEST(places_on_the_lens_in_lanes_round_as_single_ones) {
    constexpr std::array<std::array<std::uint32_t, 2>, 10> kHard = {{{3300455, 3231371},
                                                                     {8225380, 1747078},
                                                                     {9725976, 5417801},
                                                                     {469998, 11825283},
                                                                     {7137532, 2204322},
                                                                     {9766350, 10664176},
                                                                     {7473108, 11741567},
                                                                     {5916949, 4693849},
                                                                     {10358357, 14129310},
                                                                     {12186846, 3901933}}};
    CameraParams params; // from the origin through a lens of radius 1
    params.apertureRadius = 1;
    const Camera camera(params);
    const auto lens = camera.lens();
    for (const Isa& kernel : allIsas()) {
        const auto rays = kernel.supported() ? lanesOf(kernel.camera).rays : nullptr;
        if (!rays) continue;
        Random random(43);
        for (int i = 0; i < check::scaled(300); ++i) {
            PlaceBlock block{};
            for (std::size_t k = 0; k < PlaceBlock::kPlaces; ++k) {
                const auto& [u, v] = kHard[random.below(kHard.size())];
                const bool isHard = random.chance(0.1);
                const auto number = [&](std::uint32_t hard) {
                    const auto bits = isHard ? hard : random.below(1u << 24);
                    return static_cast<float>(bits) * 0x1p-24f;
                };
                block.u[k] = number(u), block.v[k] = number(v);
            }
            SomeRays made{PlaceBlock::kPlaces};
            rays(*lens, block, made.spans());
            for (std::size_t k = 0; k < made.count; ++k) {
                const Vec2 place = diskFromSquare({block.u[k], block.v[k]});
                CHECK_INFO(sameBits({place.x, place.y, 0}, made.org[k]),
                           kernel.name << ": place " << block.u[k] * 0x1p24f << ' '
                                       << block.v[k] * 0x1p24f);
            }
        }
    }
}

TEST(pairs_in_lanes_have_the_bits_of_the_sampler) {
    for (const Isa& kernel : allIsas()) {
        const CameraLanes lanes = kernel.supported() ? lanesOf(kernel.camera) : CameraLanes{};
        if (!lanes.pairs) continue;
        Random random(42);
        long long wrong = 0;
        for (int i = 0; i < check::scaled(3000); ++i) {
            const Sampler sampler(SamplerKind::Sobol, 16,
                                  static_cast<std::uint32_t>(random.below(std::size_t{1} << 32)));
            const auto dimension = static_cast<std::uint32_t>(2 * random.below(100));
            PairBlock block{};
            Vec2 alone[PairBlock::kPairs];
            for (std::size_t k = 0; k < PairBlock::kPairs; ++k) {
                const auto any = static_cast<std::uint32_t>(random.below(std::size_t{1} << 32));
                block.pixel[k] = any, block.sample[k] = any >> random.below(32);
                alone[k] = sampler.get2D(any, block.sample[k], dimension);
            }
            lanes.seeds(sampler.seed(), dimension, std::span<const std::uint32_t>(block.pixel),
                        {block.index, block.x, block.y});
            lanes.pairs(block, PairBlock::kPairs);
            for (std::size_t k = 0; k < PairBlock::kPairs; ++k)
                if ((!sameBits(alone[k].x, block.u[k]) || !sameBits(alone[k].y, block.v[k])) &&
                    ++wrong <= 3)
                    CHECK_INFO(false,
                               kernel.name << " block " << i << " sample " << block.sample[k]);
        }
        CHECK_EQUAL(wrong, 0);
    }
}

TEST(places_in_lanes_have_the_bits_of_the_filter) {
    constexpr FilterKind kKinds[] = {FilterKind::Box, FilterKind::Tent, FilterKind::Gaussian,
                                     FilterKind::BlackmanHarris};
    for (const Isa& kernel : allIsas()) {
        const auto spread = kernel.supported() ? lanesOf(kernel.camera).spread : nullptr;
        if (!spread) continue;
        Random random(44);
        long long wrong = 0;
        for (int i = 0; i < check::scaled(600); ++i) {
            const Filter filter(kKinds[i % 4], i % 5 == 0 ? 1.5 : random.logUniform(0.01, 50));
            PairBlock pairs{};
            PlaceBlock places{};
            std::vector<Vec2> alone;
            for (std::size_t k = 0; k < PairBlock::kPairs; ++k) {
                // The ends and the middle, too, and numbers of samplers other than Sobol's.
                const auto number = [&] {
                    const double kind = random.unit();
                    if (kind > 0.5) return static_cast<float>(random.unit() * 0x0.ffffffp0);
                    const std::uint32_t bits = kind < 0.05   ? 0
                                               : kind < 0.1  ? (1u << 24) - 1
                                               : kind < 0.15 ? (1u << 23) + random.below(3) - 1
                                                             : random.below(1u << 24);
                    return static_cast<float>(bits) * 0x1p-24f;
                };
                alone.push_back({number(), number()});
                pairs.u[k] = alone[k].x, pairs.v[k] = alone[k].y;
                places.x[k] = random.uniform(-1, 2000), places.y[k] = random.uniform(-1, 2000);
            }
            const PlaceBlock middles = places;
            spread(filter.spread(), pairs, places);
            filter.sample(alone);
            for (std::size_t k = 0; k < PairBlock::kPairs; ++k)
                wrong += places.x[k] != middles.x[k] + alone[k].x ||
                         places.y[k] != middles.y[k] + alone[k].y;
        }
        CHECK_INFO(wrong == 0, kernel.name << ": " << wrong);
    }
}

// What lanes can't do they are not asked for.
TEST(lens_lanes_are_for_lenses_at_rest) {
    CameraParams params;
    CHECK(!Camera(params).lens()); // a pinhole
    params.apertureRadius = 0.1;
    CHECK(Camera(params).lens().has_value());
    params.apertureBlades = 2; // fewer than 3 make no polygon
    const auto bladesOf = [](const CameraParams& of) { return Camera(of).lens().value().blades; };
    CHECK_EQUAL(bladesOf(params), 0);
    params.apertureBlades = 5;
    CHECK_EQUAL(bladesOf(params), 5);
    params.kind = CameraParams::Kind::Orthographic;
    CHECK(!Camera(params).lens());
    CHECK(oneLane().camera == nullptr);
}

} // namespace test_lens_lanes
