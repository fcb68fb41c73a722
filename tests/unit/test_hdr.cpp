// Code/image/hdr.cpp and hdr_header.cpp. The files in tests/scenes/hdr come from make.py there,
// most of them written by other programs, and all are the same picture.
#include "check.h"

#include "base/file_text.h"
#include "base/text.h"
#include "flipped_bytes.h"
#include "image/formats.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace test_hdr {

using namespace std::string_view_literals;

namespace {

constexpr int kWidth = 21, kHeight = 13;
using Floats = std::vector<float>;

// As in make.py.
float expectedAt(int x, int y, int c) {
    const int mantissa = (x / 3 * 37 + y * 11 + c * 83) % 256 | (c == y % 3 ? 128 : 0);
    return std::ldexp(static_cast<float>(mantissa), 120 + (x / 5 + y) % 17 - 136);
}

StoredImage decoded(std::string_view text) {
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    return decodeHdr(bytes, "test.hdr");
}
// A picture of one row with these scanline bytes.
StoredImage row(int width, std::string_view scanline, std::string_view variables = ""sv) {
    return decoded(cat("#?RADIANCE\n", variables, "\n-Y 1 +X ", width, "\n", scanline));
}
std::string copies(std::string_view text, int count) {
    std::string out;
    for (int i = 0; i < count; ++i) out += text;
    return out;
}

} // namespace

TEST(hdr_reads_what_other_programs_write) {
    const std::vector<std::string> names = flipped_bytes::filesIn("tests/scenes/hdr", ".hdr");
    CHECK_EQUAL(names.size(), 13u); // 8 orders of the pixels, 3 codes, another writer, an exposure
    for (const std::string& name : names) {
        const StoredImage image = decodeHdr(readWholeFile(name), name);
        CHECK_EQUAL(cat(image.width, "x", image.height, "x", image.channels), "21x13x3");
        CHECK(image.depth == StoredImage::Depth::Float && flipped_bytes::isSound(image));
        int wrong = 0;
        std::size_t i = 0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                for (int c = 0; c < 3; ++c) wrong += image.floats[i++] != expectedAt(x, y, c);
        CHECK_INFO(wrong == 0, name << ": " << wrong << " wrong samples");
    }
}

TEST(hdr_pixels_are_mantissas_times_a_power_of_two) {
    CHECK(row(1, "\x80\x40\x01\x80"sv).floats == (Floats{0.5f, 0.25f, 1.0f / 256}));
    CHECK(row(1, "\xFF\x00\x01\x88"sv).floats == (Floats{255, 0, 1}));
    CHECK(row(1, "\xFF\xFF\xFF\x00"sv).floats == (Floats{0, 0, 0})); // this exponent is black
    CHECK(row(1, "\x01\x00\xFF\x01"sv).floats ==
          (Floats{std::ldexp(1.0f, -135), 0, std::ldexp(255.0f, -135)}));
    CHECK(row(1, "\xFF\x80\x00\xFF"sv).floats ==
          (Floats{std::ldexp(255.0f, 119), std::ldexp(128.0f, 119), 0}));
}

// Exposures and colour corrections multiply each other, and are divided out; other lines do
// nothing.
TEST(hdr_exposure_divides) {
    constexpr std::string_view kPixel = "\x80\x40\x20\x88"; // 128, 64, 32
    CHECK(row(1, kPixel, "EXPOSURE=2\nEXPOSURE= 4.0e0 \r\n").floats == (Floats{16, 8, 4}));
    CHECK(row(1, kPixel, "COLORCORR=2 4\t0.5\nCOLORCORR= 1 2 1 \nEXPOSURE=.5\n").floats ==
          (Floats{128, 16, 128}));
    CHECK(row(1, kPixel, "EXPOSURE=3\n").floats == (Floats{128 / 3.0f, 64 / 3.0f, 32 / 3.0f}));
    CHECK(
        row(1, kPixel, "\tEXPOSURE=2\nexposure=2\nGAMMA=2\n= x\nVIEW= -vtv\nrpict -x 9\n").floats ==
        (Floats{128, 64, 32}));
}

