#include "image/deflate.h"

#include "image/checksum.h"
#include "image/deflate_codes.h"
#include "image/huffman.h"
#include "image/little_endian.h"

#include <algorithm>
#include <array>
#include <bit>

namespace {

// Where speed and size meet for pictures (measured with filtered 1920x1080 renders).
constexpr std::size_t kBlockTokens = 1 << 15; // a new Huffman code about every 30 rows
constexpr int kChainDepth = 4;                // candidates that are compared with the current place
constexpr std::size_t kGoodMatch = 16;        // long enough: no look at the next place

// A literal (length 0 and the byte) or a match, as distance - 1 and length << 16.
using Token = std::uint32_t;

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
    unsigned bitsInByte() const { return count_; }
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

// The tokens of one block with their symbol counts.
struct Block {
    std::vector<Token> tokens;
    std::array<std::uint32_t, kLiteralCodes> literalCounts{};
    std::array<std::uint32_t, kDistanceCodes> distanceCounts{};

    void addLiteral(std::uint8_t byte) {
        tokens.push_back(byte);
        ++literalCounts[byte];
    }
    void addMatch(std::size_t length, std::size_t distance) {
        const auto minusOne = static_cast<std::uint32_t>(distance - 1);
        tokens.push_back(static_cast<Token>(length << 16) | minusOne);
        ++literalCounts[kEndOfBlock + 1 + kLengthSymbol[length - kShortestMatch]];
        ++distanceCounts[distanceSymbol(minusOne)];
    }
    void clear() {
        tokens.clear();
        literalCounts.fill(0);
        distanceCounts.fill(0);
    }
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

void putBody(BitWriter& out, const Block& block, const std::vector<HuffmanCode>& literals,
             const std::vector<HuffmanCode>& distances) {
    for (const Token token : block.tokens) {
        const std::size_t length = token >> 16;
        if (length == 0) {
            out.put(literals[token]);
        } else {
            const std::size_t slot = kLengthSymbol[length - kShortestMatch];
            out.put(literals[kEndOfBlock + 1 + slot]);
            out.put(length - kLengthRanges[slot].base, kLengthRanges[slot].extra);
            const std::uint32_t minusOne = token & 0xFFFF;
            const std::size_t symbol = distanceSymbol(minusOne);
            out.put(distances[symbol]);
            out.put(minusOne + 1 - kDistanceRanges[symbol].base, kDistanceRanges[symbol].extra);
        }
        out.flush();
    }
    out.put(literals[kEndOfBlock]);
    out.flush();
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
void putBlock(BitWriter& out, Block& block, std::span<const std::uint8_t> bytes, bool last) {
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
    const std::uint64_t storedBits = 8 * (bytes.size() + 5 * (bytes.size() / 65535 + 1));

    if (storedBits < std::min(dynamicBits, fixedBits)) return putStored(out, bytes, last);
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

struct Match {
    std::size_t length = 0, distance = 0;
};

// Earlier places with the same next four bytes, by hash, the latest first; and the latest one with
// the same three.
class MatchFinder {
public:
    explicit MatchFinder(std::span<const std::uint8_t> bytes)
        : bytes_(bytes), head_(std::size_t{1} << kHashBits), before_(kWindow),
          latestOfThree_(std::size_t{1} << kHashBitsOfThree) {}

    bool canInsert(std::size_t at) const { return at + 4 <= bytes_.size(); }
    // Every place goes in once, in order, before any place after it is looked for.
    void insert(std::size_t at) {
        const auto four = loadLittle<std::uint32_t>(bytes_.data() + at);
        std::uint32_t& head = head_[hash(four, kHashBits)];
        before_[at % kWindow] = head;
        std::uint32_t& latest = latestOfThree_[hash(four << 8, kHashBitsOfThree)];
        three_ = latest;
        head = latest = static_cast<std::uint32_t>(at + 1); // 0: nowhere
    }
    // The longest match of the place that was inserted last, longer than `atLeast`.
    Match longest(std::size_t at, std::size_t atLeast) const {
        const std::uint8_t* here = bytes_.data() + at;
        const auto four = loadLittle<std::uint32_t>(here);
        const std::size_t most = std::min(kLongestMatch, bytes_.size() - at);
        Match best{std::max(atLeast, kShortestMatch), 0};
        std::uint32_t place = before_[at % kWindow];
        for (int i = 0; i < kChainDepth && place != 0 && best.length < most; ++i) {
            const std::size_t from = place - 1, distance = at - from;
            if (distance > kWindow) break;
            const std::uint8_t* there = bytes_.data() + from;
            if (there[best.length] == here[best.length] &&
                loadLittle<std::uint32_t>(there) == four) {
                const std::size_t length = commonLength(there, here, most);
                if (length > best.length) best = {length, distance};
            }
            place = before_[from % kWindow];
            if (place > from) break; // overwritten by a later place
        }
        if (best.distance != 0) return best;
        if (atLeast < kShortestMatch && three_ != 0 && at - (three_ - 1) <= kTooFarForThree) {
            const std::size_t from = three_ - 1;
            if ((loadLittle<std::uint32_t>(bytes_.data() + from) ^ four) << 8 == 0)
                return {kShortestMatch, at - from};
        }
        return {};
    }

private:
    static constexpr unsigned kHashBits = 16, kHashBitsOfThree = 14;
    static constexpr std::size_t kTooFarForThree = 4096; // three literals cost less (zlib)

    static std::size_t hash(std::uint32_t bytes, unsigned bits) {
        return bytes * 0x9E3779B1u >> (32 - bits); // golden ratio
    }
    // The first four bytes are equal.
    static std::size_t commonLength(const std::uint8_t* a, const std::uint8_t* b,
                                    std::size_t most) {
        std::size_t n = 4;
        for (; n + 8 <= most; n += 8) {
            const std::uint64_t different =
                loadLittle<std::uint64_t>(a + n) ^ loadLittle<std::uint64_t>(b + n);
            if (different != 0)
                return n + static_cast<std::size_t>(std::countr_zero(different)) / 8;
        }
        while (n < most && a[n] == b[n]) ++n;
        return n;
    }

    std::span<const std::uint8_t> bytes_;
    std::vector<std::uint32_t> head_;          // by hash: the latest place + 1
    std::vector<std::uint32_t> before_;        // by place % kWindow: the one before in its chain
    std::vector<std::uint32_t> latestOfThree_; // by hash of three bytes: the latest place + 1
    std::uint32_t three_ = 0;                  // of the place that was inserted last
};

} // namespace

std::vector<std::uint8_t> deflateZlib(std::span<const std::uint8_t> bytes) {
    BitWriter out;
    constexpr std::array<std::uint8_t, 2> kHeader{0x78, 0x5E}; // window 32 K, fast
    out.putBytes(kHeader);
    MatchFinder finder(bytes);
    Block block;
    block.tokens.reserve(kBlockTokens + 1);
    const auto matchAt = [&](std::size_t at, std::size_t atLeast) {
        if (!finder.canInsert(at)) return Match{};
        finder.insert(at);
        return finder.longest(at, atLeast);
    };
    std::size_t blockStart = 0;
    Match match = matchAt(0, 0);
    for (std::size_t at = 0; at < bytes.size();) {
        const std::size_t next = at + 1;
        // A longer match one place later is worth a literal (lazy matching, RFC 1951 section 4).
        const bool looked = match.length < kGoodMatch;
        const Match later = looked ? matchAt(next, match.length) : Match{};
        if (match.length == 0 || later.length > 0) {
            block.addLiteral(bytes[at]);
            match = later;
            at = next;
        } else {
            block.addMatch(match.length, match.distance);
            const std::size_t end = at + match.length;
            for (at = looked ? next + 1 : next; at < end; ++at)
                if (finder.canInsert(at)) finder.insert(at);
            match = matchAt(at, 0);
        }
        if (block.tokens.size() >= kBlockTokens && at < bytes.size()) {
            putBlock(out, block, bytes.subspan(blockStart, at - blockStart), false);
            block.clear();
            blockStart = at;
        }
    }
    putBlock(out, block, bytes.subspan(blockStart), true);
    const std::uint32_t sum = adler32(bytes);
    const std::array<std::uint8_t, 4> checksum{
        static_cast<std::uint8_t>(sum >> 24), static_cast<std::uint8_t>(sum >> 16),
        static_cast<std::uint8_t>(sum >> 8), static_cast<std::uint8_t>(sum)};
    out.putBytes(checksum);
    return std::move(out).result();
}
