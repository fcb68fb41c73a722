// The parts of the JPEG reader, alone: Huffman tables, bits, and the inverse cosine transform.
#include "check.h"

#include "image/jpeg_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace test_jpeg_parts {

namespace {

using Data = std::vector<std::uint8_t>;

// ITU-T T.81, A.3.3, as it stands there.
std::array<double, 64> slowTransform(const JpegBlock& block, const JpegSteps& steps) {
    std::array<double, 64> out{};
    const auto cosine = [](std::size_t x, std::size_t u) {
        return std::cos(static_cast<double>((2 * x + 1) * u) * std::numbers::pi / 16) *
               (u == 0 ? std::numbers::sqrt2 / 2 : 1);
    };
    for (std::size_t y = 0; y < 8; ++y)
        for (std::size_t x = 0; x < 8; ++x) {
            double sum = 0;
            for (std::size_t v = 0; v < 8; ++v)
                for (std::size_t u = 0; u < 8; ++u)
                    sum += static_cast<double>(block[8 * v + u]) * steps.values[8 * v + u] *
                           cosine(x, u) * cosine(y, v);
            out[8 * y + x] = std::clamp(sum / 4 + 128, 0.0, 255.0);
        }
    return out;
}

} // namespace

TEST(jpeg_transform_is_as_exact_as_it_has_to_be) {
    std::mt19937 random(5);
    double errors = 0, squares = 0;
    constexpr int kBlocks = 4000;
    for (int i = 0; i < kBlocks; ++i) {
        JpegBlock block{};
        JpegSteps steps;
        const std::size_t range = std::size_t{4} << random() % 5, count = 8 + random() % 56;
        for (auto& step : steps.values) step = static_cast<std::uint16_t>(1 + random() % 6);
        block[0] = static_cast<std::int16_t>(random() % 200);
        for (std::size_t k = 0; k < count; ++k)
            block[random() % 64] = static_cast<std::int16_t>(static_cast<int>(random() % range) -
                                                             static_cast<int>(range / 2));
        Data samples(64);
        inverseJpegTransform(block, steps, samples.data(), 8);
        const auto expected = slowTransform(block, steps);
        for (std::size_t k = 0; k < 64; ++k) {
            const double error = samples[k] - expected[k];
            CHECK_INFO(std::fabs(error) < 0.75, "block " << i << ": " << error);
            errors += error / kBlocks / 64;
            squares += error * error / kBlocks / 64;
        }
    }
    // Rounding alone has 1/12 on average.
    CHECK_INFO(std::fabs(errors) < 0.01 && squares < 0.09, errors << ' ' << squares);
}

TEST(jpeg_transform_of_the_largest_numbers_stays_in_range) {
    for (const int sign : {-1, 1}) {
        JpegBlock block{};
        JpegSteps steps;
        steps.values.fill(0xFFFF);
        block.fill(static_cast<std::int16_t>(32767 * sign));
        Data samples(8 * 20, 77);
        inverseJpegTransform(block, steps, samples.data(), 20);
        CHECK_EQUAL(int{samples[0]}, sign > 0 ? 255 : 0);
        for (std::size_t y = 0; y + 1 < 8; ++y)
            for (std::size_t x = 8; x < 20; ++x) CHECK_EQUAL(int{samples[20 * y + x]}, 77);
    }
}

// All codes of random tables, against a search bit by bit (F.2.2.3).
TEST(jpeg_huffman_finds_every_code) {
    std::mt19937 random(9);
    for (int round = 0; round < 100; ++round) {
        std::array<std::uint8_t, 16> counts{};
        Data symbols;
        std::vector<std::pair<unsigned, unsigned>> codes; // and lengths
        unsigned code = 0;
        for (unsigned length = 1; length <= 16; ++length, code <<= 1) {
            const unsigned left = (1u << length) - code;
            const unsigned most = length == 16 ? left : left / 2;
            const auto wanted = static_cast<unsigned>(random() % (most + 1));
            const auto room = static_cast<unsigned>(256 - symbols.size());
            counts[length - 1] = static_cast<std::uint8_t>(std::min({wanted, 20u, room}));
            for (unsigned i = 0; i < counts[length - 1]; ++i) {
                codes.emplace_back(code++, length);
                symbols.push_back(static_cast<std::uint8_t>(random()));
            }
        }
        JpegHuffman table;
        CHECK(!table.isDefined());
        CHECK(table.define(counts, symbols));
        CHECK(table.isDefined());
        std::size_t found = 0;
        for (unsigned bits = 0; bits < 1u << 16; bits += 7) {
            std::size_t i = 0;
            while (i < codes.size() && bits >> (16 - codes[i].second) != codes[i].first) ++i;
            const JpegHuffman::Found got = table.find(bits);
            const bool isRight = i == codes.size()
                                     ? got.length == 0
                                     : got.length == codes[i].second && got.symbol == symbols[i];
            CHECK_INFO(isRight, "round " << round << ", bits " << bits);
            found += i < codes.size();
        }
        CHECK(found > 0 || codes.empty());
    }
}

TEST(jpeg_huffman_refuses_too_many_codes) {
    std::array<std::uint8_t, 16> counts{3};
    const Data symbols(200);
    JpegHuffman table;
    CHECK(!table.define(counts, Bytes(symbols).first(3)));
    counts = {1, 1, 3};
    CHECK(!table.define(counts, Bytes(symbols).first(5)));
    counts = {1, 1, 2}; // all of them: more than the standard allows, but of one meaning
    CHECK(table.define(counts, Bytes(symbols).first(4)));
    CHECK_EQUAL(int{table.find(0xFFFF).length}, 3);
    counts = {0, 0, 0, 17};
    CHECK(!table.define(counts, Bytes(symbols).first(17)));
}

TEST(jpeg_bits_end_at_markers) {
    const std::string name = "bits";
    const Data data{0xA5, 0xFF, 0x00, 0x81, 0xFF, 0xFF, 0xD2, 0x40, 0xFF, 0xD9};
    JpegBits bits(data, 0, name);
    CHECK_EQUAL(bits.take(4), 0xAu);
    CHECK_EQUAL(bits.takeSigned(3), -5); // 010
    CHECK_EQUAL(bits.takeSigned(2), 3);  // 11
    CHECK_EQUAL(bits.take(0), 0u);
    CHECK_EQUAL(bits.take(15), 0x7F81u);
    CHECK_THROWS(bits.take(1), "bits: error: the data of a scan end too early, at byte 4 of 10");
    CHECK_THROWS(bits.restart(1), "the restart marker 1 is missing");
    bits.restart(2);
    CHECK_EQUAL(bits.take(8), 0x40u);
    CHECK_THROWS(bits.take(2), "too early");
    CHECK_EQUAL(nextJpegMarker(data, 0), 6u);
    CHECK_EQUAL(nextJpegMarker(data, 7), 9u);
    CHECK_EQUAL(nextJpegMarker(data, 10), 10u);
}

} // namespace test_jpeg_parts
