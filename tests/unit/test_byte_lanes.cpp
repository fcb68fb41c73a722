// Code/image/byte_lanes.h of each width: the filters against those of the PNG specification, byte
// by byte; the places of bytes that are not zero; the codes of words; sums of Adler-32.
#include "check.h"

#include "image/byte_lanes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <vector>

namespace test_byte_lanes {

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

void checkFilters(const ByteLanes& lanes) {
    std::array<int, kPngFilterCount> chosen{};
    std::uint32_t state = 3;
    constexpr std::uint32_t kRepeated = 5, kZeros = 6;
    // Every length up to three vectors, and two that fill more than one block of sums.
    for (std::size_t size = 3; size <= 99; ++size)
        for (const std::size_t length : {size, std::size_t{4112}, std::size_t{4096 + 4096 + 7}})
            for (std::uint32_t kind = 0; kind < 7; ++kind) {
                if (length > 99 && size > 4) continue;
                const std::size_t pixelBytes = state >> 20 & 1 ? 3 : 6;
                Row row(length), above(length);
                fill(above, above, 0, state);
                for (std::uint8_t& byte : above) byte = static_cast<std::uint8_t>(byte * 37);
                fill(row, above, kind, state);
                if (kind == kZeros) above.assign(length, 0);
                if (kind >= kRepeated) row = above;
                Row out(length, 77);
                const PngFilter filter = lanes.filterRow(row, above, pixelBytes, {}, out);
                ++chosen[static_cast<std::size_t>(filter)];
                if (kind >= kRepeated)
                    CHECK(filter == (kind == kZeros ? PngFilter::None : PngFilter::Up));
                CHECK_INFO(out == filtered(row, above, pixelBytes, filter),
                           lanes.name << " length " << length << " kind " << kind << " filter "
                                      << static_cast<int>(filter));
                for (const PngFilter other : {PngFilter::None, PngFilter::Sub, PngFilter::Up,
                                              PngFilter::Average, PngFilter::Paeth}) {
                    const Row expected = filtered(row, above, pixelBytes, other);
                    CHECK_INFO(cost(out) <= cost(expected),
                               lanes.name << " length " << length << " kind " << kind << " other "
                                          << static_cast<int>(other));
                    if (kind >= kRepeated) continue;
                    Row given(length, 77);
                    CHECK(lanes.filterRow(row, above, pixelBytes, other, given) == other);
                    CHECK_INFO(given == expected, lanes.name << " length " << length << " kind "
                                                             << kind << " given "
                                                             << static_cast<int>(other));
                }
            }
    for (const int count : chosen) CHECK(count > 0);
}

} // namespace

TEST(png_filter_writes_what_the_specification_says) {
    for (const ByteLanes& lanes : allByteLanes())
        if (lanes.supported()) checkFilters(lanes);
}

// Every number of bytes from none to two looks at 64 and more, from rare to all.
TEST(nonzero_places_are_found_by_every_width) {
    std::uint32_t state = 11;
    for (std::size_t size = 0; size <= 200; ++size)
        for (const std::uint32_t oneIn : {1u, 2u, 9u, 90u}) {
            Row bytes(size);
            std::vector<std::uint32_t> expected;
            for (std::uint32_t i = 0; i < size; ++i) {
                state = state * 1664525u + 1013904223u;
                if ((state >> 8) % oneIn != 0) continue;
                bytes[i] = static_cast<std::uint8_t>(state >> 24 | (i % 2 == 0 ? 1 : 128));
                expected.push_back(i);
            }
            for (const ByteLanes& lanes : allByteLanes()) {
                if (!lanes.supported()) continue;
                RawVector<std::uint32_t> places(7, 5); // of any content
                CHECK(lanes.nonzeroPlaces(bytes, expected.size(), places));
                CHECK_INFO(places == expected,
                           lanes.name << " size " << size << " one in " << oneIn);
                if (!expected.empty())
                    CHECK(!lanes.nonzeroPlaces(bytes, expected.size() - 1, places));
            }
        }
}

// Behind gaps of any size, before the piece too.
TEST(words_are_written_alike_by_every_width) {
    std::uint32_t state = 13;
    for (std::size_t trial = 0; trial < 100; ++trial) {
        Row piece(kWordBytes * (trial * 37 % WordList::kMost));
        for (std::size_t i = 0; i < piece.size(); ++i) {
            state = state * 1664525u + 1013904223u;
            if (state >> 24 > trial) i += state >> 20 & 255;
            if (i < piece.size()) piece[i] = static_cast<std::uint8_t>(state >> 8);
        }
        if (trial % 10 == 9) std::fill(piece.begin(), piece.end() - 1, std::uint8_t{0});
        WordList words;
        const std::size_t before = trial * trial;
        words.find(piece, before);
        WordCounts counts;
        counts.add(words);
        const DynamicCodes dynamic(counts.symbols(), WordCodes::kLongest);
        const WordCodes codes(dynamic);
        std::vector<Row> written;
        for (const ByteLanes& lanes : allByteLanes()) {
            if (!lanes.supported()) continue;
            BitWriter out({1, 2, 3});
            out.makeRoom(WordCodes::mostBits(words, before));
            lanes.putWords(out, words, codes);
            codes.putEnd(out, words.zeroWordsBehind(), {});
            out.padToByte();
            written.push_back(std::move(out).result());
            CHECK_INFO(written.back() == written.front(), lanes.name << " trial " << trial);
        }
    }
}

// Up to the most that adler32() hands on, the largest bytes and sums as well: nothing may overflow.
TEST(adler_sums_are_added_by_every_width) {
    std::uint32_t state = 5;
    for (const std::uint32_t least : {0u, 255u})
        for (std::size_t size = 0; size <= 5552; size += size < 800 ? 1 : 297) {
            Row bytes(size);
            for (std::uint8_t& byte : bytes) {
                state = state * 1664525u + 1013904223u;
                byte = static_cast<std::uint8_t>(state >> 24 | least);
            }
            for (const ByteLanes& lanes : allByteLanes()) {
                if (!lanes.supported()) continue;
                AdlerSums sums{65520, 65520};
                const std::size_t added = lanes.addToAdler(sums, bytes);
                CHECK(added <= size && size - added < 512);
                std::uint64_t a = 65520, b = 65520;
                for (std::size_t i = 0; i < added; ++i) b += a += bytes[i];
                CHECK_INFO(sums.a == a && sums.b == b,
                           lanes.name << " " << size << " bytes of at least " << least);
            }
        }
}

} // namespace test_byte_lanes
