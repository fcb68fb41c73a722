// Code/image/exr_header.cpp, exr_colour.cpp and exr_read.cpp. The files in tests/scenes/exr come
// from the OpenEXR library (make.py there).
#include "check.h"

#include "unit/exr_kit.h"

#include <limits>

namespace test_exr_read {

namespace {

using exr_kit::File;

// The picture in the file is `channels` planes of valueAt().
void checkPicture(const std::string& name, int width, int height, int channels) {
    const StoredImage image = decodeExr(exr_kit::fileOf(name), name);
    CHECK_INFO(image.width == width && image.height == height && image.channels == channels,
               name << ": " << image.width << " x " << image.height << " x " << image.channels);
    CHECK(image.depth == StoredImage::Depth::Float);
    const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                              static_cast<std::size_t>(channels);
    CHECK_INFO(image.floats.size() == count, name << " has " << image.floats.size() << " values");
    if (image.floats.size() != count) return;
    int wrong = 0;
    std::size_t i = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c)
                wrong += image.floats[i++] != exr_kit::valueAt(x, y, c);
    CHECK_INFO(wrong == 0, name << ": " << wrong << " wrong values");
}

void checkRefused(const File& file, const char* words) {
    CHECK_THROWS(decodeExr(file.bytes(), "a.exr"), words);
    CHECK_THROWS(decodeExr(file.bytes(), "a.exr"), "a.exr: error: ");
}

} // namespace

TEST(exr_compressions_and_types) {
    for (const std::string compression : {"none", "rle", "zips", "zip", "piz"})
        for (const std::string kind : {"lines", "tiles"}) {
            checkPicture(compression + "_half_" + kind, 33, 35, 3);
            checkPicture(compression + "_float_" + kind, 21, 19, 3);
        }
    checkPicture("rle_small", 13, 9, 3);
    checkPicture("channels_mixed_zip", 6, 5, 3);
    checkPicture("channels_mixed_piz", 6, 5, 3);
}

TEST(exr_sizes_windows_and_orders) {
    checkPicture("size_1x1", 1, 1, 4);
    checkPicture("size_1x5", 1, 5, 4);
    checkPicture("size_3x1", 3, 1, 4);
    checkPicture("size_2x17", 2, 17, 4);
    for (const char* name : {"order_increasing", "order_decreasing", "order_increasing_tiles",
                             "order_decreasing_tiles", "order_random_tiles"})
        checkPicture(name, 33, 35, 3);
}

TEST(exr_levels) {
    checkPicture("levels_mipmap", 13, 9, 3);
    checkPicture("levels_ripmap", 13, 9, 3);
}

TEST(exr_layers_and_parts) {
    checkPicture("channels_y", 6, 5, 1);
    checkPicture("channels_ya", 6, 5, 2);
    checkPicture("channels_rgba", 6, 5, 4);
    checkPicture("layers_plain", 6, 5, 4);
    checkPicture("layers_prefix", 6, 5, 4);
    checkPicture("layers_order", 6, 5, 3); // "a", not "a-b", whose names come first
    checkPicture("layers_long_name", 6, 5, 3);
    checkPicture("parts_colour", 33, 35, 4);
    checkPicture("parts_grey", 6, 5, 1);
}

// All numbers from 1 to 16384 as HALFs: the wavelet works modulo 2^16.
TEST(exr_piz_of_many_numbers) {
    const StoredImage image = decodeExr(exr_kit::fileOf("piz_ramp"), "ramp");
    CHECK_EQUAL(image.floats.size(), std::size_t{16384});
    int wrong = 0;
    for (int i = 0; i < static_cast<int>(image.floats.size()); ++i) {
        const int half = i + 1, exponent = half >> 10, fraction = half & 1023;
        const float right = exponent == 0
                                ? std::ldexp(static_cast<float>(fraction), -24)
                                : std::ldexp(static_cast<float>(fraction + 1024), exponent - 25);
        wrong += image.floats[static_cast<std::size_t>(i)] != right;
    }
    CHECK_EQUAL(wrong, 0);
}

TEST(exr_special_numbers) {
    constexpr float kMax = std::numeric_limits<float>::max();
    const std::vector<float> half = decodeExr(exr_kit::fileOf("special_half"), "half").floats;
    CHECK(half == (std::vector<float>{kMax, -kMax, 0, -0.0f, 65504, 0x1p-24f}));
    CHECK(std::signbit(half[3]));
    const std::vector<float> single = decodeExr(exr_kit::fileOf("special_float"), "float").floats;
    CHECK(single == (std::vector<float>{kMax, -kMax, 0, -0.0f, kMax, 0x1p-149f}));
    CHECK(std::signbit(single[3]));
}

