// The sky as a lamp: its directions have their density and its pictures' brightness, tables are the
// same for any number of threads, and pictures that can't light are named.
#include "check.h"
#include "light/kinds/sky.h"
#include "sample/hash.h"
#include "texture/sky_cells.h"
#include "unit/chi2.h"
#include "unit/light_kit.h"

#include <string>

namespace test_sky_lights {

using namespace light_kit;
using meshes::Random;

namespace {

class Picture : public SkyRadiance {
public:
    explicit Picture(const Environment& environment) : environment_(environment) {}
    void radiance(std::size_t count, const float* const (&dir)[3],
                  float* const (&rgb)[3]) const override {
        for (std::size_t i = 0; i < count; ++i) {
            const Rgb c = environment_.radiance(Vec3{dir[0][i], dir[1][i], dir[2][i]});
            rgb[0][i] = c.r, rgb[1][i] = c.g, rgb[2][i] = c.b;
        }
    }

private:
    const Environment& environment_;
};

// A dim sky with a few bright spots.
StoredImage skyPicture(Random& random, int width, int height, double dim) {
    StoredImage image;
    image.width = width, image.height = height, image.channels = 3;
    image.depth = StoredImage::Depth::Float;
    for (int i = 0; i < width * height; ++i) {
        const bool isBright = random.chance(0.01);
        for (int c = 0; c < 3; ++c)
            image.floats.push_back(static_cast<float>(random.unit() * (isBright ? 100 : dim)));
    }
    return image;
}

Vec2 square(Random& random) {
    const auto unit = [&] { return unitFloat(static_cast<std::uint32_t>(random.unit() * 0x1p32)); };
    const float x = unit();
    return {x, unit()};
}

} // namespace

TEST(sky_directions_have_their_density) {
    constexpr std::uint64_t kSeed = 5140;
    Random random(kSeed);
    for (const auto up : {Environment::Up::Z, Environment::Up::Y}) {
        for (const bool compensated : {false, true}) {
            const Environment environment(skyPicture(random, 12, 7, 1), ColorSpace::Linear,
                                          Interpolation::Bilinear, up, 0.7);
            const SkyCells cells = skyCells(environment, kMostSkyColumns, kMostSkyRows);
            const SkyTable table(cells.width, cells.height, cells.luminance, compensated,
                                 {up == Environment::Up::Z, environment.view().turns});
            const Picture picture(environment);
            const kernels::one::SkyEmitter sky(table.view(picture));
            double sum = 0;
            constexpr int kCount = 60000;
            const auto result = chi2::test(
                {unitVector(random), 2}, kCount,
                [&]() -> std::optional<Vec3> {
                    const Vec2 u = square(random);
                    const auto s = sky.sample({0, 0, 0}, u.x, u.y);
                    CHECK(s.pdf.v > 0 && s.distance.v == kInfinityF);
                    CHECK_INFO(std::fabs(sky.pdf({0, 0, 0}, s.toLight).v / s.pdf.v - 1) < 1e-4,
                               "seed " << kSeed << ' ' << sky.pdf({0, 0, 0}, s.toLight).v << ' '
                                       << s.pdf.v);
                    sum += static_cast<double>(s.irradiance.y.v);
                    return plain(s.toLight);
                },
                [&](Vec3 dir) {
                    return sky.pdf({0, 0, 0}, lane(dir)).v;
                });
            CHECK_INFO(result.deviation < 5 && std::fabs(result.integral - 1) < 0.01,
                       "seed " << kSeed << " compensated " << compensated << " deviation "
                               << result.deviation << " integral " << result.integral);
            // All of the sky, by directions without a table.
            double even = 0;
            for (int i = 0; i < kCount; ++i)
                even += static_cast<double>(environment.radiance(unitVector(random)).g) * 4 * kPi;
            // The deviation of the even ones, of a sky that varies by 30 times its mean, is 3 %;
            // samples of the table alone leave out what is dim when it is compensated.
            if (!compensated) CHECK_INFO(std::fabs(sum / even - 1) < 0.12, sum / even);
        }
    }
}

// With the weights of samples of both kinds added up, no part of a compensated sky is lost: for
// each direction the balance heuristic's weights sum up to 1, where either has a density.
TEST(sky_is_never_black_where_its_picture_is_not) {
    constexpr std::uint64_t kSeed = 5141;
    Random random(kSeed);
    StoredImage image = skyPicture(random, 64, 32, 0);
    const Environment environment(image, ColorSpace::Linear, Interpolation::Bilinear,
                                  Environment::Up::Z, 0);
    for (const auto& [columns, rows] : {std::pair{64, 32}, std::pair{10, 7}}) {
        const SkyCells cells = skyCells(environment, columns, rows);
        CHECK(cells.width == columns && cells.height == rows);
        const SkyTable table(cells.width, cells.height, cells.luminance, false, {});
        const Picture picture(environment);
        const kernels::one::SkyEmitter sky(table.view(picture));
        for (int i = 0; i < 20000; ++i) {
            const Vec3 dir = unitVector(random);
            const bool isLit = !isBlack(environment.radiance(dir));
            CHECK(!isLit || sky.pdf({0, 0, 0}, lane(dir)).v > 0);
            // Brighter than a thousandth of an even share.
            const auto bright = environment.radiance(dir).g > 10;
            if (bright && columns == 64) CHECK(sky.pdf({0, 0, 0}, lane(dir)).v > 1 / (4 * kPi));
        }
    }
}

TEST(sky_of_one_colour_and_of_none) {
    const SkyTable even;
    Random random(5142);
    StoredImage black;
    black.width = 4, black.height = 2, black.channels = 1, black.depth = StoredImage::Depth::Bits8;
    black.bytes.assign(8, 0);
    const Environment environment(black, ColorSpace::Srgb, Interpolation::Bilinear,
                                  Environment::Up::Z, 0);
    const Picture picture(environment);
    const SkyTable ofOne(3, 2, std::vector<float>(6, 0.7f), true, {});
    const SkyTable ofNone(4, 2, std::vector<float>(8, 0.0f), false, {});
    CHECK_NEAR(ofOne.mean(), 0.7, 1e-6);
    for (const SkyTable* table : {&even, &ofOne, &ofNone}) {
        const kernels::one::SkyEmitter sky(table->view(picture));
        for (int i = 0; i < 1000; ++i) {
            const Vec2 u = square(random);
            const auto s = sky.sample({0, 0, 0}, u.x, u.y);
            CHECK_NEAR(s.pdf.v, 1 / (4 * kPi), 1e-6);
            CHECK_NEAR(length(plain(s.toLight)), 1, 1e-6);
            CHECK(s.irradiance.x.v == 0);
        }
    }
}

TEST(sky_tables_are_the_same_for_any_threads) {
    Random random(5143);
    const Environment environment(skyPicture(random, 300, 150, 1), ColorSpace::Linear,
                                  Interpolation::Bilinear, Environment::Up::Z, 0);
    const Picture picture(environment);
    const SkyCells one = skyCells(environment, 200, 100, 1),
                   two = skyCells(environment, 200, 100, 3);
    CHECK(one.luminance == two.luminance);
    const SkyTable a(200, 100, one.luminance, true, {}, 1), b(200, 100, one.luminance, true, {}, 3);
    const SkyView x = a.view(picture), y = b.view(picture);
    CHECK(std::equal(x.rows, x.rows + 101, y.rows));
    CHECK(std::equal(x.columns, x.columns + 100 * 201, y.columns));
}

TEST(sky_pictures_that_can_not_light_are_named) {
    Random random(5144);
    StoredImage image = skyPicture(random, 8, 4, 1);
    CHECK(!whyNoLight(image));
    image.floats[(2 * 8 + 5) * 3 + 1] = -1e-6f;
    CHECK_EQUAL(whyNoLight(image).value_or(""),
                "pixel 5 from the left, 2 from the top is negative; light has no colours below 0");
    image.floats[(1 * 8 + 7) * 3] = std::numeric_limits<float>::quiet_NaN();
    CHECK_EQUAL(
        whyNoLight(image).value_or(""),
        "pixel 7 from the left, 1 from the top is not a number; light has no colours below 0");
    // A picture's reader makes 0 of it, and says where.
    image.floats[(1 * 8 + 7) * 3] = 0;
    image.noNumber = (1 * 8 + 6) * 3 + 2;
    CHECK_EQUAL(
        whyNoLight(image).value_or(""),
        "pixel 6 from the left, 1 from the top is not a number; light has no colours below 0");
    image.noNumber.reset();
    image.channels = 1, image.width = 24;
    image.floats.assign(image.floats.size(), -0.0f);
    CHECK(!whyNoLight(image));
}

} // namespace test_sky_lights
