// Code/image/exr_write.cpp and exr_half.h. (Compared once with the OpenEXR library, which read 288
// files of encodeExr() bit for bit.)
#include "check.h"

#include "image/exr_half.h"
#include "unit/exr_kit.h"

#include <limits>
#include <random>

namespace test_exr_write {

namespace {

using exr_kit::Buffer;

Buffer encode(std::span<const ExrLayer> layers, int width, int height, bool half, int threads) {
    Buffer file;
    encodeExr(layers, width, height, half, threads,
              [&](Bytes piece) { file.insert(file.end(), piece.begin(), piece.end()); });
    return file;
}

// Smooth in the left half, and any finite numbers in the right one.
std::vector<float> valuesOf(int width, int height, int channels) {
    std::mt19937 random(5);
    std::vector<float> values;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < channels; ++c) {
                const auto any = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
                const bool isSmooth = 2 * x <= width || !std::isfinite(any);
                values.push_back(isSmooth ? exr_kit::valueAt(x, y, c) : any);
            }
    return values;
}

} // namespace

TEST(exr_half_of_every_half) {
    int wrong = 0;
    for (std::uint32_t bits = 0; bits < 65536; ++bits) {
        const auto half = static_cast<std::uint16_t>(bits);
        const std::uint32_t exponent = bits >> 10 & 31, fraction = bits & 1023;
        const float value = floatFromHalf(half);
        if (exponent == 31) {
            wrong += fraction == 0 ? !std::isinf(value) : !std::isnan(value);
            wrong += std::signbit(value) != (bits >> 15 != 0);
            continue;
        }
        const int power = exponent == 0 ? -24 : static_cast<int>(exponent) - 25;
        const float whole = static_cast<float>(exponent == 0 ? fraction : fraction + 1024);
        const float right = std::copysign(std::ldexp(whole, power), bits >> 15 != 0 ? -1.0f : 1.0f);
        wrong += value != right || std::signbit(value) != std::signbit(right);
        wrong += halfFromFloat(value) != half;
    }
    CHECK_EQUAL(wrong, 0);
}

// Between two neighbours the nearest counts, and in the middle the even one.
TEST(exr_half_rounds_to_nearest_even) {
    int wrong = 0;
    for (std::uint16_t half = 0; half < 0x7BFF; ++half) {
        const auto next = static_cast<std::uint16_t>(half + 1);
        const float middle = (floatFromHalf(half) + floatFromHalf(next)) / 2; // exact
        const auto even = static_cast<std::uint16_t>(half % 2 == 0 ? half : next);
        for (const unsigned sign : {0u, 0x8000u}) {
            const auto rounded = [&](float value) {
                return halfFromFloat(sign != 0 ? -value : value) ^ sign;
            };
            wrong += rounded(middle) != even;
            wrong += rounded(std::nextafter(middle, 0.0f)) != half;
            wrong += rounded(std::nextafter(middle, 1e9f)) != next;
        }
    }
    CHECK_EQUAL(wrong, 0);
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    for (const float large : {65504.0f, 65519.9f, 65520.0f, 1e30f, kInfinity}) {
        CHECK_EQUAL(halfFromFloat(large), 0x7BFF);
        CHECK_EQUAL(halfFromFloat(-large), 0xFBFF);
    }
    CHECK(std::isnan(floatFromHalf(halfFromFloat(std::nanf("")))));
    CHECK_EQUAL(halfFromFloat(0x1p-149f), 0);
    CHECK_EQUAL(halfFromFloat(-0.0f), 0x8000);
}

TEST(exr_write_reads_back) {
    const int sizes[][2] = {{1, 1}, {1, 33}, {70, 1}, {16, 16}, {37, 50}};
    for (const auto& [width, height] : sizes) {
        const std::vector<float> values = valuesOf(width, height, 3);
        const std::vector<float> depth = valuesOf(width, height, 1);
        const std::vector<ExrLayer> layers{{"depth", {"Z"}, depth}, {"", {"R", "G", "B"}, values}};
        for (const bool half : {false, true}) {
            const Buffer file = encode(layers, width, height, half, 1);
            CHECK(encode(layers, width, height, half, 4) == file);
            const StoredImage image = decodeExr(file, "a.exr");
            CHECK(image.width == width && image.height == height && image.channels == 3);
            std::vector<float> right = values;
            if (half)
                for (float& value : right) value = floatFromHalf(halfFromFloat(value));
            CHECK_INFO(image.floats == right, width << " x " << height << ", " << half);
        }
    }
}

