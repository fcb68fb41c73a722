// denoise(): noise falls, edges and outliers are treated as they should be, and the error that is
// told is the true one.
#include "check.h"
#include "render/denoised.h"
#include "verify/meshes.h"

#include <cmath>

namespace test_denoise {

using meshes::Random;

namespace {

constexpr int kWidth = 70, kHeight = 50; // no whole registers
using Filtered = std::array<Image, 2>;

double normal(Random& random) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += random.unit();
    return sum;
}

HalvedImage blank(int width, int height) { return {Image(width, height), Image(width, height)}; }
HalvedPicture blankPicture(int width, int height) {
    return {blank(width, height), blank(width, height), blank(width, height)};
}

void setHalves(HalvedImage& image, int x, int y, Rgb first, Rgb second) {
    image.mean.setPixel(x, y, (first + second) * 0.5f);
    image.difference.setPixel(x, y, (first - second) * 0.5f);
}

// A picture with normal noise, so that the mean of both halves has the deviation `sigma`.
template <class TruthFn> HalvedPicture noisy(std::uint64_t seed, double sigma, const TruthFn& truth) {
    Random random(seed);
    HalvedPicture picture = blankPicture(kWidth, kHeight);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const auto value = [&] {
                return static_cast<float>(truth(x, y) + std::sqrt(2.0) * sigma * normal(random));
            };
            const auto color = [&] {
                const float r = value(), g = value(), b = value();
                return Rgb{r, g, b};
            };
            const Rgb first = color(), second = color();
            setHalves(picture.color, x, y, first, second);
            picture.albedo.mean.setPixel(x, y, {0.5f, 0.5f, 0.5f});
            picture.normal.mean.setPixel(x, y, {0, 0, 1});
        }
    return picture;
}

Image meanOf(const Filtered& halves) {
    Image mean(halves[0].width(), halves[0].height());
    for (std::size_t i = 0; i < mean.pixels().size(); ++i)
        mean.pixels()[i] = (halves[0].pixels()[i] + halves[1].pixels()[i]) * 0.5f;
    return mean;
}
Image denoised(const HalvedPicture& picture) { return meanOf(denoise(picture, bestIsa(), 2)); }

const ErrorMeasure kLinear{ErrorUnit::Linear, 1, SettingsDesc::Transfer::Srgb};

DenoisedPicture blended(const HalvedPicture& picture, const Isa& isa = bestIsa(), int threads = 2) {
    Image past(picture.color.mean.width(), picture.color.mean.height());
    for (std::size_t i = 0; i < past.pixels().size(); ++i) {
        const Rgb d = picture.color.difference.pixels()[i];
        const float square = d.r * d.r + d.g * d.g + d.b * d.b;
        past.pixels()[i] = {square, 4 * square, 0}; // as of independent samples
    }
    return denoisedPicture(picture, past, kLinear, isa, threads);
}

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

double edge(int x, int /*y*/) { return x < kWidth / 2 ? 1 : 2; }
double tiles(int x, int y) { return (x / 2 + y / 2) % 2 == 0 ? 0.2 : 0.6; }

} // namespace

TEST(denoised_constant_loses_its_noise) {
    const auto one = [](int, int) { return 1.0; };
    const double left = meanSquare(denoised(noisy(1, 0.1, one)), one);
    CHECK_INFO(left < 0.01 / 12, "variance " << left << " of 0.01");
}

TEST(denoised_picture_without_noise_stays) {
    const HalvedPicture picture = noisy(1, 0, [](int x, int y) { return 0.01 * x * y; });
    const Image out = denoised(picture);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            CHECK_NEAR(out.pixel(x, y).g, picture.color.mean.pixel(x, y).g,
                       1e-5f * (1 + picture.color.mean.pixel(x, y).g));
    CHECK_EQUAL(blended(picture).error, 0.0);
}

