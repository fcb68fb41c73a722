// Code/image/compare.h: closed forms, and reference values of other implementations.
#include "check.h"

#include "image/colour.h"
#include "image/compare.h"

#include <cmath>
#include <string>

namespace test_compare {

namespace {

Image constant(int width, int height, Rgb value) {
    Image image(width, height);
    for (Rgb& pixel : image.pixels()) pixel = value;
    return image;
}
Rgb fromBytes(int r, int g, int b) {
    return {linearFromSrgb8(static_cast<std::uint8_t>(r)),
            linearFromSrgb8(static_cast<std::uint8_t>(g)),
            linearFromSrgb8(static_cast<std::uint8_t>(b))};
}
// The pair whose reference values stand below.
struct Pair {
    Image a{40, 30}, b{40, 30};
    Pair() {
        for (int y = 0; y < 30; ++y)
            for (int x = 0; x < 40; ++x) {
                const int r = x * 6 % 256, g = y * 8 % 256, blue = (x * 3 + y * 5) % 256;
                const bool isBox = x >= 12 && x < 25 && y >= 10 && y < 20;
                a.setPixel(x, y, fromBytes(r, g, blue));
                b.setPixel(x, y,
                           fromBytes((r + (x * x + y * 7) % 23) % 256, isBox ? 200 : g, blue));
            }
    }
};

} // namespace

TEST(compare_closed_forms) {
    const Image black = constant(4, 3, {}), grey = constant(4, 3, {0.25f, 0.25f, 0.25f});
    CHECK_NEAR(rmse(black, grey), 0.25, 1e-15);
    CHECK_NEAR(mae(black, grey), 0.25, 1e-15);
    CHECK_NEAR(psnr(black, grey), 20 * std::log10(4.0), 1e-12);
    const Image red = constant(4, 3, {0.5f, 0, 0});
    CHECK_NEAR(rmse(black, red), 0.5 / std::sqrt(3.0), 1e-15);
    CHECK_NEAR(mae(black, red), 0.5 / 3, 1e-15);
    CHECK_EQUAL(rmse(red, red), 0.0);
    CHECK(std::isinf(psnr(red, red)) && psnr(red, red) > 0);
    Image onePixel = black;
    onePixel.setPixel(2, 1, {-3, 0, 0}); // negative and large values count as they are
    CHECK_NEAR(rmse(black, onePixel), 3 / std::sqrt(36.0), 1e-15);
}

TEST(compare_ssim_closed_forms) {
    // Constant pictures: only the first factor is left.
    const double c1 = 1e-4, u = 128 / 255.0, v = 64 / 255.0;
    const Image a = constant(20, 15, fromBytes(128, 128, 128));
    const Image b = constant(20, 15, fromBytes(64, 64, 64));
    CHECK_NEAR(ssim(a, b), (2 * u * v + c1) / (u * u + v * v + c1), 1e-6);
    CHECK_NEAR(ssim(a, a), 1, 1e-12);
    CHECK_NEAR(ssim(constant(1, 1, {}), constant(1, 1, {1, 1, 1})), c1 / (1 + c1), 1e-9);
    CHECK_NEAR(ssim(constant(4, 20, {}), constant(4, 20, {})), 1, 1e-12);
}

// Python: numpy, skimage structural_similarity(gaussian_weights=True, sigma=1.5,
// use_sample_covariance=False) of the luma, and NVIDIA's flip_evaluator (float arithmetic).
TEST(compare_reference_values) {
    const Pair pair;
    CHECK_NEAR(rmse(pair.a, pair.b), 0.085273214, 1e-8);
    CHECK_NEAR(mae(pair.a, pair.b), 0.028327208, 1e-8);
    CHECK_NEAR(psnr(pair.a, pair.b), 21.3837474, 1e-6);
    CHECK_NEAR(ssim(pair.a, pair.b), 0.656705281, 1e-6);
    CHECK_NEAR(flip(pair.a, pair.b), 0.2717707, 1e-5);
    CHECK_NEAR(flip(pair.a, pair.b, 20), 0.2364272, 1e-5);
}

TEST(compare_flip_closed_forms) {
    const Image black = constant(8, 8, {}), white = constant(8, 8, {1, 1, 1});
    CHECK_NEAR(flip(white, white), 0, 1e-12);
    CHECK_NEAR(flip(black, white), 0.9673882, 2e-5); // flip_evaluator
    // Green and blue are the farthest colours: the scale's end by definition.
    CHECK_NEAR(flip(constant(8, 8, {0, 1, 0}), constant(8, 8, {0, 0, 1})), 1, 1e-12);
    CHECK_NEAR(flip(constant(8, 8, {0, 5, -1}), constant(8, 8, {0, 0, 7})), 1, 1e-12); // clamped
}

TEST(compare_difference_image) {
    const Image difference =
        differenceImage(constant(2, 2, {0.5f, 0.25f, 1}), constant(2, 2, {0.25f, 0.5f, 1}));
    CHECK((difference.pixel(1, 1) == Rgb{0.25f, 0.25f, 0}));
}

TEST(compare_all_metrics_in_one_table) {
    const Pair pair;
    std::string names;
    for (const Metric& metric : metrics()) {
        names += std::string(metric.name) + " ";
        CHECK(!metric.help.empty());
        const double same = metric.measure(pair.a, pair.a), other = metric.measure(pair.a, pair.b);
        CHECK_INFO(metric.isLargerBetter ? same > other : same < other, metric.name);
        CHECK_THROWS(metric.measure(pair.a, Image(30, 40)),
                     "the pictures differ in size: 40x30 and 30x40");
    }
    CHECK_EQUAL(names, "rmse mae psnr ssim flip ");
    CHECK_THROWS(differenceImage(pair.a, Image(1, 1)), "differ in size: 40x30 and 1x1");
}

} // namespace test_compare
