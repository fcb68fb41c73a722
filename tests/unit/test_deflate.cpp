// Code/image/zlib.h, deflate_codes.h and matcher.h.
#include "check.h"
#include "deflate_kit.h"

#include "image/deflate_codes.h"
#include "image/matcher.h"
#include "image/zlib.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace test_deflate {

namespace {

Buffer bytesOf(std::string_view text) { return {text.begin(), text.end()}; }
Buffer fromHex(std::string_view hex) {
    const auto digit = [](char c) { return c <= '9' ? c - '0' : c - 'a' + 10; };
    Buffer bytes;
    for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
        bytes.push_back(static_cast<std::uint8_t>(16 * digit(hex[i]) + digit(hex[i + 1])));
    return bytes;
}
// Packs, unpacks and compares; the size of the packed bytes.
std::size_t roundTripAs(Packing packing, const Buffer& bytes) {
    const Buffer packed = packedAs(packing, bytes);
    CHECK_INFO(inflateZlib(packed, bytes.size(), "round trip") == bytes,
               static_cast<int>(packing) << " of " << bytes.size() << " bytes");
    CHECK(packed == packedAs(packing, bytes));
    return packed.size();
}
// In both ways; the size in the one that is chosen.
std::size_t roundTrip(const Buffer& bytes) {
    const std::size_t runs = roundTripAs(Packing::Runs, bytes);
    const std::size_t matches = roundTripAs(Packing::Matches, bytes);
    return choosePacking(bytes) == Packing::Runs ? runs : matches;
}

} // namespace

TEST(checksum_known_values) {
    const Buffer digits = bytesOf("123456789");
    CHECK_EQUAL(crc32(digits), 0xCBF43926u); // the check value of the CRC catalogue
    CHECK_EQUAL(crc32({}), 0u);
    CHECK_EQUAL(crc32(bytesOf("IEND")), 0xAE426082u); // ends every PNG file
    CHECK_EQUAL(adler32(bytesOf("Wikipedia")), 0x11E60398u);
    CHECK_EQUAL(adler32({}), 1u);
    const std::span<const std::uint8_t> all(digits);
    CHECK_EQUAL(crc32(all.subspan(4), crc32(all.first(4))), crc32(all));
    CHECK_EQUAL(adler32(all.subspan(4), adler32(all.first(4))), adler32(all));
    const Buffer large(100000, 255);
    CHECK_EQUAL(adler32(large), 0x149A302Cu); // zlib.adler32(b'\xff' * 100000)
    CHECK_EQUAL(crc32(large), 0x68C6CEC4u);
}

// Code/image/checksum.cpp takes many bytes at a time; the PNG specification, annex D, bit by bit.
TEST(crc32_is_that_of_the_standard) {
    std::uint32_t state = 12;
    for (std::size_t size = 0; size < 300; ++size) {
        Buffer bytes(size);
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(nextRandom(state));
        const std::uint32_t before = nextRandom(state);
        std::uint32_t c = ~before;
        for (const std::uint8_t byte : bytes) {
            c ^= byte;
            for (int bit = 0; bit < 8; ++bit) c = (c & 1) != 0 ? c >> 1 ^ 0xEDB88320u : c >> 1;
        }
        CHECK_INFO(crc32(bytes, before) == ~c, size << " bytes, seed 12");
    }
}

// Code/image/checksum.cpp goes in blocks of vectors; RFC 1950 section 8.2 goes byte by byte.
TEST(adler32_is_that_of_the_standard) {
    std::uint32_t state = 11;
    // The largest bytes as well: nothing may overflow in a block.
    for (const std::uint32_t least : {0u, 255u})
        for (std::size_t size = 0; size < 12000; size += 1 + size / 3) {
            Buffer bytes(size);
            for (std::uint8_t& byte : bytes)
                byte = static_cast<std::uint8_t>(nextRandom(state) | least);
            std::uint32_t a = 65520, b = 65519;
            const std::uint32_t before = b << 16 | a;
            for (const std::uint8_t byte : bytes) {
                a = (a + byte) % 65521;
                b = (b + a) % 65521;
            }
            CHECK_INFO(adler32(bytes, before) == (b << 16 | a),
                       size << " bytes of at least " << least);
        }
}

