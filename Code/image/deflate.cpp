#include "image/deflate.h"

#include "image/checksum.h"
#include "image/deflate_codes.h"
#include "image/huffman.h"
#include "image/little_endian.h"
#include "image/matcher.h"

#include <algorithm>
#include <array>
#include <bit>

namespace {

constexpr std::size_t kBlockCodes = 1 << 16; // a new Huffman code about every 60 rows

// Some bytes as they are and a match behind them (length 0: none).
struct Step {
    std::uint32_t literals;
    std::uint16_t length, distanceMinusOne;
};

constexpr auto kLengthSymbol = [] { // by length - 3
    std::array<std::uint8_t, 256> symbol{};
    for (std::size_t s = 0; s < kLengthRanges.size(); ++s)
        for (std::size_t i = kLengthRanges[s].base - kShortestMatch; i < symbol.size(); ++i)
            symbol[i] = static_cast<std::uint8_t>(s);
    return symbol;
}();

// Two symbols per power of two.
std::size_t distanceSymbol(std::uint32_t distanceMinusOne) {
    if (distanceMinusOne < 2) return distanceMinusOne;
    const auto top = static_cast<unsigned>(std::bit_width(distanceMinusOne)) - 1;
    return 2 * top + (distanceMinusOne >> (top - 1) & 1);
}

// Bits into bytes, the first bit lowest.
class BitWriter {
public:
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
    std::size_t used_ = 0;
    std::uint64_t waiting_ = 0;
    unsigned count_ = 0; // below 8 after flush()
};

// What one block consists of, with its symbol counts.
struct Block {
    std::span<const std::uint8_t> bytes;
    std::vector<Step> steps;
    std::array<std::uint32_t, kLiteralCodes> literalCounts{};
    std::array<std::uint32_t, kDistanceCodes> distanceCounts{};

