// Code/image/colour.h against long double arithmetic.
#include "check.h"

#include "image/colour.h"
#include "texture/texels_in_lanes.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace test_image_colour {

namespace {

long double exactDecode(long double s) {
    return s <= 0.04045L ? s / 12.92L : std::pow((s + 0.055L) / 1.055L, 2.4L);
}
long double exactEncode(long double x) {
    return x <= 0.0031308L ? 12.92L * x : 1.055L * std::pow(x, 1 / 2.4L) - 0.055L;
}
// Error in units of the last place of the exact value as a float.
double ulps(float value, long double exact) {
    const float nearest = static_cast<float>(exact);
    const float step = std::nextafter(nearest, 2.0f) - nearest;
    return static_cast<double>((static_cast<long double>(value) - exact) /
                               static_cast<long double>(step));
}
float linearFromSrgb(float encoded) { return kernels::one::linearFromSrgb(encoded).v; }
float floatOf(std::uint32_t bits) { return std::bit_cast<float>(bits); }
std::uint32_t bitsOf(float value) { return std::bit_cast<std::uint32_t>(value); }

} // namespace

TEST(colour_codes_decode_to_nearest_float) {
    for (int code = 0; code < 256; ++code)
        CHECK_EQUAL(linearFromSrgb8(static_cast<std::uint8_t>(code)),
                    static_cast<float>(exactDecode(code / 255.0L)));
    int different = 0;
    for (int code = 0; code < 65536; ++code)
        if (linearFromSrgb16(static_cast<std::uint16_t>(code)) !=
            static_cast<float>(exactDecode(code / 65535.0L)))
            ++different;
    CHECK_EQUAL(different, 0);
}

// Both floats beside every boundary between two codes: with monotony that is every float.
TEST(colour_codes_are_rounded_exactly) {
    int wrong8 = 0, wrong16 = 0;
    for (int code = 1; code < 256; ++code) {
        const float boundary = static_cast<float>(exactDecode((code - 0.5L) / 255));
        for (std::uint32_t step = 0; step < 5; ++step) {
            const float x = floatOf(bitsOf(boundary) + step - 2);
            if (srgb8FromLinear(x) != std::floor(255 * exactEncode(x) + 0.5L)) ++wrong8;
        }
    }
    for (int code = 1; code < 65536; ++code) {
        const float boundary = static_cast<float>(exactDecode((code - 0.5L) / 65535));
        for (std::uint32_t step = 0; step < 3; ++step) {
            const float x = floatOf(bitsOf(boundary) + step - 1);
            if (srgb16FromLinear(x) != std::floor(65535 * exactEncode(x) + 0.5L)) ++wrong16;
        }
    }
    CHECK_EQUAL(wrong8, 0);
    CHECK_EQUAL(wrong16, 0);
}

TEST(colour_codes_are_monotone) {
    int falling = 0;
    std::uint8_t last8 = 0;
    std::uint16_t last16 = 0;
    for (std::uint32_t bits = bitsOf(1e-9f); bits < bitsOf(1.01f); bits += 997) {
        const std::uint8_t next8 = srgb8FromLinear(floatOf(bits));
        const std::uint16_t next16 = srgb16FromLinear(floatOf(bits));
        falling += next8 < last8 || next16 < last16;
        last8 = next8;
        last16 = next16;
    }
    CHECK_EQUAL(falling, 0);
    CHECK_EQUAL(int{last8}, 255);
    CHECK_EQUAL(int{last16}, 65535);
}

// Many at once are the same as one by one: all floats of a stride, infinite and NaN among them.
TEST(colour_codes_of_pixels_are_those_of_their_values) {
    std::vector<Rgb> pixels;
    for (std::uint64_t bits = 0; bits < std::uint64_t{1} << 32; bits += 3 * 7919) {
        const auto value = [&](std::uint64_t i) {
            return floatOf(static_cast<std::uint32_t>(bits + 7919 * i));
        };
        pixels.push_back({value(0), value(1), value(2)});
    }
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    pixels.push_back({kInfinity, -kInfinity, std::numeric_limits<float>::quiet_NaN()});
    pixels.push_back({1, 0x1.fffffep-1f, 0x1p-13f});
    for (const std::size_t count :
         {std::size_t{1}, std::size_t{2}, std::size_t{3}, pixels.size()}) {
        const auto part = std::span<const Rgb>(pixels).last(count);
        std::vector<std::uint8_t> codes(3 * count);
        srgb8FromLinear(part, codes.data());
        int wrong = 0;
        for (std::size_t i = 0; i < count; ++i)
            wrong += codes[3 * i] != srgb8FromLinear(part[i].r) ||
                     codes[3 * i + 1] != srgb8FromLinear(part[i].g) ||
                     codes[3 * i + 2] != srgb8FromLinear(part[i].b);
        CHECK_INFO(wrong == 0, wrong << " of " << count);
    }
}

TEST(colour_codes_come_back) {
    for (int code = 0; code < 256; ++code) {
        const auto byte = static_cast<std::uint8_t>(code);
        CHECK_EQUAL(int{srgb8FromLinear(linearFromSrgb8(byte))}, code);
        CHECK_EQUAL(int{unit8From(unitFrom8(byte))}, code);
    }
    int different = 0;
    for (int code = 0; code < 65536; ++code) {
        const auto word = static_cast<std::uint16_t>(code);
        different += srgb16FromLinear(linearFromSrgb16(word)) != word;
        different += unit16From(unitFrom16(word)) != word;
    }
    CHECK_EQUAL(different, 0);
}

TEST(colour_floats_are_within_one_ulp) {
    double worstDecode = 0, worstEncode = 0;
    for (std::uint32_t bits = bitsOf(1e-6f); bits <= bitsOf(1.0f); bits += 641) {
        const float x = floatOf(bits);
        worstDecode = std::max(worstDecode, std::fabs(ulps(linearFromSrgb(x), exactDecode(x))));
        worstEncode = std::max(worstEncode, std::fabs(ulps(srgbFromLinear(x), exactEncode(x))));
    }
    CHECK(worstDecode < 0.75);
    CHECK(worstEncode < 0.75);
    CHECK(worstDecode > 0.25); // that something was compared
    CHECK_EQUAL(linearFromSrgb(1), 1.0f);
    CHECK_EQUAL(srgbFromLinear(1), 1.0f);
}

TEST(colour_clamps_and_takes_nan_as_zero) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    for (const float low : {nan, -nan, -1.0f, -infinite, -0.0f, 0.0f, 1e-40f}) {
        CHECK_EQUAL(int{srgb8FromLinear(low)}, 0);
        CHECK_EQUAL(int{srgb16FromLinear(low)}, 0);
        CHECK_EQUAL(int{unit8From(low)}, 0);
        CHECK_EQUAL(int{unit16From(low)}, 0);
        CHECK_NEAR(linearFromSrgb(low), 0, 1e-40);
        CHECK_NEAR(srgbFromLinear(low), 0, 1e-38);
    }
    for (const float high : {1.0f, 1.5f, 1e30f, infinite}) {
        CHECK_EQUAL(int{srgb8FromLinear(high)}, 255);
        CHECK_EQUAL(int{srgb16FromLinear(high)}, 65535);
        CHECK_EQUAL(int{unit8From(high)}, 255);
        CHECK_EQUAL(int{unit16From(high)}, 65535);
        CHECK_EQUAL(linearFromSrgb(high), 1.0f);
        CHECK_EQUAL(srgbFromLinear(high), 1.0f);
    }
    CHECK_EQUAL(int{unit8From(0.5f)}, 128); // 127.5 is rounded up
}

} // namespace test_image_colour
