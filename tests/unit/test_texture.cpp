#include "analytic_kit.h"
#include "check.h"
#include "image/colour.h"
#include "texture/texture.h"
#include "unit/stored_floats.h"

namespace test_texture {

using kit::Random;

namespace {

StoredImage bytes(int width, int height, int channels, std::vector<std::uint8_t> values) {
    StoredImage image;
    image.width = width;
    image.height = height;
    image.channels = channels;
    image.bytes = std::move(values);
    return image;
}

TextureParams linear(Interpolation interpolation = Interpolation::Bilinear,
                     Extension extension = Extension::Repeat) {
    TextureParams p;
    p.space = ColorSpace::Linear;
    p.interpolation = interpolation;
    p.extension = extension;
    return p;
}

// 2 x 2, from the top left: 1 2 / 3 4.
StoredImage four() { return floats(2, 2, {1, 2, 3, 4}); }

} // namespace

TEST(texture_row_zero_is_the_top_and_v_goes_up) {
    const Texture t(four(), linear(Interpolation::Nearest));
    CHECK_EQUAL(t.color({0.25f, 0.75f}).r, 1.0f);
    CHECK_EQUAL(t.color({0.75f, 0.75f}).g, 2.0f);
    CHECK_EQUAL(t.color({0.25f, 0.25f}).b, 3.0f);
    CHECK_EQUAL(t.color({0.75f, 0.25f}).r, 4.0f);
    CHECK_EQUAL(t.color({0.5f, 0.5f}).r, 2.0f); // the border belongs to the texel right and above
    CHECK_EQUAL(t.color({0.49999997f, 0.49999997f}).r, 3.0f);
}

TEST(texture_bilinear_by_hand) {
    const Texture t(four(), linear());
    CHECK_EQUAL(t.color({0.25f, 0.75f}).r, 1.0f); // centres of texels
    CHECK_EQUAL(t.color({0.75f, 0.25f}).r, 4.0f);
    CHECK_NEAR(t.color({0.5f, 0.75f}).r, 1.5, 1e-7);
    CHECK_NEAR(t.color({0.5f, 0.5f}).r, 2.5, 1e-7);
    CHECK_NEAR(t.color({0.375f, 0.625f}).r,
               0.75 * 0.75 * 1 + 0.25 * 0.75 * 2 + 0.75 * 0.25 * 3 + 0.0625 * 4, 1e-6);
}

TEST(texture_extensions) {
    const auto at = [](Extension e, Interpolation i, float u, float v) {
        return Texture(four(), linear(i, e)).color({u, v}).r;
    };
    const auto nearest = Interpolation::Nearest, bilinear = Interpolation::Bilinear;
    for (const float whole : {-3.0f, -1.0f, 1.0f, 1000.0f}) {
        CHECK_EQUAL(at(Extension::Repeat, nearest, whole + 0.25f, 0.75f - whole), 1.0f);
        CHECK_EQUAL(at(Extension::Repeat, bilinear, whole + 0.75f, 0.25f - whole), 4.0f);
    }
    CHECK_NEAR(at(Extension::Repeat, bilinear, 0, 0.75f), 1.5, 1e-7); // between last and first
    CHECK_NEAR(at(Extension::Repeat, bilinear, 1, 0.75f), 1.5, 1e-7);
    CHECK_EQUAL(at(Extension::Extend, bilinear, -7, 9), 1.0f);
    CHECK_EQUAL(at(Extension::Extend, nearest, 7, 9), 2.0f);
    CHECK_EQUAL(at(Extension::Extend, nearest, 1, 0), 4.0f);
    CHECK_EQUAL(at(Extension::Extend, bilinear, 0, 0.75f), 1.0f);
    CHECK_EQUAL(at(Extension::Clip, nearest, -0.01f, 0.75f), 0.0f);
    CHECK_EQUAL(at(Extension::Clip, nearest, 0.01f, 1.01f), 0.0f);
    CHECK_EQUAL(at(Extension::Clip, nearest, 0.01f, 0.99f), 1.0f);
    // The colour stays as long as anything covers; what fades is the alpha.
    CHECK_EQUAL(at(Extension::Clip, bilinear, 0, 0.75f), 1.0f);
    CHECK_EQUAL(at(Extension::Clip, bilinear, -0.24f, 0.75f), 1.0f);
    TextureParams alpha = linear(bilinear, Extension::Clip);
    alpha.channel = TextureParams::Channel::Alpha;
    CHECK_NEAR(Texture(four(), alpha).value({0, 0.75f}), 0.5, 1e-7);
    CHECK_EQUAL(at(Extension::Clip, bilinear, -0.25f, 0.75f), 0.0f);
    CHECK_EQUAL(at(Extension::Clip, bilinear, 50, 50), 0.0f);
}

// At the edge of a cut-out the colour is that of what is seen: no fringe of what is transparent.
TEST(texture_colours_count_as_they_cover) {
    const std::vector<std::uint8_t> cut = {0, 255, 0, 255, 255, 0, 255, 0}; // green, clear magenta
    const Texture t(bytes(2, 1, 4, cut), linear());
    for (const float u : {0.25f, 0.3f, 0.5f, 0.7f, 0.74f}) {
        CHECK_EQUAL(t.color({u, 0.5f}).g, 1.0f);
        CHECK_EQUAL(t.color({u, 0.5f}).r, 0.0f);
    }
    // By premultiplied numbers: a quarter of the way from alpha 1 to alpha 1/3.
    const Texture soft(bytes(2, 1, 2, {30, 255, 240, 85}), linear());
    const double covered = 0.75 * 255 + 0.25 * 85;
    CHECK_NEAR(soft.color({0.375f, 0.5f}).r, (0.75 * 255 * 30 + 0.25 * 85 * 240) / covered / 255,
               1e-7);
    // Where nothing covers, and where all is equally clear, numbers are mixed as they are.
    const Texture clear(bytes(2, 1, 2, {0, 0, 255, 0}), linear());
    CHECK_NEAR(clear.color({0.5f, 0.5f}).r, 0.5, 1e-7);
    const Texture glassy(bytes(2, 1, 2, {0, 85, 255, 85}), linear());
    CHECK_NEAR(glassy.color({0.5f, 0.5f}).r, 0.5, 1e-7);
    // An opaque picture keeps its colour to its border.
    const Texture bordered(bytes(1, 1, 3, {0, 255, 0}),
                           linear(Interpolation::Bilinear, Extension::Clip));
    for (const float u : {-0.49f, 0.0f, 0.5f, 1.49f})
        CHECK_EQUAL(bordered.color({u, 0.5f}).g, 1.0f);
    CHECK_EQUAL(bordered.color({-0.51f, 0.5f}).g, 0.0f);
    // 16 bits and floats alike.
    StoredImage words;
    words.width = 2, words.height = 1, words.channels = 2;
    words.depth = StoredImage::Depth::Bits16;
    words.words = {65535, 65535, 0, 0};
    CHECK_EQUAL(Texture(words, linear()).color({0.6f, 0.5f}).r, 1.0f);
}

TEST(texture_filters_8_bit_srgb_before_it_decodes) {
    const StoredImage step = bytes(2, 1, 1, {0, 255});
    TextureParams p;
    const Texture t(step, p);
    // Half-way: decode(0.5) = 0.2140, not 0.5 (the mean of the decoded ends).
    CHECK_NEAR(t.color({0.5f, 0.5f}).r, 0.21404114, 1e-6);
    CHECK_NEAR(t.value({0.5f, 0.5f}), 0.21404114, 1e-6);
    p.space = ColorSpace::Linear;
    CHECK_NEAR(Texture(step, p).color({0.5f, 0.5f}).r, 0.5, 1e-7);
    // Whole codes decode as the image reader's.
    std::vector<std::uint8_t> codes(256);
    for (int i = 0; i < 256; ++i) codes[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(i);
    const Texture ramp(bytes(256, 1, 1, codes), TextureParams{});
    for (int i = 0; i < 256; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / 256;
        CHECK_NEAR(ramp.color({u, 0.5f}).r, linearFromSrgb8(static_cast<std::uint8_t>(i)), 1.2e-7);
    }
    // 16 bits alike; float files are linear whatever is asked for.
    StoredImage words;
    words.width = 2;
    words.height = words.channels = 1;
    words.depth = StoredImage::Depth::Bits16;
    words.words = {0, 65535};
    CHECK_NEAR(Texture(words, TextureParams{}).color({0.5f, 0.5f}).r, 0.21404114, 1e-6);
    CHECK_EQUAL(Texture(floats(1, 1, {0.5f}), TextureParams{}).color({0, 0}).r, 0.5f);
    CHECK_EQUAL(Texture(floats(1, 1, {7.5f}), TextureParams{}).color({0, 0}).r, 7.5f);
}

TEST(texture_channels) {
    TextureParams p = linear(Interpolation::Nearest);
    const std::vector<std::uint8_t> rgba = {255, 51, 0, 102};
    CHECK(Texture(bytes(1, 1, 4, rgba), p).color({0, 0}) == (Rgb{1, 0.2f, 0})); // alpha apart
    CHECK_NEAR(Texture(bytes(1, 1, 4, rgba), p).value({0, 0}), 0.2126 + 0.7152 * 0.2, 1e-6);
    CHECK(Texture(bytes(1, 1, 2, {51, 102}), p).color({0, 0}) == (Rgb{0.2f, 0.2f, 0.2f}));
    p.channel = TextureParams::Channel::Alpha;
    p.space = ColorSpace::Srgb; // alpha is never encoded
    CHECK(Texture(bytes(1, 1, 4, rgba), p).color({0, 0}) == (Rgb{0.4f, 0.4f, 0.4f}));
    CHECK_EQUAL(Texture(bytes(1, 1, 4, rgba), p).value({0, 0}), 0.4f);
    CHECK_EQUAL(Texture(bytes(1, 1, 2, {51, 102}), p).value({0, 0}), 0.4f);
    CHECK_EQUAL(Texture(bytes(1, 1, 3, {1, 2, 3}), p).value({0, 0}), 1.0f); // none: opaque
    p.extension = Extension::Clip;
    CHECK_EQUAL(Texture(bytes(1, 1, 3, {1, 2, 3}), p).value({2, 0}), 0.0f); // outside: transparent
}

TEST(texture_mapping) {
    TextureParams p = linear(Interpolation::Nearest);
    p.scale = {2, 1};
    CHECK_EQUAL(Texture(four(), p).color({0.125f, 0.75f}).r, 1.0f);
    CHECK_EQUAL(Texture(four(), p).color({0.375f, 0.75f}).r, 2.0f);
    p.scale = {1, 1};
    p.offset = {0.5, 0};
    CHECK_EQUAL(Texture(four(), p).color({0.25f, 0.75f}).r, 2.0f);
    p.offset = {0, 0};
    p.rotationRad = kPi / 2;                                       // (u, v) -> (-v, u)
    CHECK_EQUAL(Texture(four(), p).color({0.25f, 0.25f}).r, 4.0f); // (-0.25, 0.25)
    CHECK_EQUAL(Texture(four(), p).color({0.75f, 0.25f}).r, 2.0f); // (-0.25, 0.75)
    // Scale first, then rotation, then offset.
    p.scale = {2, 1};
    p.offset = {0.5, 0};
    CHECK_EQUAL(Texture(four(), p).color({0.375f, 0.25f}).r, 1.0f); // (0.25, 0.75)
}

TEST(texture_gradient_is_the_slope_between_texels) {
    // A plane wave of values, away from the seam: slopes are known, whatever the map.
    const int size = 16;
    std::vector<float> values;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            values.push_back(3 * (static_cast<float>(x) + 0.5f) / size -
                             2 * (static_cast<float>(size - 1 - y) + 0.5f) / size);
    Random random(901);
    for (int i = 0; i < 200; ++i) {
        TextureParams p = linear(Interpolation::Bilinear, Extension::Extend);
        const double x = random.uniform(0.2, 0.5), y = random.uniform(0.2, 0.5);
        p.scale = {x, y};
        p.rotationRad = random.uniform(-3, 3);
        p.offset = {0.5, 0.5}; // uv of length below 1 stay inside
        const Texture t(floats(size, size, values), p);
        const Vec2 uv{static_cast<float>(random.uniform(-0.4, 0.4)),
                      static_cast<float>(random.uniform(-0.4, 0.4))};
        const Vec2 g = t.gradient(uv);
        const double c = std::cos(p.rotationRad), s = std::sin(p.rotationRad);
        CHECK_NEAR(g.x, 3 * c * x - 2 * s * x, 2e-5);
        CHECK_NEAR(g.y, -3 * s * y - 2 * c * y, 2e-5);
        const float h = 1.0f / 64;
        CHECK_NEAR(g.x, (t.value({uv.x + h, uv.y}) - t.value({uv.x - h, uv.y})) / (2 * h), 1e-4);
        CHECK_NEAR(g.y, (t.value({uv.x, uv.y + h}) - t.value({uv.x, uv.y - h})) / (2 * h), 1e-4);
    }
    // By hand: half-way between texels the difference of the two.
    const Texture two(floats(2, 1, {1, 4}), linear());
    CHECK_NEAR(two.gradient({0.5f, 0.5f}).x, (4 - 1) * 2, 1e-6);
    CHECK_NEAR(two.gradient({0.25f, 0.5f}).x, 0, 1e-6); // 1 between two 4s
    CHECK_EQUAL(two.gradient({0.5f, 0.5f}).y, 0.0f);
}

TEST(texture_any_uv_is_safe) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = kInfinityF;
    const float odd[] = {nan, inf, -inf, 1e30f, -1e30f, 16777216, -1e-30f, 1e-45f, -0.0f, 3e9f};
    for (const Extension e : {Extension::Repeat, Extension::Extend, Extension::Clip})
        for (const Interpolation i : {Interpolation::Bilinear, Interpolation::Nearest})
            for (const float u : odd)
                for (const float v : odd) {
                    TextureParams p = linear(i, e);
                    p.rotationRad = 0.5;
                    const Texture t(floats(3, 5, std::vector<float>(15, 2.0f)), p);
                    const float value = t.value({u, v});
                    CHECK(e == Extension::Clip ? value >= 0 && value < 2.001f
                                               : std::fabs(value - 2) < 1e-5f);
                    const Vec2 g = t.gradient({u, v});
                    CHECK(g.x == g.x && g.y == g.y);
                }
    CHECK_THROWS(Texture(floats(2, 2, {1, 2, 3}), linear()), "does not match");
    CHECK_THROWS(Texture(StoredImage{}, linear()), "does not match");
}

} // namespace test_texture
