// The sky as a lamp: its directions have their density and its pictures' brightness, tables are the
// same for any number of threads, and pictures that can't light are named.
#include "check.h"
#include "light/kinds/sky.h"
#include "sample/hash.h"
#include "texture/environment.h"
#include "verify/light_kit.h"

#include <string>

namespace test_sky_lights {

using namespace light_kit;
using meshes::Random;

namespace {

Vec2 square(Random& random) {
    const auto unit = [&] { return unitFloat(static_cast<std::uint32_t>(random.unit() * 0x1p32)); };
    const float x = unit();
    return {x, unit()};
}

} // namespace

// With the weights of samples of both kinds added up, no part of a compensated sky is lost: for
// each direction the balance heuristic's weights sum up to 1, where either has a density.
TEST(sky_is_never_black_where_its_picture_is_not) {
    constexpr std::uint64_t kSeed = 5141;
    Random random(kSeed);
    StoredImage image = skyImage(random, 64, 32, 0);
    const Environment environment(image, ColorSpace::Linear, Interpolation::Bilinear,
                                  Environment::Up::Z, 0);
    for (const auto& [columns, rows] : {std::pair{64, 32}, std::pair{10, 7}}) {
        const SkyCells cells = skyCells(environment, columns, rows);
        CHECK(cells.width == columns && cells.height == rows);
        const SkyTable table(cells.width, cells.height, cells.luminance, false, {});
        const SkyRadiance picture{&environment};
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
    const SkyRadiance picture{&environment};
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
    const Environment environment(skyImage(random, 300, 150, 1), ColorSpace::Linear,
                                  Interpolation::Bilinear, Environment::Up::Z, 0);
    const SkyRadiance picture{&environment};
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
    StoredImage image = skyImage(random, 8, 4, 1);
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
