// What is written of bytes and of runs of zeros in a block with codes of its own. A run is a zero,
// and behind it zeros or matches with the byte before.
// Private to image/.
#pragma once

#include "image/bit_writer.h"
#include "image/deflate_codes.h"
#include "image/dynamic_codes.h"
#include "image/huffman.h"

#include <cstddef>
#include <cstdint>
#include <vector>

class ByteCodes {
public:
    explicit ByteCodes(const DynamicCodes& codes);

    // The others lie behind that of zero.
    const HuffmanCode& operator[](std::uint8_t byte) const { return literals_[byte]; }
    HuffmanCode endOfBlock() const { return literals_[kEndOfBlock]; }

    JoinedCodes zeros(std::size_t count) const; // each by itself
    JoinedCodes zeroAndMatch(std::size_t count) const;
    // Of a run that takes more than a match: what longest matches leave of it is there.
    void putLongestMatches(BitWriter& out, std::size_t count) const;

private:
    std::vector<HuffmanCode> literals_;
    HuffmanCode before_; // the distance of the byte before
};