// An edge of ten deviations: what is on the one side is not seen on the other.
TEST(denoised_edge_stays) {
    const Image out = denoised(noisy(2, 0.1, edge));
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
    HalvedPicture picture = noisy(3, 0.1, tiles);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const auto a = static_cast<float>(tiles(x, y));
            picture.albedo.mean.setPixel(x, y, {a, a, a});
        }
    const double left = meanSquare(denoised(picture), tiles);
    CHECK_INFO(left < 0.01 / 3, "variance " << left << " of 0.01");
}

// One sample of 1000: its pixel becomes as those around it, which stay as they were.
TEST(denoised_firefly_is_gone) {
    const auto one = [](int, int) { return 1.0; };
    HalvedPicture picture = noisy(4, 0.02, one);
    setHalves(picture.color, 30, 20, {1, 1, 1}, {1000, 1000, 1000});
    const Image out = denoised(picture);
    for (int y = 5; y < 36; ++y)
        for (int x = 15; x < 46; ++x) CHECK_NEAR(out.pixel(x, y).r, 1, x == 30 && y == 20 ? 2 : 0.1);
}

TEST(denoised_error_is_the_true_one) {
    const auto smooth = [](int x, int y) { return 1 + 0.3 * std::sin(0.2 * x) * std::cos(0.15 * y); };
    const auto compare = [](const char* name, double sigma, const auto& truth) {
        double told = 0, real = 0;
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            const DenoisedPicture out = blended(noisy(seed, sigma, truth));
            told += sqr(out.error) / 8, real += meanSquare(out.color, truth) / 8;
        }
        CHECK_INFO(told > 0.8 * real && told < 1.2 * real,
                   name << ", noise " << sigma << ": told " << told << ", is " << real);
        CHECK_INFO(real < 0.5 * sigma * sigma, name << ": " << real);
    };
    compare("smooth", 0.05, smooth);
    compare("smooth", 0.2, smooth);
    compare("edge", 0.2, edge);
}

// A texture that the first hits do not show, with little and with much noise: the filter takes it for noise, or not,
// but the picture is no worse than the raw one.
TEST(denoised_picture_is_no_worse_than_the_raw_one) {
    for (const double sigma : {0.02, 0.05, 0.1, 0.2, 0.4}) {
        const HalvedPicture picture = noisy(7, sigma, tiles);
        const double raw = meanSquare(picture.color.mean, tiles);
        const double mixed = meanSquare(blended(picture).color, tiles);
        CHECK_INFO(mixed < sqr(1.02) * raw, "noise " << sigma << ": " << mixed << " of " << raw);
    }
}

TEST(denoised_pictures_have_the_same_bits) {
    HalvedPicture picture = noisy(5, 0.2, edge);
    setHalves(picture.color, 12, 8, {1e30f, 3, -1e20f}, {1, 2, 3});
    const Filtered expected = denoise(picture, oneLane(), 1);
    const DenoisedPicture mixed = blended(picture, oneLane(), 1);
    for (const Isa& isa : allIsas())
        if (isa.supported())
            for (const int threads : {1, 3}) {
                CHECK_INFO(denoise(picture, isa, threads) == expected, isa.name << ", threads " << threads);
                const DenoisedPicture out = blended(picture, isa, threads);
                CHECK_INFO(out.color == mixed.color && out.error == mixed.error, isa.name);
            }
}

TEST(denoised_pictures_may_be_small) {
    for (const auto& [width, height] : {std::array{1, 1}, std::array{1, 9}, std::array{5, 1}}) {
        HalvedPicture picture = blankPicture(width, height);
        for (Rgb& pixel : picture.color.mean.pixels()) pixel = {0.25f, 0.5f, 2};
        const DenoisedPicture out = blended(picture);
        for (const Rgb& pixel : out.color.pixels())
            CHECK(std::fabs(pixel.g - 0.5f) < 1e-6f && std::fabs(pixel.b - 2) < 1e-6f);
    }
}

} // namespace test_denoise
