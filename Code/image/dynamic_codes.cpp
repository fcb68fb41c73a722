#include "image/dynamic_codes.h"

#include <algorithm>

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

DynamicCodes::DynamicCodes(const SymbolCounts& counts, std::size_t longest)
    : literalLengths_(huffmanLengths(counts.literals, longest)),
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
