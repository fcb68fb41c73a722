// Mip levels: means of texels, whatever is asked for first.
#include "check.h"
#include "texture/mip_levels.h"
#include "verify/meshes.h"

#include <algorithm>
#include <array>
#include <thread>
#include <vector>

namespace test_mip_levels {

using meshes::Random;

namespace {

StoredImage someFloats(Random& random, int width, int height, int channels) {
    StoredImage image;
    image.width = width, image.height = height, image.channels = channels;
    image.depth = StoredImage::Depth::Float;
    const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels);
    for (std::size_t i = 0; i < count; ++i)
        image.floats.push_back(static_cast<float>(random.uniform(0, 1)));
    return image;
}
StoredImage someBytes(Random& random, int width, int height, int channels) {
    StoredImage image;
    image.width = width, image.height = height, image.channels = channels;
    const auto count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * static_cast<std::size_t>(channels);
    for (std::size_t i = 0; i < count; ++i)
        image.bytes.push_back(static_cast<std::uint8_t>(random.below(256)));
    return image;
}
// What part of texel i of `side` lies in texel j of half as many.
double shared(int i, int side, int j, int half) {
    const double low = std::max<double>(i, static_cast<double>(j) * side / half);
    const double high = std::min<double>(i + 1, static_cast<double>(j + 1) * side / half);
    return std::max(high - low, 0.0) * half / side;
}

} // namespace

// Every texel is the integral over its square, sums over all texels, of colours times alpha and of
// alpha.
TEST(mip_levels_are_integrals_over_their_texels) {
    Random random(61);
    for (int round = 0; round < check::scaled(200); ++round) {
        const int width = static_cast<int>(1 + random.below(12)),
                  height = static_cast<int>(1 + random.below(12)),
                  channels = static_cast<int>(1 + random.below(4));
        const StoredImage image = someFloats(random, width, height, channels);
        const StoredImage half = halved(image, false);
        const int halfWidth = std::max(width / 2, 1), halfHeight = std::max(height / 2, 1);
        CHECK_EQUAL(half.width, halfWidth);
        CHECK_EQUAL(half.height, halfHeight);
        const auto at = [](const StoredImage& of, int x, int y, int c) {
            return static_cast<double>(
                of.floats[(static_cast<std::size_t>(y) * static_cast<std::size_t>(of.width) + static_cast<std::size_t>(x)) * static_cast<std::size_t>(of.channels) + static_cast<std::size_t>(c)]);
        };
        const bool hasAlpha = channels % 2 == 0;
        for (int y = 0; y < half.height; ++y)
            for (int x = 0; x < half.width; ++x)
                for (int c = 0; c < channels; ++c) {
                    double sum = 0, alpha = 0;
                    for (int j = 0; j < height; ++j)
                        for (int i = 0; i < width; ++i) {
                            const double part = shared(i, width, x, half.width) *
                                                shared(j, height, y, half.height);
                            const double a = hasAlpha ? at(image, i, j, channels - 1) : 1;
                            alpha += part * a;
                            sum += part * (hasAlpha && c == channels - 1 ? 1 : at(image, i, j, c)) *
                                   a;
                        }
                    const bool isColour = !hasAlpha || c < channels - 1;
                    CHECK_NEAR(at(half, x, y, c), isColour ? sum / alpha : alpha, 1e-6);
                }
    }
}

TEST(mip_levels_are_the_same_in_any_order) {
    Random random(62);
    const std::array<std::array<int, 2>, 4> sizes{{{64, 64}, {37, 100}, {1, 9}, {255, 3}}};
    for (const auto& [width, height] : sizes)
        for (int channels = 1; channels <= 4; ++channels) {
            const TexelGrid picture(someBytes(random, width, height, channels), ColorSpace::Srgb,
                                    Interpolation::Bilinear);
            const MipLevels up(picture), down(picture), together(picture);
            const int last = up.count() - 1;
            for (int i = 1; i <= last; ++i) up.level(picture, i);
            for (int i = last; i >= 1; --i) down.level(picture, i);
            std::vector<std::thread> threads;
            for (int t = 0; t < 4; ++t)
                threads.emplace_back([&, t] {
                    for (int i = 1; i <= last; ++i)
                        together.level(picture, 1 + (i * (t + 1)) % last);
                });
            for (std::thread& thread : threads) thread.join();
            for (int i = 1; i <= last; ++i) {
                const auto& floats = up.level(picture, i).image().floats;
                CHECK(floats == down.level(picture, i).image().floats);
                CHECK(floats == together.level(picture, i).image().floats);
            }
            CHECK_EQUAL(up.level(picture, last).width(), 1);
            CHECK_EQUAL(up.level(picture, last).height(), 1);
            CHECK_EQUAL(up.bytes(), down.bytes());
        }
}

// A level that was not looked up is not there, but for small ones on the way; all of them together
// take no more than 4/3 of a picture of bytes, where sides halve evenly.
TEST(mip_levels_are_made_when_they_are_looked_up) {
    Random random(63);
    const TexelGrid picture(someBytes(random, 256, 256, 3), ColorSpace::Srgb,
                            Interpolation::Bilinear);
    const MipLevels mips(picture);
    CHECK_EQUAL(mips.count(), 9);
    CHECK_EQUAL(mips.bytes(), 0u);
    mips.level(picture, 3);
    CHECK_EQUAL(mips.bytes(), std::uint64_t{64 * 64 + 32 * 32} * 3 * 4);
    for (int i = 1; i < mips.count(); ++i) mips.level(picture, i);
    CHECK(mips.bytes() <= std::uint64_t{256 * 256 * 3} * 4 / 3);
    CHECK_EQUAL(mips.bytesOfAll(picture), mips.bytes());
    const TexelGrid narrow(someBytes(random, 5, 1, 2), ColorSpace::Srgb, Interpolation::Bilinear);
    CHECK_EQUAL(MipLevels(narrow).bytesOfAll(narrow), std::uint64_t{2 + 1} * 2 * 4);
}

} // namespace test_mip_levels
