#include "image/deflate_codes.h"

#include <algorithm>

namespace {

struct Leaf {
    std::uint32_t count;
    std::uint16_t symbol;
};

// How many codes have each length in the optimal code for counts in ascending order.
// Two queues: the leaves and the inner nodes, which are made in ascending order too.
std::vector<std::uint32_t> optimalLengthCounts(const std::vector<Leaf>& leaves) {
    const std::size_t leafCount = leaves.size(), nodeCount = 2 * leafCount - 1;
    std::vector<std::uint64_t> weight(nodeCount);
    std::vector<std::size_t> parent(nodeCount), depth(nodeCount);
    for (std::size_t i = 0; i < leafCount; ++i) weight[i] = leaves[i].count;
    std::size_t leaf = 0, inner = leafCount;
    for (std::size_t made = leafCount; made < nodeCount; ++made) {
        for (int child = 0; child < 2; ++child) {
            const bool takeLeaf =
                leaf < leafCount && (inner == made || weight[leaf] <= weight[inner]);
            const std::size_t smallest = takeLeaf ? leaf++ : inner++;
            weight[made] += weight[smallest];
            parent[smallest] = made;
        }
    }
    std::vector<std::uint32_t> ofLength(leafCount + 1);
    for (std::size_t left = nodeCount - 1; left > 0; --left) {
        const std::size_t i = left - 1;
        depth[i] = depth[parent[i]] + 1;
        if (i < leafCount) ++ofLength[depth[i]];
    }
    return ofLength;
}

// Moves codes that are too long up to `longest`, then lengthens others until Kraft's sum is 1.
void limitLengths(std::vector<std::uint32_t>& ofLength, std::size_t longest) {
    if (ofLength.size() <= longest + 1) return;
    std::uint64_t sum = 0; // in units of 2^-longest
    for (std::size_t n = longest + 1; n < ofLength.size(); ++n) ofLength[longest] += ofLength[n];
    ofLength.resize(longest + 1);
    for (std::size_t n = 1; n <= longest; ++n)
        sum += static_cast<std::uint64_t>(ofLength[n]) << (longest - n);
    for (; sum > std::uint64_t{1} << longest; --sum) {
        std::size_t n = longest - 1;
        while (ofLength[n] == 0) --n;
        // A code of length n becomes two of n + 1; the second is one of the longest.
        --ofLength[n];
        ofLength[n + 1] += 2;
        --ofLength[longest];
    }
}

// The 16 bits from the last to the first.
std::uint32_t reversed16(std::uint32_t x) {
    x = (x & 0x5555) << 1 | (x >> 1 & 0x5555);
    x = (x & 0x3333) << 2 | (x >> 2 & 0x3333);
    x = (x & 0x0F0F) << 4 | (x >> 4 & 0x0F0F);
    return (x & 0x00FF) << 8 | x >> 8;
}

} // namespace

std::vector<std::uint8_t> huffmanLengths(std::span<const std::uint32_t> counts,
                                         std::size_t longest) {
    std::vector<Leaf> leaves;
    leaves.reserve(counts.size());
    for (std::size_t left = counts.size(); left > 0; --left)
        if (const std::size_t s = left - 1; counts[s] > 0)
            leaves.push_back({counts[s], static_cast<std::uint16_t>(s)});
    for (std::size_t s = 0; s < counts.size() && leaves.size() < 2; ++s)
        if (counts[s] == 0) leaves.push_back({1, static_cast<std::uint16_t>(s)});
    std::stable_sort(leaves.begin(), leaves.end(),
                     [](const Leaf& a, const Leaf& b) { return a.count < b.count; });
    std::vector<std::uint32_t> ofLength = optimalLengthCounts(leaves);
    limitLengths(ofLength, longest);
    std::vector<std::uint8_t> lengths(counts.size());
    std::size_t next = leaves.size(); // the most frequent symbols get the shortest codes
    for (std::size_t n = 1; n < ofLength.size(); ++n)
        for (std::uint32_t i = 0; i < ofLength[n]; ++i)
            lengths[leaves[--next].symbol] = static_cast<std::uint8_t>(n);
    return lengths;
}