TEST(exr_made_byte_by_byte) {
    const StoredImage image = decodeExr(File{}.bytes(), "a.exr");
    CHECK(image.floats == (std::vector<float>{1, 2}));
    // Values are sorted by name, the list is not.
    const File swapped{.channels = {{"Y"}, {"A"}}, .x1 = 0};
    CHECK(decodeExr(swapped.bytes(), "a.exr").floats == (std::vector<float>{2, 1}));
    // The largest corner that there is; and a tile, larger than the picture.
    constexpr std::int32_t kLast = std::numeric_limits<std::int32_t>::max();
    const File far{
        .x0 = kLast - 1, .y0 = kLast, .x1 = kLast, .y1 = kLast, .place = {255, 255, 255, 127}};
    CHECK(decodeExr(far.bytes(), "a.exr").floats == image.floats);
    File tiled{.version = 0x202, .tiles = {255, 255, 255, 255, 8, 0, 0, 0, 0}};
    tiled.place.assign(16, 0);
    CHECK(decodeExr(tiled.bytes(), "a.exr").floats == image.floats);
}

TEST(exr_refuses_what_is_not_read) {
    std::vector<exr_kit::Channel> many; // of which twelve are named
    for (char name = 't'; name >= 'a'; --name) many.push_back({std::string(1, name)});
    const std::vector<std::string> compressions{"PXR24",    "B44",     "B44A", "DWAA", "DWAB",
                                                "HTJ2K256", "HTJ2K32", "LJ2K", "ZSTD", "number 14"};
    for (unsigned i = 0; i < compressions.size(); ++i)
        checkRefused({.compression = 5 + i},
                     ("the compression " + compressions[i] + " is not read").c_str());
    checkRefused({.version = 0x802}, "deep data");
    checkRefused({.channels = {{"BY", 1, 2}, {"RY", 1, 2}, {"Y"}}}, "luminance-chroma");
    checkRefused({.channels = {{"Y"}, {"Z", 1, 2}}}, "the channel Z is subsampled");
    checkRefused({.channels = {{"Y", 0}}}, "there is no colour");
    checkRefused({.channels = {{"B"}, {"G"}, {"Z\n"}}}, "the channels are: B, G, Z?");
    checkRefused({.channels = many}, "a, b, c, d, e, f, g, h, i, j, k, l, ...");
    checkRefused({.channels = {}}, "the channels are: none");
    checkRefused({.version = 1}, "the version of OpenEXR is 1; only 2 is read");
    checkRefused({.version = 0x2002}, "unknown flags 8192");
}

TEST(exr_refuses_wrong_headers) {
    checkRefused({.magic = 1}, "this is no OpenEXR file");
    checkRefused({.without = "channels"}, "there is no colour");
    checkRefused({.without = "compression"}, "the attribute compression is missing");
    checkRefused({.without = "dataWindow"}, "the attribute dataWindow is missing");
    checkRefused({.version = 0x202}, "the attribute tiles is missing");
    checkRefused({.version = 0x202, .tiles = {0, 0, 0, 0, 1, 0, 0, 0, 0}}, "the tiles have 0x1");
    checkRefused({.version = 0x202, .tiles = {1, 0, 0, 0}}, "is a tiledesc of 4 bytes; it must");
    checkRefused({.channels = {{"Y"}, {"A"}, {"Y"}}}, "two channels are called Y");
    checkRefused({.channels = {{"Y", 3}}}, "the channel Y has the type 3");
    checkRefused({.channels = {{std::string(256, 'n')}}}, "does not end; at most 255 bytes");
    checkRefused({.x1 = -1}, "the size 0x1 is not possible");
    constexpr std::int32_t kFirst = std::numeric_limits<std::int32_t>::min();
    checkRefused({.x0 = kFirst, .x1 = std::numeric_limits<std::int32_t>::max()},
                 "the size 4294967296x1");
    checkRefused({.x1 = 16383, .y1 = 16383}, "too short for the offsets of 16384 blocks");
    checkRefused(
        {.version = 0x202, .x1 = 16383, .y1 = 16383, .tiles = {0, 64, 0, 0, 0, 64, 0, 0, 0}},
        "cannot hold 536870912");
}

TEST(exr_refuses_wrong_blocks) {
    checkRefused({.place = {1, 0, 0, 0}}, "another one is at its offset");
    checkRefused({.pixels = {0, 0, 0}}, "the block 0,0 is missing: 3 bytes cannot hold 4");
    checkRefused({.compression = 1, .pixels = {0, 0, 0, 0, 0}}, "a block has 5 bytes");
    checkRefused({.compression = 1, .pixels = {0xFE, 0}}, "it ends in the middle of a run");
    checkRefused({.compression = 1, .pixels = {4, 0}}, "it unpacks to more than 4 bytes");
    checkRefused({.compression = 1, .pixels = {2, 0}}, "it unpacks to 3 bytes instead of 4");
    checkRefused({.compression = 3, .pixels = {0x78, 0x5E, 3}}, "broken compressed data");
    checkRefused({.compression = 4, .pixels = {0, 0, 0}}, "it ends in the middle of its header");
    exr_kit::Buffer cut = File{}.bytes();
    cut.pop_back();
    CHECK_THROWS(decodeExr(cut, "a.exr"), "the file ends in the middle of it");
    cut.resize(cut.size() - 8);
    CHECK_THROWS(decodeExr(cut, "a.exr"), "is not in the file; the file is cut off");
}

} // namespace test_exr_read
