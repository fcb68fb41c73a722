// Unpacks the Huffman code of PIZ, which stands for 16-bit numbers (the OpenEXR library, ImfHuf).
// Bits are read from the highest of each byte downwards.
#include "image/exr_blocks.h"

#include "base/text.h"
#include "image/bits.h"

#include <algorithm>
#include <array>

namespace {

class ExrBitReader {
public:
    ExrBitReader(Bytes bytes, std::size_t bits, const std::string& name)
        : bytes_(bytes), bits_(bits), name_(name) {}

    // Returns the next 64 bits without consuming them, the first one in the highest place; zeros
    // behind the end of the bytes.
    std::uint64_t peek() const {
        const std::size_t first = position_ / 8;
        std::uint64_t window = 0;
        for (std::size_t i = first; i < first + 8; ++i)
            window = window << 8 | (i < bytes_.size() ? bytes_[i] : std::uint64_t{0});
        const std::size_t shift = position_ % 8;
        if (shift == 0) return window;
        const unsigned next = first + 8 < bytes_.size() ? bytes_[first + 8] : 0u;
        return window << shift | next >> (8 - shift);
    }
    void consume(std::size_t count) {
        if (count > bits_ - position_) brokenPiz(name_, "it ends in the middle of a code");
        position_ += count;
    }
    std::uint32_t take(unsigned count) { // from 1 to 32 bits
        const auto bits = static_cast<std::uint32_t>(peek() >> (64 - count));
        consume(count);
        return bits;
    }
    std::size_t wholeBytes() const { return (position_ + 7) / 8; } // that are consumed or begun

private:
    Bytes bytes_;
    std::size_t bits_, position_ = 0;
    const std::string& name_;
};

// Decodes a canonical code of the symbols 0 to 65536. Of two codes the longer one is the smaller
// number when both are written as fractions; codes of one length grow with their symbols.
class ExrHuffmanDecoder {
public:
    // Fails when the lengths, which are at most 58, are not those of a prefix code.
    ExrHuffmanDecoder(std::span<const std::uint8_t> lengths, std::size_t firstSymbol,
                      const std::string& name)
        : name_(name) {
        for (const std::uint8_t length : lengths) ++count_[length];
        count_[0] = 0;
        // Codes begin where those that are longer end: as numbers that are one bit shorter.
        std::uint64_t end = 0;
        std::array<std::uint32_t, kLongest + 1> place{};
        std::uint32_t used = 0;
        for (std::size_t n = kLongest; n >= 1; --n) {
            first_[n] = end;
            index_[n] = place[n] = used;
            used += count_[n];
            end += count_[n];
            if (end > std::uint64_t{1} << n || (n > 1 && end % 2 != 0))
                brokenPiz(name, "the lengths of its codes are not possible");
            end /= 2;
        }
        symbols_.resize(used);
        for (std::size_t i = 0; i < lengths.size(); ++i) {
            const std::size_t n = lengths[i];
            if (n == 0) continue;
            const auto symbol = static_cast<std::uint32_t>(firstSymbol + i);
            const std::uint32_t at = place[n]++;
            symbols_[at] = symbol;
            if (n > kFastBits) continue;
            const std::uint64_t code = first_[n] + (at - index_[n]);
            const auto from = static_cast<std::ptrdiff_t>(code << (kFastBits - n));
            std::fill_n(fast_.begin() + from, std::size_t{1} << (kFastBits - n),
                        symbol << 6 | static_cast<std::uint32_t>(n));
        }
    }

    std::uint32_t decode(ExrBitReader& bits) const {
        const std::uint64_t waiting = bits.peek();
        if (const std::uint32_t entry = fast_[waiting >> (64 - kFastBits)]; entry != 0) {
            bits.consume(entry & 63);
            return entry >> 6;
        }
        for (std::size_t n = kFastBits + 1; n <= kLongest; ++n) {
            const std::uint64_t code = waiting >> (64 - n);
            if (code < first_[n] || code - first_[n] >= count_[n]) continue;
            bits.consume(n);
            return symbols_[index_[n] + static_cast<std::size_t>(code - first_[n])];
        }
        brokenPiz(name_, "a code that stands for nothing");
    }

    static constexpr std::size_t kLongest = 58;

private:
    static constexpr std::size_t kFastBits = 12;
    std::array<std::uint32_t, std::size_t{1} << kFastBits> fast_{}; // symbol << 6 | length, or 0
    // How many codes have a length, which is the first of them, and where its symbol is.
    std::array<std::uint32_t, kLongest + 1> count_{};
    std::array<std::uint64_t, kLongest + 1> first_{};
    std::array<std::uint32_t, kLongest + 1> index_{};
    std::vector<std::uint32_t> symbols_;
    const std::string& name_;
};

// Reads `count` lengths of 6 bits. 59 to 62 are 2 to 5 zeros; 63 and 8 more bits are 6 to 261.
std::vector<std::uint8_t> exrCodeLengths(ExrBitReader& bits, std::size_t count,
                                         const std::string& name) {
    std::vector<std::uint8_t> lengths;
    lengths.reserve(count);
    while (lengths.size() < count) {
        const std::uint32_t code = bits.take(6);
        if (code <= ExrHuffmanDecoder::kLongest) {
            lengths.push_back(static_cast<std::uint8_t>(code));
            continue;
        }
        const std::size_t zeros = code == 63 ? bits.take(8) + 6 : code - 57;
        if (zeros > count - lengths.size()) brokenPiz(name, "more lengths of codes than promised");
        lengths.resize(lengths.size() + zeros);
    }
    return lengths;
}

} // namespace

void unpackExrHuffman(Bytes packed, std::span<std::uint16_t> out, const std::string& name) {
    constexpr std::size_t kHeader = 20; // five numbers; the third and the last say nothing more
    if (packed.size() < kHeader) brokenPiz(name, "it ends in the middle of its header");
    const std::size_t first = loadLittle<std::uint32_t>(packed.data());
    const std::size_t last = loadLittle<std::uint32_t>(packed.data() + 4);
    const std::size_t bitCount = loadLittle<std::uint32_t>(packed.data() + 12);
    constexpr std::size_t kLastSymbol = 65536;
    if (first > last || last > kLastSymbol)
        brokenPiz(name,
                  cat("its symbols are ", first, " to ", last, "; at most 0 to ", kLastSymbol));
    const Bytes table = packed.subspan(kHeader);
    ExrBitReader lengthBits(table, 8 * table.size(), name);
    const ExrHuffmanDecoder decoder(exrCodeLengths(lengthBits, last - first + 1, name), first,
                                    name);
    const Bytes codes = table.subspan(lengthBits.wholeBytes());
    if (bitCount > 8 * codes.size()) brokenPiz(name, "it ends in the middle of its codes");
    ExrBitReader bits(codes, bitCount, name);
    const std::size_t runSymbol = last; // the number before it comes again, as 8 bits say how often
    for (std::size_t used = 0; used < out.size();) {
        const std::uint32_t symbol = decoder.decode(bits);
        if (symbol != runSymbol) {
            out[used++] = static_cast<std::uint16_t>(symbol);
            continue;
        }
        const std::size_t times = bits.take(8);
        if (used == 0) brokenPiz(name, "a run without a number before it");
        if (times > out.size() - used) brokenPiz(name, "more numbers than pixels");
        std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(used), times, out[used - 1]);
        used += times;
    }
}
