// A block of single bytes and runs of zeros: their codes, and the block written with them.
// Private to image/.
#pragma once

#include "image/bit_writer.h"
#include "image/byte_codes.h"
#include "image/deflate_codes.h"
#include "image/dynamic_codes.h"

#include <array>
#include <cstdint>
#include <span>

// What a block consists of. A gap of zeros: a zero, and behind it zeros or a match with the byte
// before. Gaps up to the longest match have codes of their own; longer ones are such a gap and
// longest matches.
class RunCounts {
public:
    static constexpr std::size_t kSizes = kLongestMatch + 1;

    // Bytes from `begin` to `end`, of which those at `places` aren't zero, in order.
    void add(std::span<const std::uint8_t> bytes, std::size_t begin,
             std::span<const std::uint32_t> places, std::size_t end);
    // Matches where they are shorter with the best codes, as these are before.
    void choose();

    SymbolCounts symbols() const; // with an end
    bool haveMatch(std::size_t zeros) const { return haveMatch_[zeros]; }
    bool occur(std::size_t zeros) const { return gaps_[zeros] > 0; }

private:
    struct Turn;
    void add(const Turn& turn);

    std::array<std::uint32_t, 256> bytes_{};   // that aren't zero
    std::array<std::uint32_t, kSizes> gaps_{}; // by zeros
    std::uint32_t longestMatches_ = 0;
    std::array<bool, kSizes> haveMatch_ = [] { // at first a guess
        std::array<bool, kSizes> have{};
        for (std::size_t zeros = 10; zeros < kSizes; ++zeros) have[zeros] = true;
        return have;
    }();
};

class RunCodes {
public:
    explicit RunCodes(const RunCounts& counts);

    // Fails where zeros alone are so rare that some gap takes more bits than are put at once.
    bool fit() const { return fit_; }
    // places: of all bytes that aren't zero, in order.
    void put(BitWriter& out, std::span<const std::uint8_t> bytes,
             std::span<const std::uint32_t> places, bool last) const;

private:
    // With a byte behind it, a gap fits between two flushes; one with a match always does.
    static constexpr unsigned kMostBits = 56 - kMaxCodeLength;
    static_assert(kMaxCodeLength + kMaxCodeLength + 5 + 1 <= kMostBits);
    // The code of the gap; of a long one all is put that no code says.
    JoinedCodes gapBefore(BitWriter& out, std::size_t zeros) const;

    DynamicCodes codes_;
    std::uint64_t bits_; // of the block
    ByteCodes bytes_;
    std::array<JoinedCodes, RunCounts::kSizes> gaps_;
    bool fit_ = true;
};
