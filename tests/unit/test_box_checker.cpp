// The exact mean of checkerboards over footprints.
#include "check.h"
#include "texture/box_checker.h"
#include "verify/meshes.h"

#include <cmath>

namespace test_box_checker {

using meshes::Random;

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
        CHECK_NEAR(boxOfSquareWave(x, w), sum / kSteps, 2 * (w + 2) / kSteps);
    }
    for (int round = 0; round < 1000; ++round) {
        const double x = random.uniform(-1e6, 1e6);
        const double point = std::fmod(std::floor(x), 2.0) == 0 ? 1 : -1;
        CHECK_EQUAL(boxOfSquareWave(x, 0), point);
        const double w = std::exp2(random.uniform(0, 20));
        CHECK(std::fabs(boxOfSquareWave(x, w)) <= 1 / w + 1e-9);
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
        CHECK_NEAR(oddPart(uv, wide), 0.5, 0.5 / (2.8 * 2.8));
        const bool isOdd =
            std::fmod(std::floor(uv.x) + std::floor(uv.y), 2.0) != 0;
        CHECK_EQUAL(oddPart(uv, {}), isOdd ? 1.0 : 0.0);
    }
}

} // namespace test_box_checker
