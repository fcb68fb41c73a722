// JPEG files that are refused, and damaged ones: they give an Error or a picture that is whole.
#include "base/error.h"
#include "check.h"
#include "image/image.h"
#include "image/formats.h"
#include "jpeg_kit.h"
#include "unit/flipped_bytes.h"

#include <cstdio>
#include <random>
#include <string>

namespace test_jpeg_damage {

namespace {

using namespace jpeg_kit;

constexpr const char* kName = "test.jpg";

StoredImage decoded(const File& file) { return decodeJpeg(file, kName); }
bool isProgressive(const File& file) { return find(file, kProgressiveFrame) != file.size(); }

// False when the file is refused; an error and a picture are to be sound.
bool isRead(const File& file, const std::string& info) {
    try {
        const StoredImage image = decoded(file);
        const auto samples = static_cast<std::size_t>(image.width) *
                             static_cast<std::size_t>(image.height) *
                             static_cast<std::size_t>(image.channels);
        CHECK_INFO(image.width > 0 && image.height > 0 &&
                       (image.channels == 1 || image.channels == 3) &&
                       image.bytes.size() == samples && image.words.empty() && image.floats.empty(),
                   info);
        return true;
    } catch (const Error& error) {
        CHECK_INFO(error.kind() == ErrorKind::Input &&
                       std::string(error.what()).starts_with("test.jpg: error: "),
                   info << ": " << error.what());
    } catch (const std::exception& error) {
        CHECK_INFO(false, info << " threw " << error.what());
    }
    return false;
}

} // namespace

TEST(jpeg_cut_off_anywhere) {
    for (const std::string& name : fixtures()) {
        const File file = fixture(name);
        for (std::size_t size = 0; size < file.size();
             size = flipped_bytes::nextLength(size, file.size())) {
            // Without the marker EOI there may be more scans of a progressive picture.
            const bool isWhole = size + 2 >= file.size() && !isProgressive(file);
            const std::string info = name + " with " + std::to_string(size) + " bytes";
            const File part(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size));
            CHECK_INFO(isRead(part, info) == isWhole, info);
        }
    }
}

TEST(jpeg_random_damage) {
    int read = 0, refused = 0;
    for (const std::string& name : fixtures()) {
        const File whole = fixture(name);
        for (std::uint32_t seed = 0; seed < check::scaled(150u); ++seed) {
            std::mt19937 random(seed);
            File file = whole;
            for (auto flips = 1 + random() % 3; flips > 0; --flips)
                file[random() % file.size()] ^= static_cast<std::uint8_t>(1u << random() % 8);
            if (seed % 5 == 4) { // bytes less, or bytes again
                const std::size_t at = random() % file.size();
                const std::size_t count = std::min<std::size_t>(random() % 9, file.size() - at);
                const auto start = file.begin() + static_cast<std::ptrdiff_t>(at);
                const File piece(start, start + static_cast<std::ptrdiff_t>(count));
                if (random() % 2 == 0)
                    file.erase(start, start + static_cast<std::ptrdiff_t>(count));
                else
                    file = inserted(file, random() % file.size(), piece);
            }
            ++(isRead(file, name + ", seed " + std::to_string(seed)) ? read : refused);
        }
    }
    std::printf("%d JPEG pictures read, %d refused\n", read, refused);
    CHECK_INFO(read > 500 && refused > 500, "read " << read << ", refused " << refused);
}

TEST(jpeg_refuses_other_kinds_by_name) {
    const File file = fixture("444_baseline");
    const auto refused = [](const File& other, const char* words) {
        CHECK_THROWS(decoded(other), words);
    };
    refused(fixture("cmyk"), "test.jpg: error: the picture has four components (CMYK or YCCK); it "
                             "must be grey, YCbCr or RGB");
    refused(fixture("arithmetic"), "the picture is arithmetic-coded; it must be baseline");
    refused(changed(file, kFrame, 1, 0xC3), "the picture is lossless; it must be");
    refused(changed(file, kFrame, 1, 0xC5), "the picture is hierarchical; it must be");
    refused(changed(file, kFrame, 1, 0xCF), "the picture is hierarchical and arithmetic-coded");
    refused(inserted(file, 2, segment(0xDE, bytes({0}))), "the picture is hierarchical");
    refused(changed(file, kFrame, 4, 12), "the picture has 12 bits per sample; it must have 8");
    refused(changed(file, kFrame, 9, 2), "the picture has 2 components; it must have 1 or 3");
}