    void add(std::span<const std::uint8_t> literals, Match match) {
        countLiterals(literals);
        codes_ += literals.size() + 1;
        const auto count = static_cast<std::uint32_t>(literals.size());
        if (match.length == 0) return steps.push_back({count, 0, 0});
        const auto minusOne = static_cast<std::uint16_t>(match.distance - 1);
        steps.push_back({count, static_cast<std::uint16_t>(match.length), minusOne});
        ++literalCounts[kEndOfBlock + 1 + kLengthSymbol[match.length - kShortestMatch]];
        ++distanceCounts[distanceSymbol(minusOne)];
    }
    std::size_t codes() const { return codes_; }
    // All counts of literals are in literalCounts.
    void finish() {
        for (const auto& counts : interleaved_)
            for (std::size_t b = 0; b < counts.size(); ++b) literalCounts[b] += counts[b];
    }

private:
    // In turns, so that a byte needn't wait for the count of an equal one before it.
    void countLiterals(std::span<const std::uint8_t> literals) {
        std::size_t i = 0;
        for (; i + 4 <= literals.size(); i += 4)
            for (std::size_t k = 0; k < 4; ++k) ++interleaved_[k][literals[i + k]];
        for (; i < literals.size(); ++i) ++interleaved_[0][literals[i]];
    }
    std::array<std::array<std::uint32_t, 256>, 4> interleaved_{};
    std::size_t codes_ = 0;
};

// How the code lengths of a dynamic block are stored: 16, 17 and 18 repeat.
struct LengthToken {
    std::uint8_t symbol, extra, extraBits;
};
std::vector<LengthToken> packLengths(std::span<const std::uint8_t> lengths) {
    std::vector<LengthToken> tokens;
    for (std::size_t i = 0; i < lengths.size();) {
        std::size_t run = 1;
        while (i + run < lengths.size() && lengths[i + run] == lengths[i]) ++run;
        const std::uint8_t value = lengths[i];
        i += run;
        if (value != 0) {
            tokens.push_back({value, 0, 0});
            --run;
        }
        while (run >= 3) {
            const std::size_t part = std::min<std::size_t>(run, value != 0 ? 6 : 138);
            if (value != 0)
                tokens.push_back({16, static_cast<std::uint8_t>(part - 3), 2});
            else if (part <= 10)
                tokens.push_back({17, static_cast<std::uint8_t>(part - 3), 3});
            else
                tokens.push_back({18, static_cast<std::uint8_t>(part - 11), 7});
            run -= part;
        }
        for (; run > 0; --run) tokens.push_back({value, 0, 0});
    }
    return tokens;
}

std::uint64_t bodyBits(const Block& block, std::span<const std::uint8_t> literalLengths,
                       std::span<const std::uint8_t> distanceLengths) {
    std::uint64_t bits = 0;
    for (std::size_t s = 0; s < kLiteralCodes; ++s) {
        const unsigned extra = s > kEndOfBlock ? kLengthRanges[s - kEndOfBlock - 1].extra : 0;
        bits += std::uint64_t{block.literalCounts[s]} * (literalLengths[s] + extra);
    }
    for (std::size_t s = 0; s < kDistanceCodes; ++s)
        bits += std::uint64_t{block.distanceCounts[s]} *
                (distanceLengths[s] + unsigned{kDistanceRanges[s].extra});
    return bits;
}

// At most three codes of literals, or those of a match with their extra bits, fit between flushes.
void putBody(BitWriter& writer, const Block& block, const std::vector<HuffmanCode>& literals,
             const std::vector<HuffmanCode>& distances) {
    static_assert(7 + 3 * kMaxCodeLength <= 56 && 7 + 2 * kMaxCodeLength + 5 + 13 <= 56);
    BitWriter out = std::move(writer); // in registers: nothing that is written can be part of it
    const std::uint8_t* byte = block.bytes.data();
    for (const Step& step : block.steps) {
        const std::uint8_t* const end = byte + step.literals;
        for (; end - byte >= 3; byte += 3) {
            for (std::size_t k = 0; k < 3; ++k) out.put(literals[byte[k]]);
            out.flush();
        }
        for (; byte < end; ++byte) out.put(literals[*byte]);
        out.flush();
        if (step.length == 0) continue;
        const std::size_t slot = kLengthSymbol[step.length - kShortestMatch];
        out.put(literals[kEndOfBlock + 1 + slot]);
        out.put(step.length - unsigned{kLengthRanges[slot].base}, kLengthRanges[slot].extra);
        const std::uint32_t minusOne = step.distanceMinusOne;
        const std::size_t symbol = distanceSymbol(minusOne);
        out.put(distances[symbol]);
        out.put(minusOne + 1 - kDistanceRanges[symbol].base, kDistanceRanges[symbol].extra);
        out.flush();
        byte += step.length;
    }
    out.put(literals[kEndOfBlock]);
    out.flush();
    writer = std::move(out);
}

void putStored(BitWriter& out, std::span<const std::uint8_t> bytes, bool last) {
    constexpr std::size_t kMost = 65535;
    do {
        const auto part = bytes.first(std::min(bytes.size(), kMost));
        bytes = bytes.subspan(part.size());
        out.reserveBits(64);
        out.put(last && bytes.empty() ? 1 : 0, 3);
        out.padToByte();
        out.put(part.size(), 16);
        out.put(part.size() ^ 0xFFFF, 16);
        out.putBytes(part);
    } while (!bytes.empty());
}

// The block in the shortest of the three forms.
void putBlock(BitWriter& out, Block& block, bool last) {
    block.finish();
    block.literalCounts[kEndOfBlock] = 1;
    const auto literalLengths = huffmanLengths(block.literalCounts, kMaxCodeLength);
    const auto distanceLengths = huffmanLengths(block.distanceCounts, kMaxCodeLength);
    const auto usedOf = [](std::span<const std::uint8_t> lengths, std::size_t least) {
        std::size_t used = lengths.size();
        while (used > least && lengths[used - 1] == 0) --used;
        return used;
    };
    const std::size_t literalCount = usedOf(literalLengths, 257);
    const std::size_t distanceCount = usedOf(distanceLengths, 1);
    std::vector<std::uint8_t> lengths(
        literalLengths.begin(), literalLengths.begin() + static_cast<std::ptrdiff_t>(literalCount));
    lengths.insert(lengths.end(), distanceLengths.begin(),
                   distanceLengths.begin() + static_cast<std::ptrdiff_t>(distanceCount));
    const std::vector<LengthToken> packed = packLengths(lengths);
    std::array<std::uint32_t, 19> packedCounts{};
    for (const LengthToken& token : packed) ++packedCounts[token.symbol];
    const auto packedLengths = huffmanLengths(packedCounts, 7);
    std::size_t orderCount = kCodeLengthOrder.size();
    while (orderCount > 4 && packedLengths[kCodeLengthOrder[orderCount - 1]] == 0) --orderCount;

    std::uint64_t headerBits = 14 + 3 * orderCount;
    for (const LengthToken& token : packed)
        headerBits += packedLengths[token.symbol] + unsigned{token.extraBits};
    std::array<std::uint8_t, kDistanceCodes> fives{};
    fives.fill(5);
    const std::uint64_t dynamicBits = headerBits + bodyBits(block, literalLengths, distanceLengths);
    const std::uint64_t fixedBits = bodyBits(block, kFixedLiteralLengths, fives);
    const std::uint64_t storedBits =
        8 * (block.bytes.size() + 5 * (block.bytes.size() / 65535 + 1));

    if (storedBits < std::min(dynamicBits, fixedBits)) return putStored(out, block.bytes, last);
    out.reserveBits(std::min(dynamicBits, fixedBits) + 64);
    out.put(last ? 1 : 0, 1);
    if (fixedBits <= dynamicBits) {
        out.put(1, 2);
        out.flush();
        return putBody(out, block, canonicalCodes(kFixedLiteralLengths), canonicalCodes(fives));
    }
    out.put(2, 2);
    out.put(literalCount - 257, 5);
    out.put(distanceCount - 1, 5);
    out.put(orderCount - 4, 4);
    out.flush();
    for (std::size_t i = 0; i < orderCount; ++i) {
        out.put(packedLengths[kCodeLengthOrder[i]], 3);
        out.flush();
    }
    const std::vector<HuffmanCode> packedCodes = canonicalCodes(packedLengths);
    for (const LengthToken& token : packed) {
        out.put(packedCodes[token.symbol]);
        out.put(token.extra, token.extraBits);
        out.flush();
    }
    putBody(out, block, canonicalCodes(literalLengths), canonicalCodes(distanceLengths));
}

} // namespace