// A grey picture of 2 x 17 pixels: where everything is in the file.
TEST(exr_write_layout) {
    const std::vector<float> values(34, 1.0f);
    const Buffer file = encode(std::vector<ExrLayer>{{"", {"Y"}, values}}, 2, 17, true, 1);
    exr_kit::File like{.compression = 3, .y1 = 16};
    const Buffer start = like.bytes();
    // The header begins as that of the kit: magic number, version, channels, compression, window.
    const std::size_t same = start.size() - like.pixels.size() - 8 - 8 - 1;
    CHECK(file.size() > same &&
          std::equal(start.begin(), start.begin() + static_cast<long>(same), file.begin()));
    // The last block is one row of 4 bytes, which do not shrink.
    Buffer end;
    exr_kit::put(end, 16, 4);
    exr_kit::put(end, 4, 4);
    exr_kit::put(end, 0x3C003C00, 4);
    CHECK(std::equal(end.rbegin(), end.rend(), file.rbegin()));
    Buffer offset; // of the last block
    exr_kit::put(offset, file.size() - end.size(), 8);
    CHECK(std::search(file.begin(), file.end(), offset.begin(), offset.end()) != file.end());
}

TEST(exr_write_names) {
    const std::vector<float> one(1, 0.5f), three{1, 2, 3};
    const std::string layer(60, 'n');
    const std::vector<ExrLayer> layers{{layer, {"B", "G", "R"}, three}, {"a", {"Z"}, one}};
    const Buffer file = encode(layers, 1, 1, false, 1);
    CHECK_EQUAL(file[5], 4); // long names
    CHECK(decodeExr(file, "a.exr").floats == (std::vector<float>{3, 2, 1}));
    const std::string text(file.begin(), file.end());
    CHECK(text.find("a.Z") < text.find(layer + ".B"));
    CHECK(text.find(layer + ".B") < text.find(layer + ".G"));
    const Buffer plain = encode(std::vector<ExrLayer>{{"", {"Y"}, one}}, 1, 1, false, 1);
    CHECK_EQUAL(plain[5], 0);
}

// What is no number is 0 in a picture, which says where the first one is; alpha is no colour.
TEST(exr_says_where_a_colour_is_no_number) {
    std::vector<float> values(4 * 3 * 4, 0.5f);
    const float none = std::nanf("");
    const auto decoded = [&] {
        const std::vector<ExrLayer> layers{{"", {"R", "G", "B", "A"}, values}};
        return decodeExr(encode(layers, 4, 3, false, 1), "a.exr");
    };
    CHECK(!decoded().noNumber);
    values[(1 * 4 + 1) * 4 + 3] = none;
    CHECK(!decoded().noNumber);
    values[(2 * 4 + 3) * 4] = none, values[(2 * 4 + 0) * 4 + 2] = none;
    const StoredImage image = decoded();
    CHECK_EQUAL(image.noNumber.value_or(0), std::size_t{(2 * 4 + 0) * 4 + 2});
    CHECK(image.floats[(2 * 4 + 0) * 4 + 2] == 0 && image.floats[(1 * 4 + 1) * 4 + 3] == 0);
}

TEST(exr_write_refuses) {
    const std::vector<float> one(1), two(2);
    const auto refused = [](const std::vector<ExrLayer>& layers, int width, int height,
                            const char* words) {
        CHECK_THROWS(encode(layers, width, height, true, 1), words);
    };
    refused({}, 1, 1, "it has no channels");
    refused({{"", {"Y"}, one}}, 0, 1, "the size 0x1 is not possible");
    refused({{"", {"Y"}, one}}, 1, 65536, "the size 1x65536 is not possible");
    refused({{"a", {"Y"}, two}}, 1, 1, "the layer 'a' has 2 values; 1x1 pixels of 1 channels need");
    refused({{"", {"Y", "Y"}, two}}, 1, 1, "two channels are called 'Y'");
    refused({{"", {""}, one}}, 1, 1, "the name '' of a channel is not possible");
    refused({{std::string(254, 'n'), {"Y"}, one}}, 1, 1, "of a channel is not possible");
    refused({{std::string(1, '\0'), {"Y"}, one}}, 1, 1, "the name '?.Y' of a channel");
}

} // namespace test_exr_write