TEST(hdr_headers_vary) {
    const StoredImage image =
        decoded("#?RGBE\r\nFORMAT= 32-bit_rle_rgbe \r\n\r\n-Y  1\t+X 2 \r\n\x01\x02\x03\x88\x04\x05"
                "\x06\x88 and something behind it");
    CHECK(image.floats == (Floats{1, 2, 3, 4, 5, 6}));
}

TEST(hdr_old_runs_have_digits) {
    constexpr std::string_view kFive = "\x05\x05\x05\x88"sv;
    const auto same = [](const StoredImage& image, std::size_t count) {
        return image.floats == Floats(3 * count, 5.0f);
    };
    CHECK(same(row(3, cat(kFive, "\x01\x01\x01\x02"sv)), 3));
    CHECK(same(row(4, cat(kFive, "\x01\x01\x01\x00"sv, kFive, "\x01\x01\x01\x02"sv)), 4));
    CHECK(same(row(1 + 3 + 2 * 256, cat(kFive, "\x01\x01\x01\x03\x01\x01\x01\x02"sv)), 516));
    // A pixel between two runs: both have the lowest digit.
    CHECK(same(row(7, cat(kFive, "\x01\x01\x01\x02"sv, kFive, "\x01\x01\x01\x03"sv)), 7));
    CHECK(same(row(65535, cat(kFive, "\x01\x01\x01\xFE\x01\x01\x01\xFF"sv)), 65535));
    // The lowest digits may be 0, up to one that is too much for any scanline.
    CHECK_THROWS(row(65535, cat(kFive, copies("\x01\x01\x01\x00"sv, 9), "\x01\x01\x01\x01"sv)),
                 "the scanline 1 has a run of 16777216 pixels; at most 65534 are left");
}

TEST(hdr_scanlines_choose_their_codes) {
    const std::string flat = copies("\x04\x06\x08\x88"sv, 8);
    const std::string_view packed = "\x02\x02\x00\x08\x88\x04\x88\x06\x88\x08\x88\x88"sv;
    const StoredImage image = decoded(cat("#?RADIANCE\n\n-Y 2 +X 8\n", flat, packed));
    Floats expected;
    for (int i = 0; i < 16; ++i) expected.insert(expected.end(), {4, 6, 8});
    CHECK(image.floats == expected);
    // Too narrow or too wide to be packed by channels; a mantissa that is no length.
    CHECK(row(1, "\x02\x02\x00\x88"sv).floats == (Floats{2, 2, 0}));
    const StoredImage eight = row(8, copies("\x02\x02\x80\x88"sv, 8));
    CHECK_EQUAL(eight.floats[2], 128.0f);
    const StoredImage wide = row(32768, "\x02\x02\x03\x88\x01\x01\x01\xFF\x01\x01\x01\x7F"sv);
    CHECK_EQUAL(wide.floats.back(), 3.0f);
}