TEST(jpeg_says_what_is_wrong_with_a_header) {
    const File file = fixture("444_baseline"), progressive = fixture("420_progressive");
    const auto refused = [](const File& other, const char* words) {
        CHECK_THROWS(decoded(other), words);
    };
    const File frame(file.begin() + static_cast<std::ptrdiff_t>(find(file, kFrame)),
                     file.begin() + static_cast<std::ptrdiff_t>(find(file, kFrame) + 19));
    refused({}, "does not begin with the bytes FF D8");
    refused(bytes({0xFF, 0xD8}), "ends before the picture does (the marker EOI)");
    refused(bytes({0xFF, 0xD8, 0xFF, kEnd}), "ends before the frame header");
    refused(bytes({0xFF, 0xD8, 0xFF, 0xE0, 0, 1}), "has the length 1; at least 2");
    refused(inserted(file, find(file, kScan), frame), "there are two frame headers");
    refused(inserted(file, 2, bytes({0xFF, 0xD8, 0, 2})), "a second picture starts");
    refused(without(file, kFrame), "a scan comes before the frame header");
    refused(without(file, kSteps), "has the quantisation table 0, which is not in the file");
    refused(without(file, kHuffman), "(AC), which are not in the file before it");
    refused(changed(changed(file, kFrame, 5, 0), kFrame, 6, 0), "that the height comes later");
    refused(changed(file, kFrame, 8, 0), "the size 0x21 is not possible");
    refused(changed(file, kFrame, 5, 0xFF), "the file is too short for 37x65301 pixels");
    refused(changed(changed(file, kFrame, 5, 0xFF), kFrame, 7, 0xFF), "is too large; at most");
    refused(changed(file, kFrame, 11, 0x51), "has the sampling factors 5x1; each must be 1 to 4");
    refused(changed(file, kFrame, 11, 0x10), "has the sampling factors 1x0");
    refused(changed(file, kFrame, 12, 4), "has the quantisation table 4; 0 to 3");
    refused(changed(file, kFrame, 13, 1), "two components have the identifier 1");
    refused(changed(file, kSteps, 4, 0x24), "has the number 4 and the precision 2");
    refused(changed(file, kSteps, 4, 0x10), "the quantisation table 0 has 64 bytes; 128");
    refused(changed(file, kSteps, 9, 0), "a step of the quantisation table 0 is 0");
    refused(changed(file, kHuffman, 4, 0x20), "has the number 0 and the class 2");
    refused(changed(file, kHuffman, 10, 255), "codes, but 12 bytes for them");
    refused(changed(file, kHuffman, 5, 3), "codes");
    refused(changed(file, kScan, 4, 2), "a scan header has 10 bytes for 2 components");
    refused(changed(file, kScan, 5, 9), "a scan has the component 9, which is not in the frame");
    refused(changed(file, kScan, 7, 1), "a scan has the component 1 twice");
    refused(changed(file, kScan, 6, 0x50), "a scan has the Huffman tables 5 (DC) and 0 (AC)");
    refused(changed(progressive, kScan, 12, 5), "has the coefficients 0 to 5; it must have 0");
    refused(changed(progressive, kScan, 13, 0x0E), "from the bit 0 to 14; from 0 to at most 13");
    refused(changed(progressive, kScan, 13, 0x31), "from the bit 3 to 1; ");
    refused(changed(progressive, kScan, 13, 0x21), "repeats or leaves out bits of the");
}

// Scans of a hand-made picture of one block, in an order that the standard does not allow.
TEST(jpeg_refuses_scans_that_repeat_bits) {
    const File start = greyStart(kProgressiveFrame, 8, 8, 0, 0);
    const auto with = [&](std::initializer_list<File> scans) {
        File file = start;
        for (const File& one : scans) append(file, one);
        append(file, bytes({0xFF, kEnd}));
        return file;
    };
    const File data = bytes({0x7F}), dc = scan(0, 0, 0, 0, data), ac = scan(1, 63, 0, 1, data);
    CHECK(isRead(with({dc, ac, scan(1, 63, 1, 0, data)}), "in order"));
    CHECK_THROWS(decoded(with({})), "before all components have had a scan");
    CHECK_THROWS(decoded(with({ac, dc})), "has not the coefficient 0; it must");
    CHECK_THROWS(decoded(with({dc, dc})), "bits of the coefficient 0 of the component 1; each");
    CHECK_THROWS(decoded(with({dc, ac, ac})), "bits of the coefficient 1 of");
    CHECK_THROWS(decoded(with({dc, scan(5, 6, 0, 0, data), ac})), "of the coefficient 5 of");
    CHECK_THROWS(decoded(with({dc, scan(1, 63, 1, 0, data)})), "of the coefficient 1 of");
    CHECK_THROWS(decoded(with({dc, scan(9, 64, 0, 0, data)})), "the coefficients 9 to 64");
    CHECK_THROWS(decoded(with({dc, scan(9, 8, 0, 0, data)})), "the coefficients 9 to 8");
    File twice = greyStart(kFrame, 8, 8, 0, 0);
    append(twice, scan(0, 63, 0, 0, bytes({0x3F})));
    CHECK(isRead(twice, "one scan is all"));
}

// Codes and numbers that no picture needs.
TEST(jpeg_refuses_broken_scan_data) {
    const auto grey = [](unsigned frame, unsigned dc, unsigned ac, const File& scans) {
        File file = greyStart(frame, 8, 8, dc, ac);
        append(file, scans);
        append(file, bytes({0xFF, kEnd}));
        return decoded(file);
    };
    const File data(300, 0x2A), zeros(9, 0);
    CHECK_THROWS(grey(kFrame, 16, 0, scan(0, 63, 0, 0, data)), "a DC coefficient has 16 bits");
    CHECK_THROWS(grey(kFrame, 0, 0, scan(0, 63, 0, 0, File(3, 0x7F))), "there is no Huffman code");
    CHECK_THROWS(grey(kFrame, 0, 0xE1, scan(0, 63, 0, 0, zeros)), "number 75; at most 63");
    CHECK_THROWS(grey(kFrame, 0, 0, scan(0, 63, 0, 0, {})), "the data of a scan end too early");
    File both = scan(0, 0, 0, 0, data);
    append(both, scan(1, 9, 0, 13, zeros));
    CHECK_THROWS(grey(kProgressiveFrame, 0, 0x05, both), "; at most 32767");
    CHECK_THROWS(grey(kProgressiveFrame, 0, 0x91, both), "number 10; at most 9");
    CHECK_THROWS(grey(kProgressiveFrame, 15, 0, scan(0, 0, 0, 13, zeros)), "; at most 32767");
    File refined = scan(0, 0, 0, 0, data);
    append(refined, scan(1, 9, 0, 1, bytes({0x7F})));
    append(refined, scan(1, 9, 1, 0, zeros));
    CHECK_THROWS(grey(kProgressiveFrame, 0, 0x02, refined), "error");
}

} // namespace test_jpeg_damage
