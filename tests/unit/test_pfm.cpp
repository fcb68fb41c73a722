// Code/image/pfm.cpp; broken files are in tests/bad/image (test_image.cpp).
#include "check.h"

#include "image/image.h"

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace test_pfm {

using namespace std::string_view_literals;

namespace {

StoredImage stored(std::string_view text) {
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    return decodeImage(bytes, "test.pfm");
}
using Floats = std::vector<float>;

} // namespace

TEST(pfm_reads_both_byte_orders_from_the_bottom) {
    // 1 is 3f800000, 2 is 40000000; the first row of the file is the lowest.
    CHECK(stored("Pf\n1 2\n-1.0\n\0\0\x80\x3f\0\0\0\x40"sv).floats == (Floats{2, 1}));
    CHECK(stored("Pf\n1 2\n1.0\n\x3f\x80\0\0\x40\0\0\0"sv).floats == (Floats{2, 1}));
    const StoredImage colour = stored("PF\n1 1\n-1\n\0\0\x80\x3f\0\0\0\x40\0\0\0\xbf"sv);
    CHECK_EQUAL(colour.channels, 3);
    CHECK(colour.floats == (Floats{1, 2, -0.5f}));
}

TEST(pfm_scale_multiplies) {
    CHECK(stored("Pf\n1 1\n-2.5\n\0\0\x80\x3f"sv).floats == (Floats{2.5f}));
}

TEST(pfm_writes_known_bytes) {
    Image image(1, 2);
    image.setPixel(0, 0, {1, 2, -0.5f});
    const auto file = encodeImage(image, "pfm", {});
    CHECK_EQUAL(std::string(file.begin(), file.end()),
                "PF\n1 2\n-1.0\n\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\x3f\0\0\0\x40\0\0\0\xbf"sv);
}

TEST(pfm_round_trip_is_exact) {
    Image image(19, 7);
    std::uint32_t state = 3;
    const auto random = [&] {
        state = state * 1664525u + 1013904223u;
        return (static_cast<float>(state >> 8) - 8e6f) * 1.2345e-3f;
    };
    for (Rgb& pixel : image.pixels()) pixel = {random(), random(), random()};
    image.setPixel(
        0, 0, {-0.0f, std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::max()});
    CHECK(Image(decodeImage(encodeImage(image, "pfm", {}), "round trip")) == image);
}

} // namespace test_pfm
