// Code/image/zlib.h: the ways to pack, and which one is chosen; the finder of runs in matcher.h.
#include "check.h"
#include "deflate_kit.h"

#include "image/matcher.h"
#include "image/zlib.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace test_packing {

namespace {

constexpr std::uint32_t kSeed = 17;
constexpr std::array kPackings{Packing::Runs, Packing::Matches};

// The highest of its bits, as the lowest come again soon.
std::uint32_t nextHigh(std::uint32_t& state) { return nextRandom(state) >> 12; }

// So many random bits in each byte, 7 at most.
Buffer noise(std::size_t size, unsigned bits, std::uint32_t& state) {
    Buffer bytes(size);
    for (std::uint8_t& byte : bytes)
        byte = static_cast<std::uint8_t>(nextHigh(state) & ((1u << bits) - 1));
    return bytes;
}
// As the rows of a shaded surface are when they are filtered: each value half as often as the one
// before, from `least` on.
Buffer geometric(std::size_t size, std::uint8_t least, std::uint32_t& state) {
    Buffer bytes(size);
    for (std::uint8_t& byte : bytes)
        byte = static_cast<std::uint8_t>(least + std::countr_zero(nextHigh(state) | 0x80u));
    return bytes;
}
// Of which two in three are zero.
Buffer sparse(std::size_t size, std::uint32_t& state) {
    Buffer bytes = geometric(size, 1, state);
    for (std::uint8_t& byte : bytes)
        if (nextHigh(state) % 3 != 0) byte = 0;
    return bytes;
}
// One after the other, until there are so many bytes.
Buffer repeated(const Buffer& word, std::size_t size) {
    Buffer bytes;
    while (bytes.size() < size) add(bytes, word);
    bytes.resize(size);
    return bytes;
}

} // namespace

TEST(packing_is_chosen_by_what_the_bytes_are) {
    std::uint32_t state = kSeed;
    for (const std::size_t size : {4096u, 10'000u, 131'072u, 1'000'000u}) {
        const auto check = [&](const Buffer& bytes, Packing expected, const char* what) {
            CHECK_INFO(choosePacking(bytes) == expected,
                       size << " bytes, " << what << ": " << static_cast<int>(choosePacking(bytes))
                            << ", seed " << kSeed);
        };
        check(Buffer(size), Packing::Runs, "zeros");
        check(sparse(size, state), Packing::Runs, "most of them zero");
        check(geometric(size, 1, state), Packing::Runs, "none of them zero");
        check(noise(size, 7, state), Packing::Runs, "noise");
        check(repeated(noise(100, 7, state), size), Packing::Matches, "a hundred again and again");
        check(repeated(geometric(100, 0, state), size), Packing::Matches, "with zeros, again");
        // One byte in four comes again: of noise that is much, of bytes that take two bits nothing.
        Buffer some = noise(size, 7, state);
        for (std::size_t at = 100; at + 20 <= size; at += 100)
            std::copy_n(&some[at - 100], 25, &some[at]);
        check(some, Packing::Matches, "noise that comes again in part");
        Buffer few = sparse(size, state);
        for (std::size_t at = 100; at + 20 <= size; at += 100)
            std::copy_n(&few[at - 50], 8, &few[at]);
        check(few, Packing::Runs, "short matches of what takes few bits");
    }
    CHECK(choosePacking({}) == Packing::Runs);
}

// What is chosen is not much larger than the smallest.
TEST(packing_that_is_chosen_is_small) {
    std::uint32_t state = kSeed;
    for (int trial = 0; trial < 60; ++trial) {
        const std::size_t size = 20'000 + nextRandom(state) % 110'000;
        const std::uint32_t oneIn = 1 + nextHigh(state) % 12, part = nextHigh(state) % 100;
        Buffer bytes = geometric(size, 1, state);
        for (std::uint8_t& byte : bytes)
            if (nextHigh(state) % oneIn != 0) byte = 0;
        for (std::size_t at = 300; at + 300 <= size; at += 300)
            std::copy_n(&bytes[at - 300], 3 * part, &bytes[at]);
        std::size_t least = size;
        for (const Packing packing : kPackings)
            least = std::min(least, packedAs(packing, bytes).size());
        const std::size_t chosen = packedAs(choosePacking(bytes), bytes).size();
        // 18 % of the bits in a sample, which may be the same of others.
        CHECK_INFO(chosen <= least * 13 / 10, chosen << " bytes, not " << least << ", of " << size
                                                     << ", one in " << oneIn << ", " << part
                                                     << " % again, seed " << kSeed);
    }
}

// Whatever the bytes are and however they are packed.
TEST(every_packing_round_trips) {
    std::uint32_t state = kSeed;
    for (int trial = 0; trial < 20; ++trial) {
        Buffer bytes;
        while (bytes.size() < 150'000) {
            const std::size_t size = 500 + nextRandom(state) % 40'000;
            const auto value = static_cast<std::uint8_t>(nextHigh(state));
            switch (nextHigh(state) % 5) {
            case 0: add(bytes, noise(size, 7, state)); break;
            case 1: add(bytes, geometric(size, 0, state)); break;
            case 2: add(bytes, Buffer(size, value)); break;
            case 3: add(bytes, Buffer(size)); break;
            default: add(bytes, repeated(noise(20 + nextHigh(state) % 3000, 6, state), size));
            }
        }
        for (const Packing packing : kPackings)
            for (const std::size_t size : {bytes.size(), std::size_t{5000}, std::size_t{9}}) {
                const Buffer first(bytes.begin(),
                                   bytes.begin() + static_cast<std::ptrdiff_t>(size));
                CHECK_INFO(inflateZlib(packedAs(packing, first), size, "packing") == first,
                           "trial " << trial << ", packing " << static_cast<int>(packing) << ", "
                                    << size << " bytes, seed " << kSeed);
            }
    }
    for (const Packing packing : kPackings)
        CHECK(inflateZlib(packedAs(packing, {}), 0, "nothing").empty());
}

// All runs of four bytes and more that are as the byte before, but for those of the last seven.
TEST(run_finder_finds_all_runs) {
    std::uint32_t state = kSeed;
    for (int trial = 0; trial < 200; ++trial) {
        Buffer bytes;
        while (bytes.size() < 3000)
            add(bytes, Buffer(1 + nextHigh(state) % (nextHigh(state) % 50 == 0 ? 700 : 9),
                              static_cast<std::uint8_t>(nextHigh(state))));
        RunFinder finder(bytes);
        std::size_t at = 0;
        while (at < bytes.size()) {
            Match match;
            const std::size_t limit = at + 1 + nextHigh(state) % 400;
            const std::size_t found = finder.next(at, limit, match);
            std::size_t expected = std::max<std::size_t>(at, 1), length = 0;
            const std::size_t last = std::min(limit, bytes.size() - 7);
            for (; expected < last; ++expected) {
                length = 0;
                while (expected + length < bytes.size() && length < kLongestMatch &&
                       bytes[expected + length] == bytes[expected - 1])
                    ++length;
                if (length >= 4) break;
            }
            if (expected >= last) {
                length = 0;
                expected = last < bytes.size() - 7 ? std::max(last, at) : bytes.size();
            }
            CHECK_INFO(found == expected && match.length == length,
                       found << ", " << match.length << " bytes, not " << expected << ", " << length
                             << ": from " << at << " to " << limit << ", trial " << trial
                             << ", seed " << kSeed);
            if (found != expected) return;
            at = std::max(found + match.length, at + 1);
        }
    }
}

} // namespace test_packing
