// Code/image/png_read.cpp and png_write.cpp. The files in tests/scenes/png come from make.py there,
// another implementation; broken files are in tests/bad/image (test_image.cpp).
#include "check.h"

#include "base/file_text.h"
#include "base/text.h"
#include "image/image.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <random>
#include <string>

namespace test_png {

namespace {

// As in make.py.
unsigned sampleAt(int x, int y, int c, int depth) {
    return static_cast<unsigned>(x * 2654 + y * 10007 + c * 31337 + x * y * 77) >> 3 &
           ((1u << depth) - 1);
}
unsigned paletteAt(unsigned index, int c) {
    return (c == 0 ? index * 5 : c == 1 ? 255 - index : index * 77) & 255;
}
// What our reader must return for channel c of a pixel.
unsigned expectedAt(int colourType, int depth, bool isTransparent, int x, int y, int c) {
    const bool isPalette = colourType == 3;
    const int colours = colourType == 0 || colourType == 4 ? 1 : 3;
    if (isTransparent && c == colours) {
        if (isPalette) {
            const unsigned index = sampleAt(x, y, 0, depth);
            return index < 3 ? index * 40 : 255;
        }
        for (int s = 0; s < colours; ++s)
            if (sampleAt(x, y, s, depth) != sampleAt(2, 1, s, depth))
                return depth == 16 ? 65535 : 255;
        return 0;
    }
    if (isPalette) return paletteAt(sampleAt(x, y, 0, depth), c);
    return sampleAt(x, y, c, depth) * (depth < 8 ? 255 / ((1u << depth) - 1) : 1);
}

void checkPixels(const std::string& name, int colourType, int depth, bool isTransparent) {
    const StoredImage image = readStoredImage(name);
    const int colours = colourType == 0 || colourType == 4 ? 1 : 3;
    const bool hasAlpha = colourType >= 4 || isTransparent;
    CHECK_EQUAL(image.channels, colours + (hasAlpha ? 1 : 0));
    CHECK_EQUAL(image.depth == StoredImage::Depth::Bits16, depth == 16);
    int wrong = 0, transparent = 0;
    std::size_t i = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < image.channels; ++c, ++i) {
                const unsigned value = depth == 16 ? image.words[i] : image.bytes[i];
                wrong += value != expectedAt(colourType, depth, isTransparent, x, y, c);
                transparent += isTransparent && c == colours && value == 0;
            }
    CHECK_INFO(wrong == 0, name << ": " << wrong << " wrong samples");
    if (isTransparent && colourType != 3) CHECK_INFO(transparent > 0, name);
}

} // namespace

TEST(png_reads_every_colour_type_depth_and_interlace) {
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator("tests/scenes/png")) {
        const std::string name = entry.path().filename().string();
        int colourType = 0, depth = 0;
        // NOLINTNEXTLINE(cert-err34-c): these names are ours
        if (std::sscanf(name.c_str(), "c%d_%d_", &colourType, &depth) != 2) continue;
        checkPixels(entry.path().string(), colourType, depth, name.ends_with("_t.png"));
        ++files;
    }
    CHECK_EQUAL(files, 52); // 15 kinds x 2, and 11 of them with transparency x 2
}

TEST(png_reads_interlaced_pictures_with_empty_passes) {
    for (const char* size : {"1x1", "3x1", "1x5", "5x4"}) {
        const std::string name = cat("tests/scenes/png/size_", size, "_i.png");
        checkPixels(name, 2, 8, false);
        const StoredImage image = readStoredImage(name);
        CHECK_EQUAL(cat(image.width, "x", image.height), size);
    }
}

TEST(png_grey_and_alpha_become_rgb) {
    const Image grey(std::string("tests/scenes/png/c4_08_n.png"), Encoding::Transfer::Linear);
    const Rgb pixel = grey.pixel(3, 2);
    CHECK_EQUAL(pixel.r, static_cast<float>(sampleAt(3, 2, 0, 8) / 255.0));
    CHECK(pixel.r == pixel.g && pixel.g == pixel.b);
    const Image colour(std::string("tests/scenes/png/c6_16_i.png"), Encoding::Transfer::Linear);
    CHECK_EQUAL(colour.pixel(4, 5).b, static_cast<float>(sampleAt(4, 5, 2, 16) / 65535.0));
}

