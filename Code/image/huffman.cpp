#include "image/huffman.h"

#include "image/deflate_codes.h"

#include <algorithm>
#include <array>

namespace {

struct Leaf {
    std::uint32_t count;
    std::uint16_t symbol;
};

// Ascending; what is equal stays in its order. Digit by digit, from the last one on.
void sortByCount(std::vector<Leaf>& leaves) {
    constexpr unsigned kBits = 8;
    std::uint32_t all = 0;
    for (const Leaf& leaf : leaves) all |= leaf.count;
    std::vector<Leaf> other(leaves.size());
    for (unsigned shift = 0; shift < 32 && all >> shift != 0; shift += kBits) {
        const auto digit = [shift](const Leaf& leaf) { return leaf.count >> shift & 0xFF; };
        std::array<std::uint32_t, 257> start{};
        for (const Leaf& leaf : leaves) ++start[digit(leaf) + 1];
        for (std::size_t d = 0; d < 256; ++d) start[d + 1] += start[d];
        for (const Leaf& leaf : leaves) other[start[digit(leaf)]++] = leaf;
        leaves.swap(other);
    }
}

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
    sortByCount(leaves);
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