// Streams that Python's zlib has made: stored, fixed and dynamic blocks.
TEST(inflate_known_streams) {
    const Buffer hello = bytesOf("hello hello hello hello");
    CHECK(inflateZlib(fromHex("78da030000000001"), 0, "empty").empty());
    CHECK(
        inflateZlib(fromHex("7801011700e8ff68656c6c6f2068656c6c6f2068656c6c6f2068656c6c6f680308b1"),
                    hello.size(), "stored") == hello);
    CHECK(inflateZlib(fromHex("78dacb48cdc9c957c8402701680308b1"), hello.size(), "fixed") == hello);
    Buffer squares;
    for (unsigned i = 0; i < 300; ++i) squares.push_back(static_cast<std::uint8_t>(i * i / 7 % 9));
    CHECK(inflateZlib(
              fromHex(
                  "78dae5cbc90d00211003411fd84cfe1103d266b1f56d3500cad950466510d6a839cdb22eaf74e8c2"
                  "5fd644d8b188e73ffb013a0d03ce"),
              squares.size(), "dynamic") == squares);
}

// A code of the lengths 1 to 14, and two of 15 bits, is complete; a third of 15 bits is one too
// many.
TEST(inflate_counts_codes_to_the_last) {
    const auto stream = [](unsigned lengthOf15) {
        Buffer bytes{0x78, 0x01};
        std::size_t bits = 0;
        const auto put = [&](unsigned value, unsigned count) { // the lowest bit first
            for (unsigned i = 0; i < count; ++i, ++bits) {
                if (bits % 8 == 0) bytes.push_back(0);
                bytes.back() =
                    static_cast<std::uint8_t>(bytes.back() | (value >> i & 1) << bits % 8);
            }
        };
        const auto putCode = [&](unsigned code, unsigned count) { // the highest bit first
            while (count-- > 0) put(code >> count & 1, 1);
        };
        put(1, 1), put(2, 2);             // the last block, of codes of its own
        put(0, 5), put(0, 5), put(15, 4); // 257 literals, 1 distance, lengths of all 19 lengths
        for (unsigned i = 0; i < 19; ++i) put(i < 3 ? 0 : 4, 3); // 0 to 15 have codes of 4 bits
        for (unsigned symbol = 0; symbol <= 256; ++symbol)
            putCode(symbol < 15     ? symbol + 1
                    : symbol == 15  ? lengthOf15
                    : symbol == 256 ? 15
                                    : 0,
                    4);
        putCode(1, 4);       // the only distance has one bit
        putCode(0x7fff, 15); // 256 ends the block
        bytes.insert(bytes.end(), {0, 0, 0, 1});
        return bytes;
    };
    CHECK(inflateZlib(stream(0), 0, "complete").empty());
    CHECK_THROWS(inflateZlib(stream(15), 0, "one more"), "code has too many codes");
}

TEST(inflate_ignores_what_follows_the_stream) {
    Buffer packed = packedAs(Packing::Runs, bytesOf("abc"));
    packed.insert(packed.end(), {1, 2, 3});
    CHECK(inflateZlib(packed, 3, "more") == bytesOf("abc"));
}

TEST(deflate_round_trips) {
    CHECK(roundTrip({}) <= 10);
    CHECK(roundTrip({42}) <= 12);
    for (std::size_t size = 2; size < 20; ++size) roundTrip(Buffer(size, 7));
    CHECK(roundTrip(Buffer(1'000'000, 7)) < 1200);
    for (const std::size_t size :
         {255u, 256u, 257u, 258u, 259u, 32767u, 32768u, 32769u, 65535u, 65536u})
        CHECK(roundTrip(Buffer(size, 0)) < 200);
    std::uint32_t state = 1;
    Buffer noise(1'000'000);
    for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(nextRandom(state));
    CHECK(roundTrip(noise) < noise.size() + 200);       // stored
    Buffer twice(noise.begin(), noise.begin() + 32768); // the farthest distance there is
    twice.insert(twice.end(), twice.begin(), twice.end());
    const std::size_t matched = roundTripAs(Packing::Matches, twice);
    CHECK_INFO(matched < 35000, matched);
    Buffer tooFar(noise.begin(), noise.begin() + 32769);
    tooFar.insert(tooFar.end(), noise.begin(), noise.begin() + 32769);
    roundTripAs(Packing::Matches, tooFar);
    for (std::uint8_t& byte : noise) byte &= 15;
    CHECK(roundTrip(noise) < noise.size() * 52 / 100); // 4 bits of 8
}

