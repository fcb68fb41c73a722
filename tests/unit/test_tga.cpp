// Code/image/tga.cpp. The files in tests/scenes/tga come from make.py there; Pillow wrote some.
#include "check.h"

#include "base/file_text.h"
#include "base/text.h"
#include "flipped_bytes.h"
#include "image/formats.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace test_tga {

using namespace std::string_view_literals;

namespace {

constexpr int kWidth = 19, kHeight = 7, kEntries = 21;
using Samples = std::vector<std::uint8_t>;

// As in make.py.
int sampleAt(int x, int y, int c) {
    return (x / 4 * 29 + y * 53 + c * 97 + (x == 9 ? y * c : 0)) % 256;
}
int entryAt(int i, int c) { return (i * 41 + c * 71) % 256; }

// What the name of a file says.
struct Kind {
    int type = 0, bits = 0, attributes = 0, mapBits = 0;

    bool isGrey() const { return type % 8 == 3; }
    bool isMapped() const { return type % 8 == 1; }
    int colourBits() const { return isMapped() ? mapBits : bits; }
    int colours() const { return isGrey() ? 1 : 3; }
    bool hasAlpha() const { return attributes != 0; }
};

// Channel c of a pixel, 3 for alpha.
int expectedAt(const Kind& kind, int x, int y, int c) {
    const int value = kind.isMapped() ? entryAt((x / 3 + y * 5) % kEntries, c) : sampleAt(x, y, c);
    if (kind.isGrey() || kind.colourBits() > 16) return value;
    return c == 3 ? value / 128 * 255 : value / 8 * 255 / 31;
}

// A file with this header and nothing in it but what is given.
struct Header {
    std::uint8_t type, bits;
    std::uint8_t width = 1, height = 1, descriptor = 0x20;
    std::uint8_t mapType = 0, mapFirst = 0, mapLength = 0, mapBits = 0;
};
Samples fileOf(const Header& header, std::initializer_list<int> rest = {}) {
    Samples file{0, header.mapType,   header.type, header.mapFirst,
                 0, header.mapLength, 0,           header.mapBits};
    file.insert(file.end(), {0, 0, 0, 0, header.width, 0, header.height, 0, header.bits});
    file.push_back(header.descriptor);
    for (const int byte : rest) file.push_back(static_cast<std::uint8_t>(byte));
    return file;
}
Samples decoded(const Header& header, std::initializer_list<int> rest) {
    return decodeTga(fileOf(header, rest), "test.tga").bytes;
}

} // namespace

TEST(tga_reads_every_type_size_and_origin) {
    const std::vector<std::string> names = flipped_bytes::filesIn("tests/scenes/tga", ".tga");
    CHECK_EQUAL(names.size(), 52u);
    for (const std::string& name : names) {
        Kind kind;
        const std::string kindName = std::filesystem::path(name).filename().string();
        // NOLINTNEXTLINE(cert-err34-c): these names are ours
        const int found = std::sscanf(kindName.c_str(), "t%d_%d_a%d_m%d_", &kind.type, &kind.bits,
                                      &kind.attributes, &kind.mapBits);
        CHECK_EQUAL(found, 4);
        const std::vector<std::uint8_t> file = readWholeFile(name);
        CHECK_INFO(looksLikeTga(file), name);
        const StoredImage image = decodeTga(file, name);
        const int channels = kind.colours() + (kind.hasAlpha() ? 1 : 0);
        CHECK_EQUAL(cat(image.width, "x", image.height, "x", image.channels),
                    cat(kWidth, "x", kHeight, "x", channels));
        CHECK(image.depth == StoredImage::Depth::Bits8 && flipped_bytes::isSound(image));
        int wrong = 0;
        std::size_t i = 0;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                for (int c = 0; c < channels; ++c)
                    wrong +=
                        image.bytes[i++] != expectedAt(kind, x, y, c == kind.colours() ? 3 : c);
        CHECK_INFO(wrong == 0, name << ": " << wrong << " wrong samples");
    }
}

