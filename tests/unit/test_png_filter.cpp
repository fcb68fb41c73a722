// Code/image/png_filter.cpp against the PNG specification, byte by byte.
#include "check.h"

#include "base/text.h"
#include "image/png.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace test_png_filter {

namespace {

using Row = std::vector<std::uint8_t>;

std::uint8_t at(const Row& row, std::size_t i, std::size_t back) {
    return i >= back ? row[i - back] : std::uint8_t{0};
}
Row filtered(const Row& row, const Row& above, std::size_t pixelBytes, PngFilter filter) {
    Row out(row.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
        const int a = at(row, i, pixelBytes), b = above[i], c = at(above, i, pixelBytes);
        int predicted = 0;
        if (filter == PngFilter::Sub) predicted = a;
        if (filter == PngFilter::Up) predicted = b;
        if (filter == PngFilter::Average) predicted = (a + b) / 2;
        if (filter == PngFilter::Paeth) { // PNG specification, 9.4
            const int p = a + b - c, pa = std::abs(p - a), pb = std::abs(p - b),
                      pc = std::abs(p - c);
            predicted = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
        }
        out[i] = static_cast<std::uint8_t>(row[i] - predicted);
    }
    return out;
}
int cost(const Row& row) {
    int sum = 0;
    for (const std::uint8_t byte : row) sum += std::min(int{byte}, 256 - byte);
    return sum;
}

// Rows that suit different filters: noise, slopes, copies of the row above.
void fill(Row& row, const Row& above, std::uint32_t kind, std::uint32_t& state) {
    for (std::size_t i = 0; i < row.size(); ++i) {
        state = state * 1664525u + 1013904223u;
        const std::uint32_t noise = state >> 24;
        const std::uint32_t from = kind == 0   ? 0
                                   : kind == 1 ? at(row, i, 3)
                                   : kind == 2 ? above[i]
                                   : kind == 3 ? (at(row, i, 3) + above[i]) / 2u
                                               : at(row, i, 3) + above[i] - at(above, i, 3);
        row[i] = static_cast<std::uint8_t>(from + (kind == 0 ? noise & 7 : noise & 3));
    }
}

constexpr std::array kFilters{PngFilter::None, PngFilter::Sub, PngFilter::Up, PngFilter::Average,
                              PngFilter::Paeth};

} // namespace

// Rows from one pixel to more than three vectors, and longer ones.
TEST(png_filter_writes_what_the_specification_says) {
    std::array<int, kFilters.size()> chosen{};
    std::uint32_t state = 3;
    constexpr std::uint32_t kRepeated = 5, kZeros = 6, kKinds = 7;
    for (const std::size_t pixelBytes : {1u, 2u, 3u, 4u, 6u, 8u})
        for (std::size_t pixels = 1; pixels < 3000; pixels += pixels < 60 ? 1 : 577)
            for (std::uint32_t kind = 0; kind < kKinds; ++kind) {
                Row row(pixels * pixelBytes), above(row.size());
                fill(above, above, 0, state);
                for (std::uint8_t& byte : above) byte = static_cast<std::uint8_t>(byte * 37);
                fill(row, above, kind, state);
                if (kind == kZeros) above.assign(row.size(), 0);
                if (kind >= kRepeated) row = above;
                const auto info = [&](PngFilter filter) {
                    return cat(pixels, " pixels of ", pixelBytes, " bytes, kind ", kind,
                               ", filter ", static_cast<int>(filter));
                };
                Row out(row.size(), 77);
                const PngFilter best = filterRow(row, above, pixelBytes, out);
                ++chosen[static_cast<std::size_t>(best)];
                CHECK_INFO(out == filtered(row, above, pixelBytes, best), info(best));
                if (kind == kZeros) CHECK_INFO(best == PngFilter::None, info(best));
                for (const PngFilter filter : kFilters) {
                    Row other = filtered(row, above, pixelBytes, filter);
                    CHECK_INFO(cost(out) < cost(other) ||
                                   (cost(out) == cost(other) && best <= filter),
                               info(filter));
                    unfilterRow(filter, other, above, pixelBytes);
                    CHECK_INFO(other == row, info(filter));
                }
            }
    for (const int count : chosen) CHECK(count > 0);
}

} // namespace test_png_filter
