// Code/image/ppm.cpp and netpbm.cpp; broken files are in tests/bad/image (test_image.cpp).
#include "check.h"

#include "base/text.h"
#include "image/colour.h"
#include "image/image.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace test_ppm {

using namespace std::string_view_literals;

namespace {

StoredImage stored(std::string_view text) {
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    return decodeImage(bytes, "test.ppm");
}
std::string shown(const StoredImage& image) {
    std::string out = cat(image.width, "x", image.height, "x", image.channels, ":");
    for (const std::uint8_t byte : image.bytes) out += cat(" ", byte + 0);
    for (const std::uint16_t word : image.words) out += cat(" ", word);
    return out;
}

} // namespace

TEST(ppm_reads_text_and_binary) {
    CHECK_EQUAL(shown(stored("P3\n2 1\n255\n1 2 3\n40 50 255\n")), "2x1x3: 1 2 3 40 50 255");
    CHECK_EQUAL(shown(stored("P3 2 1 255 1 2 3 40 50 255")), "2x1x3: 1 2 3 40 50 255");
    CHECK_EQUAL(shown(stored("P6\n2 1\n255\n\1\2\3\50\62\xFF"sv)), "2x1x3: 1 2 3 40 50 255");
    CHECK_EQUAL(shown(stored("P2\n2 1\n255\n7 8")), "2x1x1: 7 8");
    CHECK_EQUAL(shown(stored("P5\n2 1\n255\n\7\10"sv)), "2x1x1: 7 8");
}

TEST(ppm_header_comments_and_white_space) {
    const std::string expected = "1x1x3: 49 50 51";
    for (const std::string_view header :
         {"P6 1 1 255 123", "P6\n# made by\n1 1\n# maxval\n255\n123", "P6#c\n1#c\n1#c\n255\n123",
          "P6\t1\r\n1\v\f255\n123", "P6\n1 1\n255#c\n123", "P6\n#\n##\n\n\n1 1 255\n123",
          "P6\r\n1 1\r\n255\r\n123", "P6\n+1 1\n255\n123"})
        CHECK_EQUAL(shown(stored(header)), expected);
    // What looks like a comment or white space after the header is pixels.
    CHECK_EQUAL(shown(stored("P6 1 1 255\n#23")), "1x1x3: 35 50 51");
    CHECK_EQUAL(shown(stored("P6 1 1 255\n\n23")), "1x1x3: 10 50 51");
    CHECK_EQUAL(shown(stored("P6 1 1 255\r\n23")), "1x1x3: 10 50 51");
    CHECK_EQUAL(shown(stored("P3 1 1 255\n49#red\n50 #green\n\t 51 # blue")), expected);
    CHECK_EQUAL(shown(stored("P6 1 1 255\n123 and more")), expected); // several pictures in a file
}

TEST(ppm_any_maxval) {
    CHECK_EQUAL(shown(stored("P3 1 1 1 0 1 1")), "1x1x3: 0 255 255");
    CHECK_EQUAL(shown(stored("P3 1 1 15 0 7 15")), "1x1x3: 0 119 255");
    CHECK_EQUAL(shown(stored("P3 1 1 100 0 50 100")), "1x1x3: 0 32768 65535"); // 32767.5
    CHECK_EQUAL(shown(stored("P6 1 1 100\n\0\62\144"sv)), "1x1x3: 0 32768 65535");
    CHECK_EQUAL(shown(stored("P3 1 1 65535 0 256 65535")), "1x1x3: 0 256 65535");
    CHECK_EQUAL(shown(stored("P3 1 1 256 0 128 256")), "1x1x3: 0 32768 65535");
    CHECK_EQUAL(shown(stored("P6 1 1 65535\n\0\1\1\0\xFF\xFF"sv)), "1x1x3: 1 256 65535");
    CHECK(stored("P3 1 1 100 0 50 100").depth == StoredImage::Depth::Bits16);
    CHECK(stored("P3 1 1 51 0 50 51").depth == StoredImage::Depth::Bits8);
}

TEST(ppm_writes_known_bytes) {
    Image image(2, 1);
    image.setPixel(0, 0, {0, 0.5f, 1});
    image.setPixel(1, 0, {2, -1, 0.25f});
    const auto bytes = [&](Encoding encoding) {
        const auto file = encodeImage(image, "ppm", encoding);
        return std::string(file.begin(), file.end());
    };
    using Transfer = Encoding::Transfer;
    CHECK_EQUAL(bytes({Transfer::Linear, 8}), "P6\n2 1\n255\n\0\x80\xFF\xFF\0\x40"sv);
    CHECK_EQUAL(bytes({Transfer::Srgb, 8}), "P6\n2 1\n255\n\0\xBC\xFF\xFF\0\x89"sv);
    CHECK_EQUAL(bytes({Transfer::Linear, 16}),
                "P6\n2 1\n65535\n\0\0\x80\0\xFF\xFF\xFF\xFF\0\0\x40\0"sv);
}

// Pictures of several parts, in which the rows of threads meet: 1200 x 301 pixels are 1.1 MB of 8
// and 2.2 MB of 16 bits, parts have 256 KB.
TEST(image_files_do_not_depend_on_threads) {
    Image image(1200, 301);
    std::uint32_t state = 9;
    for (int y = 0; y < 301; ++y)
        for (int x = 0; x < 1200; ++x) { // noise on a slope beside flat ground
            state = state * 1664525u + 1013904223u;
            const float noise = x < 500 ? static_cast<float>(state >> 28) * 0.01f : 0.0f;
            image.setPixel(x, y, {noise, x > 900 ? 0.7f : static_cast<float>(y) * 0.003f, 0.2f});
        }
    for (const int bits : {8, 16})
        for (const char* extension : {"ppm", "png", "pfm"}) {
            const auto file = encodeImage(image, extension, {Encoding::Transfer::Srgb, bits});
            for (const int threads : {2, 3, 8})
                CHECK_INFO(encodeImage(image, extension, {Encoding::Transfer::Srgb, bits},
                                       threads) == file,
                           extension << " " << bits << " bits, " << threads << " threads");
        }
    const auto ppm = encodeImage(image, "ppm", {}), png = encodeImage(image, "png", {});
    CHECK(decodeImage(png, "png").bytes == decodeImage(ppm, "ppm").bytes);
}

// Every code comes back from a file in every format of whole codes.
TEST(ppm_and_png_round_trips_are_exact) {
    for (const auto transfer : {Encoding::Transfer::Srgb, Encoding::Transfer::Linear})
        for (const int bits : {8, 16})
            for (const char* extension : {"ppm", "png"}) {
                Image image(61, 37);
                std::uint32_t state = 5;
                const auto random = [&] {
                    state = state * 1664525u + 1013904223u;
                    const auto code = static_cast<std::uint16_t>(state >> 16);
                    const auto byte = static_cast<std::uint8_t>(code);
                    if (transfer == Encoding::Transfer::Linear)
                        return bits == 8 ? unitFrom8(byte) : unitFrom16(code);
                    return bits == 8 ? linearFromSrgb8(byte) : linearFromSrgb16(code);
                };
                for (Rgb& pixel : image.pixels()) pixel = {random(), random(), random()};
                const auto file = encodeImage(image, extension, {transfer, bits});
                const Image back(decodeImage(file, "round trip"), transfer);
                CHECK_INFO(back == image, extension << " " << bits << " bits");
            }
}

} // namespace test_ppm