TEST(tga_origins_turn_the_picture) {
    const auto from = [](int origin) {
        Header header{3, 8, 3, 2};
        header.descriptor = static_cast<std::uint8_t>(origin << 4);
        return decoded(header, {1, 2, 3, 4, 5, 6});
    };
    CHECK(from(2) == (Samples{1, 2, 3, 4, 5, 6}));
    CHECK(from(0) == (Samples{4, 5, 6, 1, 2, 3}));
    CHECK(from(3) == (Samples{3, 2, 1, 6, 5, 4}));
    CHECK(from(1) == (Samples{6, 5, 4, 3, 2, 1}));
}

TEST(tga_packets_go_across_rows) {
    CHECK(decoded({11, 8, 3, 3}, {0x81, 7, 0x02, 1, 2, 3, 0x83, 9}) ==
          (Samples{7, 7, 1, 2, 3, 9, 9, 9, 9}));
    CHECK(decoded({10, 24, 128, 2}, {0xFF, 1, 2, 3, 0xFF, 4, 5, 6}).back() == 4);
}

// The bits beyond the colour are alpha only if the descriptor has their number.
TEST(tga_alpha_is_what_the_descriptor_says) {
    const auto pixel = [](int bits, int attributes) {
        Header header{2, static_cast<std::uint8_t>(bits)};
        header.descriptor = static_cast<std::uint8_t>(attributes);
        return decoded(header, {0x1F, 0x80, 3, 4});
    };
    CHECK(pixel(32, 8) == (Samples{3, 0x80, 0x1F, 4}));
    CHECK(pixel(32, 0) == (Samples{3, 0x80, 0x1F}));
    CHECK(pixel(24, 8) == (Samples{3, 0x80, 0x1F}));
    CHECK(pixel(16, 1) == (Samples{0, 0, 255, 255}));
    CHECK(pixel(16, 0) == (Samples{0, 0, 255}));
    CHECK(pixel(15, 1) == (Samples{0, 0, 255}));
}

TEST(tga_five_bits_become_eight) {
    for (int five = 0; five < 32; ++five) {
        const Samples green = decoded({2, 16}, {five << 5 & 0xE0, five >> 3});
        CHECK_EQUAL(int{green[1]}, five * 255 / 31);
    }
}

TEST(tga_colour_maps_begin_anywhere) {
    const Header header{1, 8, 2, 1, 0x20, 1, 10, 2, 24};
    CHECK(decoded(header, {1, 2, 3, 4, 5, 6, 11, 10}) == (Samples{6, 5, 4, 3, 2, 1}));
    CHECK_THROWS(decoded(header, {1, 2, 3, 4, 5, 6, 9, 10}),
                 "test.tga: error: a pixel has colour 9, but the colour map has only 10 to 11");
    CHECK_THROWS(decoded(header, {1, 2, 3, 4, 5, 6, 10, 12}), "a pixel has colour 12");
    // Beside true colours the map is skipped.
    CHECK(decoded({2, 24, 1, 1, 0x20, 1, 0, 2, 16}, {0, 0, 0, 0, 1, 2, 3}) == (Samples{3, 2, 1}));
}

