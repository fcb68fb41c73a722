// Code/image/jpeg_*.cpp. The files in tests/scenes/jpeg come from make.py there, other
// implementations; what makes them unreadable is in test_jpeg_damage.cpp.
#include "check.h"

#include "base/text.h"
#include "image/image.h"
#include "image/formats.h"
#include "jpeg_kit.h"

#include <filesystem>
#include <string>

namespace test_jpeg {

namespace {

using namespace jpeg_kit;

StoredImage decoded(const File& file) { return decodeJpeg(file, "test.jpg"); }

} // namespace

TEST(jpeg_gives_the_same_samples_as_libjpeg) {
    const std::vector<std::string> names = fixtures();
    CHECK_EQUAL(names.size(), 26u);
    for (const std::string& name : names) {
        const StoredImage image = decodeJpeg(fixture(name), name);
        const std::string stem = "tests/scenes/jpeg/" + name;
        const bool isGrey = std::filesystem::exists(stem + ".pgm");
        const StoredImage expected = readStoredImage(stem + (isGrey ? ".pgm" : ".ppm"));
        CHECK_EQUAL(cat(name, " ", image.width, "x", image.height, "x", image.channels),
                    cat(name, " ", expected.width, "x", expected.height, "x", isGrey ? 1 : 3));
        CHECK_INFO(image.depth == StoredImage::Depth::Bits8 && image.bytes == expected.bytes, name);
    }
}

TEST(jpeg_skips_what_is_not_the_picture) {
    for (const char* name : {"420_baseline", "420_progressive", "three_scans"}) {
        const File file = fixture(name);
        const auto expected = decoded(file).bytes;
        for (const unsigned marker : {kHuffman, kScan}) {
            const std::size_t at = find(file, marker);
            for (const File& piece :
                 {bytes({0xFF, 0xFF}), bytes({1, 2, 3}), bytes({0x12, 0xFF, 0}), bytes({0xFF, 1}),
                  bytes({0xFF, 0xD3}), segment(0xFE, bytes({'h', 'i'})),
                  segment(kExif, bytes({'E', 'x', 'i', 'f', 0, 0}))})
                CHECK_INFO(decoded(inserted(file, at, piece)).bytes == expected,
                           name << ", " << int{piece[0]} << ' ' << int{piece[1]});
        }
        File longer = file;
        append(longer, bytes({0, 0xFF, 0xD8, 0xFF, 0xC0, 9}));
        CHECK_INFO(decoded(longer).bytes == expected, name);
        // The marker EOI may have fill bytes, and what comes before it may mean nothing.
        CHECK_INFO(decoded(inserted(file, file.size() - 2, bytes({0xFF, 0xFF}))).bytes == expected,
                   name);
        CHECK_INFO(decoded(inserted(file, file.size() - 2, bytes({7, 8}))).bytes == expected, name);
    }
}

// The largest interval is longer than the picture, and the restart markers are not missed.
TEST(jpeg_restart_interval_zero_and_large_are_none) {
    const File file = fixture("420_baseline");
    const auto expected = decoded(file).bytes;
    for (const unsigned interval : {0u, 6u, 0xFFFFu}) {
        const File with = inserted(file, find(file, kScan),
                                   segment(kInterval, bytes({interval >> 8, interval & 255})));
        CHECK_INFO(decoded(with).bytes == expected, interval);
    }
    const File one = inserted(file, find(file, kScan), segment(kInterval, bytes({0, 1})));
    CHECK_THROWS(decoded(one), "test.jpg: error: the restart marker 0 is missing");
}

TEST(jpeg_colours_are_ycc_or_rgb) {
    const File both = fixture("rgb"); // an Adobe segment and the identifiers R, G, B
    const auto rgb = decoded(both).bytes;
    const File byIds = without(both, kAdobe);
    CHECK(decoded(byIds).bytes == rgb);
    const auto renamed = [](File file) {
        for (unsigned c = 0; c < 3; ++c) {
            file = changed(file, kFrame, 10 + 3 * c, c + 1);
            file = changed(file, kScan, 5 + 2 * c, c + 1);
        }
        return file;
    };
    CHECK(decoded(renamed(both)).bytes == rgb);
    const auto ycc = decoded(renamed(byIds)).bytes;
    CHECK(ycc != rgb);
    CHECK(decoded(changed(both, kAdobe, 15, 1)).bytes == ycc);
    const File jfif = segment(kJfif, bytes({'J', 'F', 'I', 'F', 0, 1, 1, 0, 0, 1, 0, 1, 0, 0}));
    CHECK(decoded(inserted(both, 2, jfif)).bytes == ycc);
}

// A DC coefficient of 8 is a sample more than 128 when the steps are 8.
TEST(jpeg_hand_made_blocks) {
    File flat = greyStart(kFrame, 9, 3, 0, 0); // two blocks: no difference, and the end
    append(flat, scan(0, 63, 0, 0, bytes({0x0F})));
    const StoredImage image = decoded(flat);
    CHECK_EQUAL(cat(image.width, "x", image.height, "x", image.channels), "9x3x1");
    CHECK(image.bytes == std::vector<std::uint8_t>(27, 128));
    File steps = greyStart(kFrame, 9, 3, 1, 0); // 0 1 0: one more; 0 0 0: one less
    append(steps, scan(0, 63, 0, 0, bytes({0b01000011})));
    const auto samples = decoded(steps).bytes;
    CHECK(samples[0] == 129 && samples[7] == 129 && samples[8] == 128);

    // 2 bits, then one more: 0b11 << 3 | 1 << 2.
    File progressive = greyStart(kProgressiveFrame, 8, 8, 2, 0);
    append(progressive, scan(0, 0, 0, 3, bytes({0b01111111})));
    append(progressive, scan(0, 0, 3, 2, bytes({0b11111111})));
    append(progressive, bytes({0xFF, kEnd}));
    // A bit that is 0xFF in the file is followed by a zero byte.
    CHECK_THROWS(decoded(progressive), "error");
    const std::size_t end = progressive.size() - 2;
    CHECK_EQUAL(int{decoded(inserted(progressive, end, bytes({0}))).bytes[0]}, 128 + 28);
}

// Each coefficient and bit of a block may have a scan of its own, but no more scans than 200.
TEST(jpeg_counts_scans) {
    const auto withScans = [](unsigned bands) {
        File file = greyStart(kProgressiveFrame, 8, 8, 0, 0);
        append(file, scan(0, 0, 0, 0, bytes({0x7F})));
        unsigned scans = 1;
        for (unsigned low = 5; low <= 5; --low)
            for (unsigned k = 1; k < 64 && scans < bands; ++k, ++scans)
                append(file, scan(k, k, low == 5 ? 0 : low + 1, low, bytes({0x7F})));
        append(file, bytes({0xFF, kEnd}));
        return file;
    };
    CHECK(decoded(withScans(200)).bytes == std::vector<std::uint8_t>(64, 128));
    CHECK_THROWS(decoded(withScans(201)), "more than 200 scans");
}

} // namespace test_jpeg
