// denoise(): noise falls, edges and outliers are treated as they should be, and the error that is
// told is the true one.
#include "check.h"
#include "denoise/denoise.h"
#include "verify/meshes.h"

#include <cmath>

namespace test_denoise {

using meshes::Random;

namespace {

constexpr int kWidth = 70, kHeight = 50; // no whole registers
using Halves = std::array<HalfPicture, 2>;

double normal(Random& random) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += random.unit();
    return sum;
}

// Parts of a picture with normal noise, so that the mean of all has the deviation `sigma`.
template <class TruthFn> Halves noisy(std::uint64_t seed, double sigma, const TruthFn& truth) {
    Random random(seed);
    Halves halves;
    for (HalfPicture& half : halves)
        for (PartPicture& part : half) {
            part = {Image(kWidth, kHeight), Image(kWidth, kHeight), Image(kWidth, kHeight)};
            for (int y = 0; y < kHeight; ++y)
                for (int x = 0; x < kWidth; ++x) {
                    const auto value = [&] {
                        return static_cast<float>(truth(x, y) + 2 * sigma * normal(random));
                    };
                    const float r = value(), g = value(), b = value();
                    part.color.setPixel(x, y, {r, g, b});
                    part.albedo.setPixel(x, y, {0.5f, 0.5f, 0.5f});
                    part.normal.setPixel(x, y, {0, 0, 1});
                }
        }
    return halves;
}

Denoised denoised(const Halves& halves) { return denoise(halves, 1e6f, bestIsa(), 2); }

template <class TruthFn> double meanSquare(const Image& image, const TruthFn& truth) {
    double sum = 0;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const Rgb c = image.pixel(x, y);
            for (const float v : {c.r, c.g, c.b})
                sum += sqr(static_cast<double>(v) - truth(x, y));
        }
    return sum / (3.0 * kWidth * kHeight);
}

double meanOf(const Image& image) {
    double sum = 0;
    for (const Rgb c : image.pixels()) sum += static_cast<double>(c.r + c.g + c.b);
    return sum / (3.0 * kWidth * kHeight);
}

double edge(int x, int /*y*/) { return x < kWidth / 2 ? 1 : 2; }

} // namespace

TEST(denoised_constant_loses_its_noise) {
    const auto one = [](int, int) { return 1.0; };
    const double left = meanSquare(denoised(noisy(1, 0.1, one)).color, one);
    CHECK_INFO(left < 0.01 / 12, "variance " << left << " of 0.01");
}

TEST(denoised_picture_without_noise_stays) {
    const Halves halves = noisy(1, 0, [](int x, int y) { return 0.01 * x * y; });
    const Denoised out = denoised(halves);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            CHECK_NEAR(out.color.pixel(x, y).g, halves[0][0].color.pixel(x, y).g,
                       1e-5f * (1 + halves[0][0].color.pixel(x, y).g));
}

// An edge of ten deviations: what is on the one side is not seen on the other.
TEST(denoised_edge_stays) {
    const Image out = denoised(noisy(2, 0.1, edge)).color;
    for (const int x : {kWidth / 2 - 2, kWidth / 2 - 1, kWidth / 2, kWidth / 2 + 1}) {
        double mean = 0;
        for (int y = 0; y < kHeight; ++y)
            mean += static_cast<double>(out.pixel(x, y).r) / kHeight;
        CHECK_NEAR(mean, edge(x, 0), 0.05);
    }
    CHECK(meanSquare(out, edge) < 0.01 / 8);
}

// A texture that the albedo shows stays, however noisy the light on it.
TEST(denoised_texture_stays) {
    const auto texture = [](int x, int y) { return (x / 2 + y / 2) % 2 == 0 ? 0.2 : 0.6; };
    Halves halves = noisy(3, 0.1, texture);
    for (HalfPicture& half : halves)
        for (PartPicture& part : half)
            for (int y = 0; y < kHeight; ++y)
                for (int x = 0; x < kWidth; ++x) {
                    const auto a = static_cast<float>(texture(x, y));
                    part.albedo.setPixel(x, y, {a, a, a});
                }
    const double left = meanSquare(denoised(halves).color, texture);
    CHECK_INFO(left < 0.01 / 3, "variance " << left << " of 0.01");
}

// One sample of 1000: its pixel becomes as those around it, which stay as they were.
TEST(denoised_firefly_is_gone) {
    const auto one = [](int, int) { return 1.0; };
    Halves halves = noisy(4, 0.02, one);
    halves[0][1].color.setPixel(30, 20, {1000, 1000, 1000});
    const Image out = denoised(halves).color;
    for (int y = 5; y < 36; ++y)
        for (int x = 15; x < 46; ++x) CHECK_NEAR(out.pixel(x, y).r, 1, x == 30 && y == 20 ? 2 : 0.1);
}

TEST(denoised_error_is_the_true_one) {
    const auto smooth = [](int x, int y) { return 1 + 0.3 * std::sin(0.2 * x) * std::cos(0.15 * y); };
    const auto compare = [](const char* name, double sigma, const auto& truth) {
        double told = 0, real = 0;
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            const Denoised out = denoised(noisy(seed, sigma, truth));
            told += meanOf(out.squaredError) / 8, real += meanSquare(out.color, truth) / 8;
        }
        CHECK_INFO(told > 0.8 * real && told < 1.2 * real,
                   name << ", noise " << sigma << ": told " << told << ", is " << real);
        CHECK_INFO(real < 0.5 * sigma * sigma, name << ": " << real);
    };
    compare("smooth", 0.05, smooth);
    compare("smooth", 0.2, smooth);
    compare("edge", 0.2, edge);
}

TEST(denoised_pictures_have_the_same_bits) {
    Halves halves = noisy(5, 0.2, edge);
    halves[1][0].color.setPixel(12, 8, {1e30f, 3, -1e20f});
    const Denoised expected = denoise(halves, 3, oneLane(), 1);
    for (const Isa& isa : allIsas())
        if (isa.supported())
            for (const int threads : {1, 3}) {
                const Denoised out = denoise(halves, 3, isa, threads);
                CHECK_INFO(out.color == expected.color, isa.name << ", threads " << threads);
                CHECK_INFO(out.squaredError == expected.squaredError, isa.name);
            }
}

TEST(denoised_pictures_may_be_small) {
    for (const auto& [width, height] : {std::array{1, 1}, std::array{1, 9}, std::array{5, 1}}) {
        Halves halves;
        for (HalfPicture& half : halves)
            for (PartPicture& part : half) {
                part = {Image(width, height), Image(width, height), Image(width, height)};
                for (Rgb& pixel : part.color.pixels()) pixel = {0.25f, 0.5f, 2};
            }
        const Denoised out = denoise(halves, 3, bestIsa(), 2);
        for (const Rgb& pixel : out.color.pixels())
            CHECK(std::fabs(pixel.g - 0.5f) < 1e-6f && std::fabs(pixel.b - 2) < 1e-6f);
    }
}

} // namespace test_denoise
