// MatchTrial: do matches other than runs spare much? In most rendered pictures, once their rows are
// filtered, they do not, and to look for them takes more time than all else. For matcher.h.
// Private to image/.
#pragma once

#include "image/byte_counts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

class MatchTrial {
public:
    // Starts anew: of the bytes from place `begin` to `end` or a little farther.
    void start(std::size_t begin, std::size_t end) {
        *this = {};
        begin_ = begin, end_ = end;
    }
    std::size_t begin() const { return begin_; }
    std::size_t end() const { return end_; }
    // `bytes` are found some place before.
    void addMatch(std::span<const std::uint8_t> bytes) {
        ++matches_;
        for (const std::uint8_t byte : bytes) ++inMatches_[byte];
    }
    // So many bytes are as the one before.
    void addRun(std::uint8_t byte, std::size_t length) {
        inRuns_[byte] += static_cast<std::uint32_t>(length);
    }
    // Do matches spare a good part of the bits? `bytes`: all from begin() on. Bytes take as many
    // bits as a code for those that are not in runs would give them, one at least.
    bool pays(std::span<const std::uint8_t> bytes) const {
        if (matches_ == 0) return false;
        ByteCounts counts;
        counts.add(bytes);
        std::array<std::uint32_t, 256> count = counts.sums();
        std::uint64_t sum = 0;
        for (std::size_t b = 0; b < count.size(); ++b) {
            count[b] -= std::min(count[b], inRuns_[b]);
            sum += count[b];
        }
        std::uint64_t all = 0, matched = 0;
        for (std::size_t b = 0; b < count.size(); ++b) {
            if (count[b] == 0) continue;
            const std::uint64_t bits = std::max(kBit, log2Of(sum) - log2Of(count[b]));
            all += count[b] * bits, matched += inMatches_[b] * bits;
        }
        const std::uint64_t asMatches = matches_ * kBitsOfMatch * kBit;
        return matched > asMatches && (matched - asMatches) * kLeastPart > all;
    }

private:
    static constexpr std::uint64_t kBit = 64;         // unit of what is counted in bits
    static constexpr std::uint64_t kBitsOfMatch = 19; // of its codes and what follows them, about
    static constexpr std::uint64_t kLeastPart = 32;   // one in so many is worth the time

    // Of n > 0, straight between powers of two: 0.09 bits too small at most. The same everywhere,
    // as what files are depends on it.
    static std::uint64_t log2Of(std::uint64_t n) {
        const auto top = static_cast<unsigned>(std::bit_width(n)) - 1;
        return kBit * top + ((n * kBit >> top) - kBit);
    }

    std::size_t begin_ = 0, end_ = 0;
    std::uint64_t matches_ = 0;
    std::array<std::uint32_t, 256> inMatches_{}, inRuns_{}; // by byte
};