TEST(deflate_round_trips_structured_bytes) {
    std::uint32_t state = 7;
    for (int trial = 0; trial < 60; ++trial) {
        Buffer bytes;
        const std::size_t size = nextRandom(state) % 5000;
        while (bytes.size() < size) {
            const std::uint32_t choice = nextRandom(state) % 3;
            const std::size_t length = 1 + nextRandom(state) % 300;
            if (choice == 0 || bytes.empty())
                for (std::size_t i = 0; i < length; ++i)
                    bytes.push_back(static_cast<std::uint8_t>(nextRandom(state) % 7));
            else if (choice == 1)
                bytes.insert(bytes.end(), length, static_cast<std::uint8_t>(nextRandom(state)));
            else {
                const std::size_t from = nextRandom(state) % bytes.size();
                for (std::size_t i = 0; i < length; ++i) bytes.push_back(bytes[from + i]);
            }
        }
        roundTrip(bytes);
    }
}

// Gaps of zeros of every size about those of a match, of two and of three, in turn with small ones.
TEST(deflate_round_trips_gaps_of_zeros) {
    std::uint32_t state = 5;
    Buffer gaps;
    for (std::size_t zeros = 0; zeros < 800; ++zeros) {
        gaps.insert(gaps.end(), zeros, 0);
        gaps.push_back(static_cast<std::uint8_t>(1 + nextRandom(state) % 255));
        gaps.insert(gaps.end(), nextRandom(state) % 30, 0);
        gaps.push_back(1);
    }
    CHECK_INFO(roundTrip(gaps) < 4200, roundTrip(gaps)); // 1600 bytes, 800 of them any, and gaps
}