TEST(hdr_refuses_broken_headers) {
    const auto start = [](std::string_view rest) { return decoded(cat("#?RADIANCE\n", rest)); };
    CHECK_THROWS(decoded("#?RAD\n\n"), "test.hdr:1:1: error: the file does not begin with");
    CHECK_THROWS(decoded("#?RADIANCE"), "the file ends in its header; the first line must follow");
    CHECK_THROWS(start("A=1\n"), "test.hdr:3:1: error: the file ends in its header; an empty line");
    CHECK_THROWS(start("\n-Y 1 +X 1"), ":3:1: error: the file ends in its header; the resolution");
    CHECK_THROWS(start("FORMAT=32-bit_rle_xyze\n\n"), ":2:1: error: the pixels are CIE colours");
    CHECK_THROWS(start("FORMAT=a\x1B"
                       "b c\n\n"),
                 "the format is 'a?b c'; it must be 32-bit_rle_rgbe");
    CHECK_THROWS(start("FORMAT=\n\n"), "the format is ''");
    for (const char* value : {"", "x", "0", "-1", "1 2", "1x", "nan", "inf", "1e31", "1e-31"})
        CHECK_THROWS(start(cat("EXPOSURE=", value, "\n\n")), cat("EXPOSURE is '", value, "'; it"));
    CHECK_THROWS(start("COLORCORR=1 2\n\n"), "it must be 3 numbers");
    CHECK_THROWS(start("COLORCORR=1 2 3 4\n\n"), "it must be 3 numbers");
    CHECK_THROWS(start("EXPOSURE=1e20\nEXPOSURE=1e20\n\n"), "together multiply by 1e+40");
    for (const char* resolution :
         {"", "-Y 1", "-Y 1 +X", "-Y 1 +X 1 1", "-Y 1 +Y 1", "+X 1 -X 1", "Y 1 X 1", "-Z 1 +X 1",
          "-Y a +X 1", "-Y 1 +X 1.5", "-Y 1 +X 99999999999999999999", "-Y1 +X1 2 3"})
        CHECK_THROWS(start(cat("\n", resolution, "\n")),
                     cat(":3:1: error: the resolution is '", resolution, "'"));
    CHECK_THROWS(start("\n-Y 0 +X 1\n"), "the size 1x0 is not possible");
    CHECK_THROWS(start("\n+X 65536 -Y 1\n"), "the size 65536x1 is not possible");
    CHECK_THROWS(start("\n-Y 65535 +X 65535\n"), "is too large");
}

TEST(hdr_refuses_broken_scanlines) {
    CHECK_THROWS(row(2, "\x01\x02\x03\x80\x01\x02\x03"sv),
                 "test.hdr: error: the scanline 1 is cut off: the file ends too early");
    CHECK_THROWS(row(2, "\x01\x01\x01\x02"sv), "begins with a run");
    CHECK_THROWS(row(2, "\x02\x01\x01\x80\x01\x01\x01\x02"sv), "has a run of 2 pixels; at most 1");
    CHECK_THROWS(row(8, "\x02\x02\x00\x09"sv), "the scanline 1 says that it has 9 pixels; 8");
    CHECK_THROWS(row(8, "\x02\x02\x00\x08\x00\x01"sv), "has 0 pixels where 8 are left");
    CHECK_THROWS(row(8, "\x02\x02\x00\x08\x89\x01"sv), "has 9 pixels where 8 are left");
    CHECK_THROWS(row(8, "\x02\x02\x00\x08\x86\x01\x03"sv), "has 3 pixels where 2 are left");
    CHECK_THROWS(row(8, "\x02\x02\x00\x08\x88\x01\x08\x01\x02"sv), "9 bytes must follow");
    // No memory is taken for the 2^28 pixels that are not there.
    CHECK_THROWS(decoded("#?RADIANCE\n\n-Y 16384 +X 16384\n\x02\x02\x40\x00"sv), "is cut off");
    CHECK_THROWS(row(1, "\x01\x02\xFF\xFF"sv, "COLORCORR=1 1 0.1\n"),
                 "the pixel 0,0 is 1.69477e+39, which no float can hold");
}

TEST(hdr_damaged_files_are_refused_or_sound) {
    flipped_bytes::Outcomes cut, changed;
    for (const std::string& name : flipped_bytes::filesIn("tests/scenes/hdr", ".hdr")) {
        const std::vector<std::uint8_t> whole = readWholeFile(name);
        flipped_bytes::cutOff(whole, decodeHdr, name, cut);
        flipped_bytes::change(whole, decodeHdr, name, check::scaled(150u), changed);
    }
    CHECK_EQUAL(cut.read, 0);
    std::printf("%d cut off; changed: %d read, %d refused\n", cut.refused, changed.read,
                changed.refused);
    CHECK_INFO(changed.read > 100 && changed.refused > 500, changed.read << ' ' << changed.refused);
}

} // namespace test_hdr
