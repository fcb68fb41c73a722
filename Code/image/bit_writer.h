// Bits into bytes, the first bit lowest (RFC 1951).
// Private to image/.
#pragma once

#include "image/huffman.h"
#include "image/little_endian.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

class BitWriter {
public:
    // Behind what is there.
    explicit BitWriter(std::vector<std::uint8_t> before)
        : bytes_(std::move(before)), used_(bytes_.size()) {}

    // Makes room; put() does not check.
    void reserveBits(std::uint64_t bits) { bytes_.resize(used_ + bits / 8 + 16); }
    // The same for bytes whose number isn't known before: there is room behind it too, at times.
    void makeRoom(std::uint64_t bits) {
        if (used_ + bits / 8 + 16 > bytes_.size()) reserveBits(bits);
    }
    // After flush(), up to 56 bits fit.
    void put(std::uint64_t bits, unsigned n) {
        waiting_ |= bits << count_;
        count_ += n;
    }
    void put(HuffmanCode code) { put(code.bits, code.length); }
    void put(const JoinedCodes& codes) { put(codes.bits, codes.length); }
    void flush() {
        storeLittle(bytes_.data() + used_, waiting_);
        used_ += count_ >> 3;
        waiting_ >>= count_ & ~7u;
        count_ &= 7;
    }
    void putBytes(std::span<const std::uint8_t> bytes) {
        padToByte();
        reserveBits(8 * bytes.size());
        std::copy(bytes.begin(), bytes.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(used_));
        used_ += bytes.size();
    }
    void padToByte() {
        reserveBits(8);
        count_ = (count_ + 7) & ~7u;
        flush();
    }

    // To take back what has been written since.
    struct Place {
        std::size_t used;
        std::uint64_t waiting;
        unsigned count;
    };
    Place place() const { return {used_, waiting_, count_}; }
    std::uint64_t bitsSince(const Place& start) const {
        return 8 * (used_ - start.used) + count_ - start.count;
    }
    void goBackTo(const Place& start) {
        used_ = start.used;
        waiting_ = start.waiting;
        count_ = start.count;
    }

    std::vector<std::uint8_t> result() && {
        bytes_.resize(used_);
        return std::move(bytes_);
    }

private:
    std::vector<std::uint8_t> bytes_;
    std::size_t used_;
    std::uint64_t waiting_ = 0;
    unsigned count_ = 0; // below 8 after flush()
};