TEST(png_says_which_transfer_it_has) {
    const auto contains = [](Encoding encoding, const char* chunk) {
        const auto file = encodeImage(Image(1, 1), "png", encoding);
        return std::string(file.begin(), file.end()).find(chunk) != std::string::npos;
    };
    CHECK(contains({Encoding::Transfer::Srgb, 8}, "sRGB"));
    CHECK(!contains({Encoding::Transfer::Srgb, 8}, "gAMA"));
    CHECK(contains({Encoding::Transfer::Linear, 8}, "gAMA"));
    CHECK(!contains({Encoding::Transfer::Linear, 8}, "sRGB"));
}

TEST(png_is_much_smaller_than_stored) {
    Image image(640, 360);
    for (int y = 0; y < 360; ++y)
        for (int x = 0; x < 640; ++x) {
            const bool isDisk = (x - 300) * (x - 300) + (y - 180) * (y - 180) < 10000;
            const float shade = static_cast<float>(x + y) * 0.0009f;
            image.setPixel(x, y, isDisk ? Rgb{shade, 0.3f, 0.1f} : Rgb{0.1f, 0.2f, shade});
        }
    const auto file = encodeImage(image, "png", {});
    CHECK_INFO(file.size() < 640 * 360 * 3 / 20, file.size());
    CHECK(encodeImage(Image(decodeImage(file, "back")), "png", {}) == file);
}

// What comes again is not looked for in a draft: here pieces of four colours in any order.
TEST(png_drafts_are_larger_and_the_same_picture) {
    constexpr int kSide = 300, kPiece = 5;
    std::mt19937 random(8);
    std::array<std::array<Rgb, kPiece>, 4> pieces{};
    for (auto& piece : pieces)
        for (Rgb& pixel : piece)
            for (float* c : {&pixel.r, &pixel.g, &pixel.b})
                *c = static_cast<float>(random() % 256) / 255;
    Image image(kSide, kSide);
    for (std::size_t at = 0; at < image.pixels().size(); at += kPiece)
        std::copy_n(pieces[random() % 4].data(), kPiece, &image.pixels()[at]);
    for (const int bits : {8, 16}) {
        const auto file = encodeImage(image, "png", {Encoding::Transfer::Srgb, bits});
        const auto draft = encodeImage(image, "png", {Encoding::Transfer::Srgb, bits, true});
        CHECK_INFO(2 * draft.size() > 3 * file.size(), draft.size() << ' ' << file.size());
        const StoredImage a = decodeImage(file, "file"), b = decodeImage(draft, "draft");
        CHECK(a.bytes == b.bytes && a.words == b.words);
        CHECK(encodeImage(image, "png", {Encoding::Transfer::Srgb, bits, true}, 3) == draft);
    }
}

// Codes are copied where the row above has the same pixels: one other pixel, wherever it is, is
// still its own. PPM has no such short cut.
TEST(png_keeps_single_pixels_in_a_flat_picture) {
    for (const int width : {1, 31, 32, 33, 70}) {
        Image image(width, 2 * width + 1);
        for (Rgb& pixel : image.pixels()) pixel = {0.25f, 0.5f, 0.75f};
        for (int x = 0; x < width; ++x) image.setPixel(x, 2 * x + 1, {0.25f, 0.5f, 0.7f});
        for (const int bits : {8, 16}) {
            const Encoding encoding{Encoding::Transfer::Srgb, bits};
            const StoredImage png = decodeImage(encodeImage(image, "png", encoding), "png");
            const StoredImage ppm = decodeImage(encodeImage(image, "ppm", encoding), "ppm");
            CHECK_INFO(png.bytes == ppm.bytes && png.words == ppm.words,
                       "width " << width << ", " << bits << " bits");
        }
    }
}

} // namespace test_png
