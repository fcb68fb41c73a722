// Takes Huffman codes and bits out of a JPEG file's entropy-coded data (ITU-T T.81, annexes C and
// F).
// Private to image/.
#pragma once

#include "image/formats.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

// A Huffman table whose codes are found by their first bits.
class JpegHuffman {
public:
    static constexpr unsigned kLongest = 16; // bits of a code
    struct Found {
        std::uint8_t symbol = 0, length = 0; // length 0: there is no such code
    };

    // `counts` says how many codes have 1 to 16 bits, `symbols` what they stand for, shorter codes
    // first (annex C). Returns false when there are more codes than bits can tell apart.
    bool define(Bytes counts, Bytes symbols);
    bool isDefined() const { return isDefined_; }

    // Finds the code that the next 16 bits begin with.
    Found find(unsigned bits) const {
        const Found quick = quick_[bits >> (kLongest - kQuick)];
        if (quick.length != 0) return quick;
        for (unsigned length = kQuick + 1; length <= kLongest; ++length)
            if (bits < end_[length])
                return {
                    symbols_[first_[length] + ((bits - end_[length - 1]) >> (kLongest - length))],
                    static_cast<std::uint8_t>(length)};
        return {};
    }

private:
    static constexpr unsigned kQuick = 9; // codes of so many bits are found in one step

    bool isDefined_ = false;
    std::array<Found, 1 << kQuick> quick_{};
    // Codes of n bits, filled up to 16 bits, are in end_[n - 1]..end_[n] (without the latter).
    std::array<unsigned, kLongest + 1> end_{};
    std::array<unsigned, kLongest + 1> first_{}; // the first symbol with n bits has this index
    std::array<std::uint8_t, 256> symbols_{};
};

// Takes bits out of entropy-coded data, the highest of a byte first, up to the next marker. A zero
// byte after 0xFF is left out (B.1.1.5).
class JpegBits {
public:
    JpegBits(Bytes file, std::size_t at, const std::string& name)
        : file_(file), at_(at), name_(name) {}

    unsigned symbol(const JpegHuffman& table) {
        // One call of fill() is enough for a code and the bits that follow it.
        if (count_ < 2 * JpegHuffman::kLongest) fill();
        const JpegHuffman::Found found =
            table.find(static_cast<unsigned>(waiting_ >> (64 - JpegHuffman::kLongest)));
        if (found.length == 0) brokenCode();
        drop(found.length);
        return found.symbol;
    }
    // Returns the next n bits as a number; n is at most 16.
    unsigned take(unsigned n) {
        if (n == 0) return 0;
        if (count_ < n) fill();
        const auto bits = static_cast<unsigned>(waiting_ >> (64 - n));
        drop(n);
        return bits;
    }
    // Returns a number of n bits that is negative when its first bit is 0 (EXTEND in F.2.2.1); n is
    // at most 15.
    int takeSigned(unsigned n) {
        if (n == 0) return 0;
        const int bits = static_cast<int>(take(n));
        return bits < 1 << (n - 1) ? bits - (1 << n) + 1 : bits;
    }
    // Goes on behind the next marker, which must be the restart marker with this number, 0 to 7.
    void restart(unsigned number);
    // Returns the position of a byte after the last bit that was taken, and not after the next
    // marker.
    std::size_t position() const { return at_; }

private:
    void fill();
    void drop(unsigned n) {
        if (count_ < n) endsEarly();
        waiting_ <<= n;
        count_ -= n;
    }
    [[noreturn]] void brokenCode() const;
    [[noreturn]] void endsEarly() const;

    Bytes file_;
    std::size_t at_;
    const std::string& name_;
    std::uint64_t waiting_ = 0; // the next bit is the highest; zeros after the last one
    unsigned count_ = 0;        // of its bits that are from the file
    bool isAtEnd_ = false;      // no more bits come: a marker or the file's end follows
};

// Returns the position of the next marker's last byte, which is neither 0 nor 0xFF, at `at` or
// later; the size of the file when there is none. Bytes before markers that mean nothing are
// skipped.
std::size_t nextJpegMarker(Bytes file, std::size_t at);
