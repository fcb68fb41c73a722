// Packs bytes by RFC 1951. Knows nothing about PNG.
#include "image/bits.h"
#include "image/deflate_codes.h"
#include "image/matcher.h"
#include "image/zlib.h"

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

namespace {

constexpr std::size_t kBlockCodes = 1 << 16; // a new Huffman code about every 60 rows

// Some bytes as they are and a match behind them (length 0: none).
struct Step {
    std::uint32_t literals;
    std::uint16_t length, distanceMinusOne;
};

// Two symbols per power of two.
std::size_t distanceSymbol(std::uint32_t distanceMinusOne) {
    if (distanceMinusOne < 2) return distanceMinusOne;
    const auto top = static_cast<unsigned>(std::bit_width(distanceMinusOne)) - 1;
    return 2 * top + (distanceMinusOne >> (top - 1) & 1);
}

// What one block consists of, with its symbol counts.
struct Block {
    std::span<const std::uint8_t> bytes;
    std::vector<Step> steps;
    SymbolCounts counts;
    std::size_t codes = 0;

    void add(std::span<const std::uint8_t> literals, Match match) {
        for (const std::uint8_t byte : literals) ++counts.literals[byte];
        codes += literals.size() + 1;
        const auto count = static_cast<std::uint32_t>(literals.size());
        if (match.length == 0) return steps.push_back({count, 0, 0});
        const auto minusOne = static_cast<std::uint16_t>(match.distance - 1);
        steps.push_back({count, static_cast<std::uint16_t>(match.length), minusOne});
        ++counts.literals[lengthSymbol(match.length)];
        ++counts.distances[distanceSymbol(minusOne)];
    }
};

// Four codes of literals, or those of a match with their extra bits, fit between two flushes.
void putBody(BitWriter& writer, const Block& block, const std::vector<HuffmanCode>& literals,
             const std::vector<HuffmanCode>& distances) {
    static_assert(7 + 4 * DynamicCodes::kMostLiteralBits <= 64);
    static_assert(DynamicCodes::kMostLiteralBits + 5 + kMaxCodeLength + 13 <= 56);
    BitWriter out = std::move(writer); // in registers: nothing that is written can be part of it
    const HuffmanCode* const ofByte = literals.data();
    const std::uint8_t* byte = block.bytes.data();
    for (const Step& step : block.steps) {
        const std::uint8_t* const end = byte + step.literals;
        for (; end - byte >= 4; byte += 4) {
            for (std::size_t k = 0; k < 4; ++k) out.put(ofByte[byte[k]]);
            out.flush();
        }
        for (; byte < end; ++byte) out.put(ofByte[*byte]);
        out.flush();
        if (step.length == 0) continue;
        const std::size_t slot = kLengthSlot[step.length];
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
    block.counts.literals[kEndOfBlock] = 1;
    const DynamicCodes dynamic(block.counts);
    std::array<std::uint8_t, kDistanceCodes> fives{};
    fives.fill(5);
    const std::uint64_t dynamicBits = dynamic.bits(block.counts);
    const std::uint64_t fixedBits = 3 + bitsOf(block.counts, kFixedLiteralLengths, fives);
    const std::uint64_t storedBits =
        3 + 8 * (block.bytes.size() + 5 * (block.bytes.size() / 65535 + 1));

    if (storedBits < std::min(dynamicBits, fixedBits)) return putStored(out, block.bytes, last);
    out.reserveBits(std::min(dynamicBits, fixedBits) + 64);
    if (fixedBits <= dynamicBits) {
        out.put(last ? 1 : 0, 1);
        out.put(1, 2);
        out.flush();
        return putBody(out, block, canonicalCodes(kFixedLiteralLengths), canonicalCodes(fives));
    }
    dynamic.putHeader(out, last);
    putBody(out, block, canonicalCodes(dynamic.literalLengths()),
            canonicalCodes(dynamic.distanceLengths()));
}

// `finder` hands out matches from the front: Matcher or RunFinder.
template <class Finder>
void putMatches(BitWriter& out, std::span<const std::uint8_t> bytes, Finder finder, bool last) {
    std::size_t at = 0;
    do {
        Block block;
        // All steps but the last have a match.
        block.steps.reserve(std::min(kBlockCodes, (bytes.size() - at) / kShortestMatch) + 1);
        const std::size_t start = at;
        while (at < bytes.size() && block.codes < kBlockCodes) {
            Match match;
            const std::size_t found = finder.next(at, at + kBlockCodes - block.codes, match);
            block.add(bytes.subspan(at, found - at), match);
            finder.skip(found, match.length);
            at = found + match.length;
        }
        block.bytes = bytes.subspan(start, at - start);
        putBlock(out, block, last && at == bytes.size());
    } while (at < bytes.size());
}

} // namespace

std::vector<std::uint8_t> deflatePiece(std::span<const std::uint8_t> bytes, bool last,
                                       Packing packing, std::vector<std::uint8_t> before) {
    BitWriter out(std::move(before));
    if (packing == Packing::Runs)
        putMatches(out, bytes, RunFinder(bytes), last);
    else
        putMatches(out, bytes, Matcher(bytes), last);
    if (!last) putStored(out, {}, false); // ends at a byte
    out.padToByte();
    return std::move(out).result();
}

Packing choosePacking(std::span<const std::uint8_t> bytes) {
    constexpr std::size_t kSample = std::size_t{1} << 14;
    const std::size_t size = std::min(bytes.size(), kSample);
    const auto sizeAs = [sample = bytes.subspan((bytes.size() - size) / 2, size)](Packing packing) {
        return deflatePiece(sample, true, packing).size();
    };
    return 100 * sizeAs(Packing::Matches) <= 95 * sizeAs(Packing::Runs) ? Packing::Matches
                                                                        : Packing::Runs;
}