std::vector<HuffmanCode> canonicalCodes(std::span<const std::uint8_t> lengths) {
    std::array<std::uint32_t, kMaxCodeLength + 2> count{}, next{};
    for (const std::uint8_t n : lengths) ++count[n];
    count[0] = 0;
    for (std::size_t n = 1; n <= kMaxCodeLength; ++n) next[n + 1] = (next[n] + count[n]) << 1;
    std::vector<HuffmanCode> codes(lengths.size());
    for (std::size_t s = 0; s < lengths.size(); ++s) {
        const unsigned n = lengths[s];
        if (n == 0) continue;
        const std::uint32_t code = next[n]++;
        const std::uint32_t fromBack = reversed16(code) >> (16 - n);
        codes[s] = {static_cast<std::uint16_t>(fromBack), static_cast<std::uint8_t>(n)};
    }
    return codes;
}

std::uint64_t bitsOf(const SymbolCounts& counts, std::span<const std::uint8_t> literalLengths,
                     std::span<const std::uint8_t> distanceLengths) {
    std::uint64_t bits = 0;
    for (std::size_t s = 0; s < kLiteralCodes; ++s) {
        const unsigned extra = s > kEndOfBlock ? kLengthRanges[s - kEndOfBlock - 1].extra : 0;
        bits += std::uint64_t{counts.literals[s]} * (literalLengths[s] + extra);
    }
    for (std::size_t s = 0; s < kDistanceCodes; ++s)
        bits += std::uint64_t{counts.distances[s]} *
                (distanceLengths[s] + unsigned{kDistanceRanges[s].extra});
    return bits;
}

DynamicCodes::DynamicCodes(const SymbolCounts& counts)
    : literalLengths_(huffmanLengths(counts.literals, kMostLiteralBits)),
      distanceLengths_(huffmanLengths(counts.distances, kMaxCodeLength)) {
    const auto usedOf = [](std::span<const std::uint8_t> lengths, std::size_t least) {
        std::size_t used = lengths.size();
        while (used > least && lengths[used - 1] == 0) --used;
        return used;
    };
    literalCount_ = usedOf(literalLengths_, 257);
    distanceCount_ = usedOf(distanceLengths_, 1);
    std::vector<std::uint8_t> lengths(literalLengths_.begin(),
                                      literalLengths_.begin() +
                                          static_cast<std::ptrdiff_t>(literalCount_));
    lengths.insert(lengths.end(), distanceLengths_.begin(),
                   distanceLengths_.begin() + static_cast<std::ptrdiff_t>(distanceCount_));
    tokens_ = packed(lengths);
    std::array<std::uint32_t, kCodeLengthOrder.size()> tokenCounts{};
    for (const LengthToken& token : tokens_) ++tokenCounts[token.symbol];
    tokenLengths_ = huffmanLengths(tokenCounts, 7);
    orderCount_ = kCodeLengthOrder.size();
    while (orderCount_ > 4 && tokenLengths_[kCodeLengthOrder[orderCount_ - 1]] == 0) --orderCount_;
}

std::vector<DynamicCodes::LengthToken> DynamicCodes::packed(std::span<const std::uint8_t> lengths) {
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

std::uint64_t DynamicCodes::bits(const SymbolCounts& counts) const {
    std::uint64_t bits =
        3 + 14 + 3 * orderCount_ + bitsOf(counts, literalLengths_, distanceLengths_);
    for (const LengthToken& token : tokens_)
        bits += tokenLengths_[token.symbol] + unsigned{token.extraBits};
    return bits;
}

void DynamicCodes::putHeader(BitWriter& out, bool last) const {
    out.put(last ? 1 : 0, 1);
    out.put(2, 2);
    out.put(literalCount_ - 257, 5);
    out.put(distanceCount_ - 1, 5);
    out.put(orderCount_ - 4, 4);
    out.flush();
    for (std::size_t i = 0; i < orderCount_; ++i) {
        out.put(tokenLengths_[kCodeLengthOrder[i]], 3);
        out.flush();
    }
    const std::vector<HuffmanCode> codes = canonicalCodes(tokenLengths_);
    for (const LengthToken& token : tokens_) {
        out.put(codes[token.symbol]);
        out.put(token.extra, token.extraBits);
        out.flush();
    }
}
