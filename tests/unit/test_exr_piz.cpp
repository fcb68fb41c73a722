// Code/image/exr_huffman.cpp and exr_piz.cpp: codes that no small picture has, and damaged ones.
#include "check.h"

#include "image/exr_blocks.h"
#include "unit/exr_kit.h"

namespace test_exr_piz {

namespace {

using exr_kit::Buffer;

// Bits from the highest of each byte downwards.
struct Bits {
    Buffer bytes;
    std::size_t count = 0;

    void put(std::uint64_t value, unsigned length) {
        for (unsigned i = length; i-- > 0; ++count) {
            if (count % 8 == 0) bytes.push_back(0);
            if ((value >> i & 1) != 0)
                bytes.back() = static_cast<std::uint8_t>(bytes.back() | 128u >> count % 8);
        }
    }
};

// What the library writes: the header, the table of lengths, the codes.
Buffer packed(std::uint32_t first, std::uint32_t last, const Bits& table, const Bits& codes) {
    Buffer out;
    for (const std::uint32_t number :
         {first, last, std::uint32_t{0}, static_cast<std::uint32_t>(codes.count), std::uint32_t{0}})
        exr_kit::put(out, number, 4);
    exr_kit::put(out, table.bytes);
    exr_kit::put(out, codes.bytes);
    return out;
}

// The lengths 1, 2, 3 and so on to 57, 58, 58. The code of length n is n - 1 zeros and a one, and
// of the two longest the first is all zeros.
constexpr unsigned kLongest = 58;
Bits longTable() {
    Bits table;
    for (unsigned n = 1; n <= kLongest; ++n) table.put(n, 6);
    table.put(kLongest, 6);
    return table;
}

std::vector<std::uint16_t> unpack(const Buffer& bytes, std::size_t count) {
    std::vector<std::uint16_t> out(count);
    unpackExrHuffman(bytes, out, "a.exr");
    return out;
}

} // namespace

TEST(exr_huffman_codes_of_every_length) {
    constexpr std::uint32_t kFirst = 1000; // its code is "1"
    Bits codes;
    std::vector<std::uint16_t> right;
    for (unsigned n = kLongest - 1; n >= 1; --n) {
        codes.put(1, n);
        right.push_back(static_cast<std::uint16_t>(kFirst + n - 1));
    }
    codes.put(0, kLongest);
    right.push_back(kFirst + kLongest - 1);
    codes.put(1, kLongest); // the last symbol: a run
    codes.put(200, 8);
    right.insert(right.end(), 200, right.back());
    const Buffer bytes = packed(kFirst, kFirst + kLongest, longTable(), codes);
    CHECK(unpack(bytes, right.size()) == right);
    CHECK_THROWS(unpack(bytes, right.size() + 1), "it ends in the middle of a code");
    CHECK_THROWS(unpack(bytes, right.size() - 1), "more numbers than pixels");
    const Buffer cut(bytes.begin(), bytes.end() - 1);
    CHECK_THROWS(unpack(cut, right.size()), "it ends in the middle of its codes");
}

TEST(exr_huffman_zeros_in_the_table) {
    // Symbol 0, then 5 + 261 + 2 unused ones, then 269; the run symbol is not used. Of one length
    // the first symbol has the smaller code.
    Bits table;
    table.put(1, 6);
    table.put(62, 6);
    table.put(63, 6);
    table.put(255, 8);
    table.put(59, 6);
    table.put(1, 6);
    table.put(0, 6);
    Bits codes;
    codes.put(0b0110, 4);
    CHECK(unpack(packed(0, 270, table, codes), 4) == (std::vector<std::uint16_t>{0, 269, 269, 0}));
    CHECK_THROWS(unpack(packed(0, 260, table, codes), 4), "more lengths of codes than promised");
}

TEST(exr_huffman_refuses_what_is_no_code) {
    const auto tableOf = [](std::initializer_list<unsigned> lengths) {
        Bits table;
        for (const unsigned length : lengths) table.put(length, 6);
        return table;
    };
    Bits codes;
    codes.put(0xFF00FF, 24);
    CHECK_THROWS(unpack(packed(0, 2, tableOf({1, 1, 1}), codes), 4), "lengths of its codes");
    CHECK_THROWS(unpack(packed(0, 1, tableOf({1, 2}), codes), 4), "lengths of its codes");
    CHECK_THROWS(unpack(packed(0, 1, tableOf({1, 0}), codes), 4), "stands for nothing");
    CHECK_THROWS(unpack(packed(0, 1, tableOf({1, 1}), codes), 4), "a run without a number");
    CHECK_THROWS(unpack(packed(1, 0, tableOf({1, 1}), codes), 4), "its symbols are 1 to 0");
    CHECK_THROWS(unpack(packed(0, 65537, tableOf({1, 1}), codes), 4), "its symbols are 0 to 65537");
    CHECK_THROWS(unpack(packed(0, 100, tableOf({1, 1}), {}), 4), "it ends in the middle of a code");
    CHECK_THROWS(unpack(Buffer(19), 4), "it ends in the middle of its header");
}

TEST(exr_piz_refuses_wrong_numberings) {
    const std::vector<ExrChannel> channels(1);
    const ExrBlock block{64, 64, channels};
    const auto unpackPiz = [&](const Buffer& bytes) { return unpackExrPiz(block, bytes, "a.exr"); };
    CHECK_THROWS(unpackPiz({0, 32, 0, 32}), "its set of numbers is too large");
    CHECK_THROWS(unpackPiz({0, 0, 1, 0, 255}), "it ends in the middle of its numbers");
    CHECK_THROWS(unpackPiz({1, 0, 0, 0, 1}), "it has no codes");
    CHECK_THROWS(unpackPiz({1, 0, 0, 0, 1, 0, 0, 0}), "0 bytes of codes instead of 1");
}

} // namespace test_exr_piz
