// Numbers and bits in bytes, the lowest first (RFC 1951 section 3.1.1).
// Private to image/.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

// At any address.
template <class Number> Number loadLittle(const std::uint8_t* from) {
    Number number{};
    if constexpr (std::endian::native == std::endian::little)
        std::memcpy(&number, from, sizeof number);
    else
        for (unsigned i = 0; i < sizeof number; ++i)
            number |= static_cast<Number>(static_cast<Number>(from[i]) << (8 * i));
    return number;
}
// The same with the highest byte first.
template <class Number> Number loadBig(const std::uint8_t* from) {
    Number number{};
    for (unsigned i = 0; i < sizeof number; ++i)
        number = static_cast<Number>(static_cast<std::uint64_t>(number) << 8 | from[i]);
    return number;
}
template <class Number> void storeLittle(std::uint8_t* to, Number number) {
    if constexpr (std::endian::native == std::endian::little)
        std::memcpy(to, &number, sizeof number);
    else
        for (unsigned i = 0; i < sizeof number; ++i)
            to[i] = static_cast<std::uint8_t>(number >> (8 * i));
}

// A code as it goes into the stream: its first bit is the lowest.
struct HuffmanCode {
    std::uint16_t bits = 0;
    std::uint8_t length = 0;
};

class BitWriter {
public:
    // Writes behind what `before` has, in its memory.
    explicit BitWriter(std::vector<std::uint8_t> before)
        : bytes_(std::move(before)), used_(bytes_.size()) {}

    // Makes room; put() does not check.
    void reserveBits(std::uint64_t bits) { bytes_.resize(used_ + bits / 8 + 16); }
    // After flush(), up to 56 bits fit.
    void put(std::uint64_t bits, unsigned n) {
        waiting_ |= bits << count_;
        count_ += n;
    }
    void put(HuffmanCode code) { put(code.bits, code.length); }
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
