// The exact mean of checkerboards over footprints.
#include "accel/kernels/kernels.h"
#include "check.h"
#include "texture/box_checker_in_lanes.h"
#include "texture/footprint.h"
#include "verify/meshes.h"

#include <bit>
#include <cmath>

namespace test_box_checker {

using meshes::Random;
using namespace kernels::one;

// Against sums over points: each edge of a square is off by at most a step.
TEST(checker_boxes_are_integrals) {
    Random random(71);
    constexpr int kSteps = 1 << 18;
    for (int round = 0; round < check::scaled(60); ++round) {
        const double x = random.uniform(-50, 50), w = std::exp2(random.uniform(-8, 5));
        double sum = 0;
        for (int i = 0; i < kSteps; ++i) {
            const double at = x + ((i + 0.5) / kSteps - 0.5) * w;
            sum += std::fmod(std::floor(at), 2.0) == 0 ? 1 : -1;
        }
        CHECK_NEAR(boxOfSquareWave(x, w).v, sum / kSteps, 2 * (w + 2) / kSteps);
    }
    for (int round = 0; round < 1000; ++round) {
        const double x = random.uniform(-1e6, 1e6);
        const double point = std::fmod(std::floor(x), 2.0) == 0 ? 1 : -1;
        CHECK_EQUAL(boxOfSquareWave(x, 0.0).v, point);
        const double w = std::exp2(random.uniform(0, 20));
        CHECK(std::fabs(boxOfSquareWave(x, w).v) <= 1 / w + 1e-9);
    }
}

// Ellipses in any direction, long ones among them: the far field is grey, points are as they are.
TEST(checker_footprints_are_means) {
    Random random(72);
    for (int round = 0; round < check::scaled(200); ++round) {
        const Vec2d uv{random.uniform(-9, 9), random.uniform(-9, 9)};
        const double angle = random.uniform(0, 7), length = std::exp2(random.uniform(3, 8));
        const double ratio = random.uniform(1, 16), c = std::cos(angle), s = std::sin(angle);
        const auto vec = [](double x, double y) {
            return Vec2{static_cast<float>(x), static_cast<float>(y)};
        };
        const double across = std::max(length / ratio, 4.0);
        const UvFootprint wide{vec(c * length, s * length), vec(-s * across, c * across)};
        // Each box is at least 2.8 wide along one axis, and 4 / sqrt(2) along the other.
        const auto oddPart = [&](const UvFootprint& over) {
            return oddParts(uv.x, uv.y,
                            {{over.along.x, over.along.y}, {over.across.x, over.across.y}})
                .v;
        };
        CHECK_NEAR(oddPart(wide), 0.5, 0.5 / (2.8 * 2.8));
        const bool isOdd =
            std::fmod(std::floor(uv.x) + std::floor(uv.y), 2.0) != 0;
        CHECK_EQUAL(oddPart({}), isOdd ? 1.0 : 0.0);
    }
}

// Footprints and parts of checkers by the register: each lane has the bits of being alone.
TEST(footprints_in_lanes_have_the_bits_of_single_ones) {
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported()) continue;
        Random random(73);
        int points = 0, grey = 0, wrong = 0;
        for (int round = 0; round < check::scaled(500); ++round) {
            CheckerBlock block, alone;
            const auto number = [&](double most) {
                constexpr double kOdd[] = {0, 1, -1, 1e30, kInfinity};
                return static_cast<float>(random.chance(0.05) ? kOdd[random.below(5)]
                                                              : random.uniform(-most, most));
            };
            const auto vec = [&](double most) {
                const float x = number(most), y = number(most);
                return Vec3{x, y, number(most)};
            };
            const std::size_t count = 1 + random.below(CheckerBlock::kPoints);
            for (std::size_t i = 0; i < count; ++i) {
                const Vec3 normal = random.chance(0.3) ? Vec3{0, 0, 1} : normalize(vec(1));
                const Vec3 dir = random.chance(0.1) ? -normal : normalize(vec(1));
                block.put(i, std::fabs(number(random.chance(0.5) ? 0.1 : 100)), dir, normal);
                block.put(i, {vec(2), vec(2)});
                const Vec3 org = vec(10);
                block.org[0][i] = org.x, block.org[1][i] = org.y, block.org[2][i] = org.z;
                block.t[0][i] = number(20), block.t[1][i] = number(1e-6);
            }
            const AffineRows rows{0.8, 0.1, 0, 3, -0.2, 1.1, 0.3, 0.01, 0, 0.2, 1, 5};
            alone = block;
            kernel.pictures->footprints(block, count);
            kernel.pictures->oddParts(rows, block, count);
            oneLane().pictures->oddParts(rows, alone, count);
            const auto differ = [](float a, float b) {
                return std::bit_cast<std::uint32_t>(a) != std::bit_cast<std::uint32_t>(b);
            };
            for (std::size_t i = 0; i < count; ++i) {
                const auto at = [&](const CheckerBlock::Lane(&v)[3]) {
                    return Vec3{v[0][i], v[1][i], v[2][i]};
                };
                const UvFootprint one = footprintOn(block.width[i], at(block.dir), at(block.normal),
                                                    {at(block.dpdu), at(block.dpdv)});
                points += one.isPoint();
                grey += alone.odd[i] > 0.3f && alone.odd[i] < 0.7f;
                wrong += differ(one.along.x, block.along[0][i]) ||
                         differ(one.along.y, block.along[1][i]) ||
                         differ(one.across.x, block.across[0][i]) ||
                         differ(one.across.y, block.across[1][i]) ||
                         differ(alone.odd[i], block.odd[i]);
            }
        }
        CHECK_INFO(points > 50 && grey > 500, kernel.name << ": " << points << ", " << grey);
        CHECK_EQUAL(wrong, 0);
    }
}

} // namespace test_box_checker