std::vector<std::uint8_t> deflatePiece(std::span<const std::uint8_t> bytes, bool last) {
    BitWriter out;
    Matcher matcher(bytes);
    std::size_t at = 0;
    do {
        Block block;
        const std::size_t start = at;
        while (at < bytes.size() && block.codes() < kBlockCodes) {
            Match match;
            const std::size_t room = kBlockCodes - block.codes();
            const std::size_t found = matcher.next(at, at + room, match);
            block.add(bytes.subspan(at, found - at), match);
            matcher.skip(found, match.length);
            at = found + match.length;
            if (match.length == kLongestMatch && match.distance == 1)
                for (; block.codes() < kBlockCodes && matcher.takeRun(at); at += kLongestMatch)
                    block.add({}, match);
        }
        block.bytes = bytes.subspan(start, at - start);
        putBlock(out, block, last && at == bytes.size());
    } while (at < bytes.size());
    if (!last) putStored(out, {}, false); // ends at a byte
    out.padToByte();
    return std::move(out).result();
}

std::vector<std::uint8_t> deflateZlib(std::span<const std::uint8_t> bytes) {
    std::vector<std::uint8_t> out(kZlibHeader.begin(), kZlibHeader.end());
    const std::vector<std::uint8_t> piece = deflatePiece(bytes, true);
    out.insert(out.end(), piece.begin(), piece.end());
    const auto end = zlibEnd(adler32(bytes));
    out.insert(out.end(), end.begin(), end.end());
    return out;
}