// zlib packs the same bytes into 12,825 with runs alone (Z_RLE), into 13,441 at its level 6, which
// searches. What comes again is found all the same.
TEST(deflate_packs_sparse_bytes_tightly) {
    std::uint32_t state = 6;
    Buffer bytes(250'000, 0);
    for (std::uint8_t& byte : bytes)
        if (nextRandom(state) / 7 % 30 == 0) byte = nextRandom(state) % 2 == 0 ? 1 : 255;
    const std::size_t packed = roundTrip(bytes);
    CHECK_INFO(packed < 12'825, packed);

    for (std::uint8_t& byte : bytes)
        if (byte != 0) byte = static_cast<std::uint8_t>(1 + nextRandom(state) % 255);
    const std::size_t once = roundTrip(bytes);
    for (std::size_t i = 500; i < bytes.size(); ++i) bytes[i] = bytes[i - 500];
    CHECK_INFO(roundTrip(bytes) < once / 4, roundTrip(bytes) << " of " << once);
}

// Runs of one byte that end near the end of a match, of what a hash takes, of the bytes and of a
// block, which has 2^16 codes.
TEST(deflate_round_trips_long_runs) {
    const auto check = [](std::size_t before, std::size_t run, std::size_t behind) {
        Buffer bytes(before + run + behind, 9);
        for (std::size_t i = 0; i < before; ++i) bytes[i] = static_cast<std::uint8_t>(i * i >> 3);
        for (std::size_t i = before + run; i < bytes.size(); ++i)
            bytes[i] = static_cast<std::uint8_t>(i * i >> 3);
        const std::size_t size = roundTrip(bytes);
        CHECK_INFO(size < before + behind + run / 500 + 200,
                   size << " bytes of " << before << ", a run of " << run << ", " << behind);
    };
    for (std::size_t matches = 1; matches < 5; ++matches)
        for (std::size_t more = 0; more < 20; ++more)
            for (const std::size_t around : {0u, 1u, 7u, 8u, 300u}) {
                check(around, 258 * matches + more, around);
                check(0, 258 * matches + more, around), check(around, 258 * matches + more, 0);
            }
    for (const std::size_t codes : {0xfffeu, 0xffffu, 0x10000u, 0x10001u})
        check(3, 258 * codes, 20);
}

// Pieces that know nothing of each other make one stream, also empty ones.
TEST(deflate_pieces_join) {
    std::uint32_t state = 11;
    for (int trial = 0; trial < 50; ++trial) {
        const std::size_t count = 1 + nextRandom(state) % 4;
        Buffer all, packed(kZlibHeader.begin(), kZlibHeader.end());
        std::uint32_t adler = 1;
        for (std::size_t i = 0; i < count; ++i) {
            Buffer piece(nextRandom(state) % 3 == 0 ? 0 : nextRandom(state) % 70000);
            const std::uint32_t letters = 1 + nextRandom(state) % 256;
            for (std::uint8_t& byte : piece)
                byte = static_cast<std::uint8_t>(nextRandom(state) % letters);
            all.insert(all.end(), piece.begin(), piece.end());
            const Buffer part = deflatePiece(piece, i + 1 == count, choosePacking(piece));
            packed.insert(packed.end(), part.begin(), part.end());
            adler = adler32Joined(adler, adler32(piece), piece.size());
        }
        CHECK_EQUAL(adler, adler32(all));
        const auto end = zlibEnd(adler);
        packed.insert(packed.end(), end.begin(), end.end());
        CHECK_INFO(inflateZlib(packed, all.size(), "pieces") == all,
                   "trial " << trial << ": " << count << " pieces, " << all.size() << " bytes");
    }
}

// In noise the places that are looked at grow apart; what comes again behind it is found all the
// same, from its start on.
TEST(deflate_finds_matches_after_noise) {
    std::uint32_t state = 5;
    Buffer bytes(200'000);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(nextRandom(state));
    const std::size_t noise = bytes.size();
    const Buffer word(bytes.end() - 20'000, bytes.end());
    bytes.insert(bytes.end(), word.begin(), word.end());
    const auto matches = [&] { return roundTripAs(Packing::Matches, bytes); };
    CHECK_INFO(matches() < noise + 2500, matches());
    bytes.resize(noise);
    bytes.insert(bytes.end(), 20'000, 7);
    CHECK_INFO(matches() < noise + 300, matches());
}

// What came a second time is found when parts of it come a third time, the first being too far
// away: all places of a short match are remembered.
TEST(matcher_remembers_the_places_in_a_match) {
    std::uint32_t state = 6;
    const auto noise = [&](std::size_t size) {
        Buffer bytes(size);
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(nextRandom(state) | 1);
        return bytes;
    };
    const Buffer run(20'000, 0); // hardly any of its places is remembered
    for (std::size_t size = 9; size <= 32; ++size) {
        const Buffer word = noise(size + 8), end = noise(8);
        for (std::size_t from = 0; from < size; ++from) {
            Buffer bytes;
            const auto add = [&](const Buffer& all, std::size_t first, std::size_t count) {
                const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
                bytes.insert(bytes.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
            };
            add(word, 0, size);
            add(run, 0, run.size());
            add(word, 0, word.size()); // the first `size` bytes are a match
            add(run, 0, run.size());
            add(word, from, 8);
            add(end, 0, end.size());

            Matcher matcher(bytes);
            Match match, found;
            for (std::size_t at = 0; at < bytes.size();) {
                at = matcher.next(at, bytes.size(), match);
                matcher.skip(at, match.length);
                at += match.length;
                if (match.length > 0) found = match;
            }
            CHECK_INFO(found.length >= 8,
                       found.length << " of " << size << " bytes from " << from << ", seed 6");
        }
    }
}

// Fibonacci counts make the deepest tree; Kraft's sum must stay 1 when it is cut.
TEST(huffman_lengths_are_complete_and_limited) {
    std::vector<std::uint32_t> counts{1, 1};
    while (counts.size() < 40) counts.push_back(counts.end()[-1] + counts.end()[-2]);
    for (const std::size_t longest : {7u, 15u}) {
        const std::size_t used = longest == 7 ? 19 : 40;
        const auto lengths = huffmanLengths(std::span(counts).first(used), longest);
        double kraft = 0;
        for (const std::uint8_t n : lengths) {
            CHECK(n >= 1 && n <= longest);
            kraft += std::ldexp(1.0, -n);
        }
        CHECK_EQUAL(kraft, 1.0);
        for (std::size_t i = 1; i < used; ++i) CHECK(lengths[i] <= lengths[i - 1]);
    }
    const std::vector<std::uint32_t> known{45, 13, 12, 16, 9, 5}; // Cormen et al., 16.3
    CHECK(huffmanLengths(known, 15) == (std::vector<std::uint8_t>{1, 3, 3, 3, 4, 4}));
    CHECK(huffmanLengths(std::vector<std::uint32_t>{0, 0, 5}, 15) ==
          (std::vector<std::uint8_t>{1, 0, 1}));
}

TEST(huffman_codes_are_canonical) { // the example of RFC 1951, 3.2.2
    const std::vector<std::uint8_t> lengths{3, 3, 3, 3, 3, 2, 4, 4};
    const auto codes = canonicalCodes(lengths);
    CHECK_EQUAL(codes[0].bits, 0b010); // 010 reversed
    CHECK_EQUAL(codes[1].bits, 0b110); // 011
    CHECK_EQUAL(codes[5].bits, 0b00);
    CHECK_EQUAL(codes[6].bits, 0b0111); // 1110
}

} // namespace test_deflate
