// Camera rays by the register: every lane has the bits of the one lane.
#include "accel/kernels/kernels.h"
#include "camera/camera_lanes.h"
#include "check.h"
#include "sample/sampler.h"
#include "verify/meshes.h"

#include <bit>
#include <span>
#include <vector>

namespace test_camera_lanes {

using meshes::Random;

namespace {

bool sameBits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
bool sameBits(Vec3 a, Vec3 b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z);
}

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
    if (random.chance(0.3)) params.apertureRadius = 0;
    if (random.chance(0.3)) params.kind = CameraParams::Kind::Orthographic;
    if (random.chance(0.3)) {
        const std::vector<Transform> keys = {
            params.worldFromCamera.at(0),
            Transform::lookAt(random.direction(), random.direction(), random.direction())};
        params.worldFromCamera = MovingTransform(std::span<const Transform>(keys));
    }
    return params;
}

} // namespace

// Cameras are of every kind, with and without a lens, at rest and moving; rays go through all
// places of a block and fewer.
TEST(camera_lanes_have_the_bits_of_single_rays) {
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported()) continue;
        Random random(41);
        long long wrong = 0;
        for (int i = 0; i < check::scaled(3000); ++i) {
            const CameraParams params = someCamera(random);
            const Camera camera(params);
            PlaceBlock block;
            std::vector<float> time;
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
                time.push_back(onGrid());
            }
            const std::size_t count = 1 + random.below(PlaceBlock::kPlaces);
            // One more than there is room for: it has to stay as it is.
            std::vector<Vec3> org(count + 1), dir(count + 1);
            std::vector<float> tMin(count + 1, -1.0f);
            kernel.camera->rays(camera, block,
                                {std::span(org).first(count), std::span(dir).first(count),
                                 std::span(tMin).first(count), std::span(time).first(count)});
            CHECK(org.back() == Vec3{} && dir.back() == Vec3{} && tMin.back() == -1);
            for (std::size_t k = 0; k < count; ++k) {
                const Ray ray =
                    camera.ray({block.x[k], block.y[k]}, {block.u[k], block.v[k]}, time[k]);
                const bool same = sameBits(ray.org, org[k]) && sameBits(ray.dir, dir[k]) &&
                                  sameBits(ray.tMin, tMin[k]);
                if (!same && ++wrong <= 3)
                    CHECK_INFO(false, kernel.name << " camera " << i << " ray " << k << ": lens "
                                                  << block.u[k] << ' ' << block.v[k]);
            }
        }
        CHECK_EQUAL(wrong, 0);
    }
}

TEST(pairs_in_lanes_have_the_bits_of_the_sampler) {
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported()) continue;
        const CameraLanes& lanes = *kernel.camera;
        Random random(42);
        long long wrong = 0;
        for (int i = 0; i < check::scaled(3000); ++i) {
            const bool isZ = i % 2 != 0;
            const int samples = isZ ? 1 << random.below(10) : 16;
            const Sampler sampler(isZ ? SamplerKind::ZSobol : SamplerKind::Sobol, samples,
                                  static_cast<std::uint32_t>(random.below(std::size_t{1} << 32)));
            const auto dimension = static_cast<std::uint32_t>(2 * random.below(100));
            PairBlock block{};
            Vec2 alone[PairBlock::kPairs];
            for (std::size_t k = 0; k < PairBlock::kPairs; ++k) {
                const auto any = static_cast<std::uint32_t>(random.below(std::size_t{1} << 32));
                block.pixel[k] = any, block.sample[k] = any >> random.below(32);
                alone[k] = sampler.get2D(any, block.sample[k], dimension);
            }
            lanes.seedsOf(sampler, dimension, std::span<const std::uint32_t>(block.pixel),
                          {block.index, block.x, block.y});
            lanes.pairsOf(sampler, block, PairBlock::kPairs);
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
        if (!kernel.supported()) continue;
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
            kernel.camera->spread(filter.spread(), pairs, places);
            for (std::size_t k = 0; k < PairBlock::kPairs; ++k) {
                const Vec2 offset = filter.sample(alone[k]);
                wrong += places.x[k] != middles.x[k] + static_cast<double>(offset.x) ||
                         places.y[k] != middles.y[k] + static_cast<double>(offset.y);
            }
        }
        CHECK_INFO(wrong == 0, kernel.name << ": " << wrong);
    }
}

} // namespace test_camera_lanes
