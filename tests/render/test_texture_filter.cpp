// Pictures and checkers as their mean over what a sample stands for.
#include "check.h"
#include "image/compare.h"
#include "shot.h"

#include <cmath>
#include <numbers>

namespace test_texture_filter {

namespace {

// Of a plane up to the horizon, in the upper half of the picture the sky.
std::string horizon(int samples, const std::string& more, const std::string& ground) {
    return "settings {\n resolution 256 128\n samples " + std::to_string(samples) + "\n" + more +
           "}\nworld {\n background 0 0 0\n ambient 1 1 1\n}\ncamera c {\n"
           " look_at 0.3 -5 1  0.1 5 1  0 0 1\n lens 35\n}\n" +
           ground;
}
constexpr const char* kChecker = "material a {\n diffuse 0.9 0.9 0.9\n}\nmaterial b {\n"
                                 " diffuse 0.1 0.1 0.1\n}\n"
                                 "infinite_plane p {\n materials a b\n}\n";

} // namespace

// Rows beyond two squares per pixel along the view: their mean is the mean of both colours. The box
// over w squares leaves up to 1 / w of their contrast: no wave is more than 0.3 / w of the mean, and
// beyond sixteen squares none is more than 1 %.
TEST(far_checker_is_its_mean_at_one_sample) {
    const Image image = shot::render(horizon(1, "jitter false\n", kChecker)).color;
    // A pixel's angle is 36 / 35 / 256; row y sees the distance 1 / slope, and of it two squares or
    // more where angle / slope^2 > 2.
    const double angle = 36.0 / 35 / 256;
    int rows = 0;
    for (int y = 64; y < 128; ++y) {
        const double slope = (y + 0.5 - 64) * angle;
        const double squares = angle / (slope * slope);
        if (squares < 2) break;
        ++rows;
        double mean = 0;
        for (int x = 0; x < 256; ++x) mean += static_cast<double>(image.pixel(x, y).r) / 256;
        CHECK_INFO(std::fabs(mean - 0.5) <= 0.0025, "row " << y << ": mean " << mean);
        for (int wave = 1; wave <= 128; ++wave) {
            double re = 0, im = 0;
            for (int x = 0; x < 256; ++x) {
                const double turn = 2 * std::numbers::pi * wave * x / 256;
                re += static_cast<double>(image.pixel(x, y).r) * std::cos(turn) / 256;
                im += static_cast<double>(image.pixel(x, y).r) * std::sin(turn) / 256;
            }
            CHECK_INFO(std::hypot(re, im) <= (squares < 16 ? 0.3 / squares : 0.01) * mean,
                       "row " << y << ", wave " << wave << ": " << std::hypot(re, im) / mean);
        }
    }
    CHECK(rows >= 8);
    const Image points =
        shot::render(horizon(1, "jitter false\ntexture_filter none\n", kChecker)).color;
    CHECK(static_cast<double>(points.pixel(9, 66).r) != 0.5); // a point is black or white
}

// Squares whose materials can't be mixed, a mirror beside what is dull: each sample has one of
// them, as often as its part says.
TEST(checkers_of_unlike_materials_converge_to_the_same) {
    const std::string ground = "material a {\n diffuse 0.9 0.9 0.9\n}\nmaterial b {\n"
                               " diffuse 0.1 0.1 0.1\n mirror 0.5 0.5 0.5\n}\n"
                               "infinite_plane p {\n materials a b\n}\n";
    const Image reference = shot::render(horizon(1024, "texture_filter none\n", ground)).color;
    const Image some = shot::render(horizon(256, "", ground)).color;
    CHECK_INFO(rmse(some, reference) < 0.01, rmse(some, reference));
}

// At equal samples the error is smaller, and it goes on falling: what is blurred vanishes.
TEST(texture_filter_takes_noise_and_leaves_the_picture) {
    shot::writeTexture("stripes.pfm", 32, 32, [](double u, double v) {
        const float value = std::fmod(std::floor(u * 8) + std::floor(v * 8), 2.0) == 0 ? 1 : 0;
        return Rgb{value, value, value};
    });
    const std::string ground = "texture t {\n file stripes.pfm\n scale 10 40\n}\n"
                               "material m {\n diffuse 1 1 1\n diffuse_texture t\n}\n"
                               "plane p {\n corners -20 -10 0  20 -10 0  20 150 0  -20 150 0\n"
                               " material m\n}\n";
    const Image reference = shot::render(horizon(2048, "texture_filter none\n", ground)).color;
    for (const int samples : {1, 4, 16, 64}) {
        const double points =
            rmse(shot::render(horizon(samples, "texture_filter none\n", ground)).color, reference);
        const double means = rmse(shot::render(horizon(samples, "", ground)).color, reference);
        CHECK_INFO(means < 0.8 * points,
                   samples << " samples: " << means << " instead of " << points);
    }
}

} // namespace test_texture_filter
