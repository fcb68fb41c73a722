// Code/image/coded_image.h: the same files as an Image gives.
#include "check.h"

#include "base/text.h"
#include "image/coded_image.h"

#include <algorithm>
#include <limits>
#include <random>

namespace test_coded_image {

namespace {

// Of all kinds: far outside of [0, 1], NaN, and runs of equal ones.
Image randomImage(int width, int height, std::mt19937& random) {
    const auto value = [&] {
        const std::uint32_t kind = random() % 16;
        const float inside = static_cast<float>(random()) * 0x1p-32f;
        return kind == 0   ? std::numeric_limits<float>::quiet_NaN()
               : kind == 1 ? -inside
               : kind == 2 ? 1 + 1000 * inside
               : kind == 3 ? inside * 0x1p-14f
                           : inside;
    };
    Image image(width, height);
    Rgb pixel;
    for (Rgb& p : image.pixels()) {
        if (random() % 3 != 0) pixel = {value(), value(), value()};
        p = pixel;
    }
    return image;
}

// In pieces of rows, from the last on.
CodedImage codedFrom(const Image& image, Encoding encoding, std::mt19937& random) {
    CodedImage coded(image.width(), image.height(), encoding);
    for (int y = image.height() - 1; y >= 0; --y)
        for (int end = image.width(); end > 0;) {
            const int count = 1 + static_cast<int>(random() % 40), x = std::max(0, end - count);
            const auto first =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width()) +
                static_cast<std::size_t>(x);
            coded.put(x, y, image.pixels().subspan(first, static_cast<std::size_t>(end - x)));
            end = x;
        }
    return coded;
}

} // namespace

TEST(coded_images_give_the_files_of_images) {
    for (int i = 0; i < check::scaled(12); ++i) {
        const auto seed = static_cast<std::uint32_t>(i);
        std::mt19937 random(seed);
        // From one pixel to several parts of a PNG file, which have 2^18 bytes.
        const int width = 1 + static_cast<int>(random() % (i < 6 ? 9 : 900));
        const int height = 1 + static_cast<int>(random() % (i < 6 ? 9 : 300));
        const Image image = randomImage(width, height, random);
        for (const Encoding encoding :
             {Encoding{Encoding::Transfer::Srgb, 8}, Encoding{Encoding::Transfer::Linear, 8},
              Encoding{Encoding::Transfer::Srgb, 8, true}}) {
            const CodedImage coded = codedFrom(image, encoding, random);
            for (const char* extension : {"ppm", "png"})
                for (const int threads : {1, 3})
                    CHECK_INFO(encodeImage(coded, extension, threads) ==
                                   encodeImage(image, extension, encoding),
                               cat("seed ", seed, ", ", width, "x", height, " ", extension, " on ",
                                   threads, " threads"));
        }
    }
}

// Rectangles of one colour, at the edges and across them all.
TEST(coded_images_are_filled_as_images) {
    std::mt19937 random(31);
    const auto below = [&](int end) {
        return static_cast<int>(random() % static_cast<unsigned>(end));
    };
    for (int i = 0; i < check::scaled(40); ++i) {
        Image image = randomImage(1 + below(70), 1 + below(40), random);
        CodedImage coded = codedFrom(image, {}, random);
        const Rgb color = randomImage(1, 1, random).pixels()[0];
        const int x0 = below(image.width()), y0 = below(image.height());
        const int width = 1 + below(image.width() - x0), height = 1 + below(image.height() - y0);
        coded.fill(x0, y0, width, height, color);
        for (int y = y0; y < y0 + height; ++y)
            for (int x = x0; x < x0 + width; ++x) image.setPixel(x, y, color);
        CHECK_INFO(encodeImage(coded, "ppm") ==
                       encodeImage(image, "ppm", {Encoding::Transfer::Srgb, 8}),
                   cat("case ", i, ", ", width, "x", height, " at ", x0, ", ", y0));
    }
}

TEST(coded_images_have_the_sizes_of_images) {
    CHECK(CodedImage().isEmpty());
    CHECK(!CodedImage(1, 1, {}).isEmpty());
    for (const Vec2d size : {Vec2d{0, 1}, {1, -1}, {Image::kMaxSide + 1, 1}})
        CHECK_THROWS(CodedImage(static_cast<int>(size.x), static_cast<int>(size.y), {}),
                     "is not possible");
}

} // namespace test_coded_image