TEST(tga_refuses_other_files) {
    const auto read = [](const Header& header, std::initializer_list<int> rest = {}) {
        decodeTga(fileOf(header, rest), "test.tga");
    };
    CHECK_THROWS(decodeTga(Samples(17), "test.tga"),
                 "error: the file is too short for a TGA header");
    CHECK_THROWS(read({0, 24}), "a TGA file without a picture");
    CHECK_THROWS(read({32, 8}), "Huffman, delta and run-length codes (type 32)");
    CHECK_THROWS(read({33, 8}), "(type 33)");
    CHECK_THROWS(read({4, 8}), "the TGA type is 4; it must be 1, 2, 3, 9, 10 or 11");
    CHECK_THROWS(read({8, 8}), "the TGA type is 8");
    CHECK_THROWS(read({2, 8}), "pixels of TGA type 2 have 8 bits; it must be 15, 16, 24 or 32");
    CHECK_THROWS(read({11, 24}), "pixels of TGA type 11 have 24 bits; it must be 8 or 16");
    CHECK_THROWS(read({2, 24, 1, 1, 0, 2}), "the colour map type is 2; it must be 0 or 1");
    CHECK_THROWS(read({1, 8}), "the colour map has 0 entries of 0 bits");
    CHECK_THROWS(read({9, 8, 1, 1, 0, 1, 0, 5, 8}), "the colour map has 5 entries of 8 bits");
    CHECK_THROWS(read({2, 24, 1, 1, 0x40}), "interleaved");
    CHECK_THROWS(read({2, 24, 0, 1}), "the size 0x1 is not possible");
    CHECK_THROWS(read({1, 8, 1, 1, 0, 1, 0, 2, 24}, {1, 2, 3, 4, 5}),
                 "too short for its colour map");
    CHECK_THROWS(read({2, 24, 2, 1}, {1, 2, 3, 4, 5}),
                 "the file is too short for its pixels: it has 23 bytes; 6 must follow byte 18");
    CHECK_THROWS(read({11, 8, 200, 200}, {0xFF, 1, 0xFF, 2}), "626 must follow byte 18");
    CHECK_THROWS(read({11, 8, 3, 1}, {0x82}), "too short for its pixels");
    CHECK_THROWS(read({11, 8, 3, 1}, {0x80, 1}), "too short for a packet");
    CHECK_THROWS(read({11, 8, 3, 1}, {0x02, 1, 2}), "3 must follow byte 19");
    CHECK_THROWS(read({11, 8, 3, 1}, {0x83, 1}), "a packet has 4 pixels; at most 3 are left");
}

TEST(tga_looks_like_other_files_no) {
    CHECK(looksLikeTga(fileOf({2, 24})));
    CHECK(looksLikeTga(fileOf({9, 8, 1, 1, 0, 1, 0, 5, 16})));
    for (const Header& header : std::initializer_list<Header>{{0, 24},
                                                              {4, 24},
                                                              {32, 24},
                                                              {2, 8},
                                                              {3, 24},
                                                              {1, 8},
                                                              {2, 24, 0, 1},
                                                              {2, 24, 1, 0},
                                                              {2, 24, 1, 1, 0xC0},
                                                              {2, 24, 1, 1, 0, 2}})
        CHECK(!looksLikeTga(fileOf(header)));
    CHECK(!looksLikeTga(Samples(17)));
    Samples signedFile = fileOf({33, 8}); // has the signature, and is refused by its name
    for (const char c : "TRUEVISION-XFILE."sv) signedFile.push_back(static_cast<std::uint8_t>(c));
    CHECK(!looksLikeTga(signedFile));
    signedFile.push_back(0);
    CHECK(looksLikeTga(signedFile));
    for (const char* name : {"tests/scenes/png/c2_08_n.png", "tests/scenes/hdr/opencv_rle.hdr",
                             "tests/scenes/everything.txt"})
        CHECK(!looksLikeTga(readWholeFile(name)));
}

TEST(tga_damaged_files_are_refused_or_sound) {
    flipped_bytes::Outcomes cut, changed;
    for (const std::string& name : flipped_bytes::filesIn("tests/scenes/tga", ".tga")) {
        const std::vector<std::uint8_t> whole = readWholeFile(name);
        flipped_bytes::cutOff(whole, decodeTga, name, cut);
        flipped_bytes::change(whole, decodeTga, name, check::scaled(60u), changed);
    }
    std::printf("cut off: %d read, %d refused; changed: %d read, %d refused\n", cut.read,
                cut.refused, changed.read, changed.refused);
    CHECK_INFO(cut.refused > 10 * cut.read, cut.read << ' ' << cut.refused); // without the footer
    CHECK_INFO(changed.read > 100 && changed.refused > 500, changed.read << ' ' << changed.refused);
}

} // namespace test_tga
