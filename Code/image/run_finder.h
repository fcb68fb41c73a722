// RunFinder: finds runs of one byte in a piece of bytes, for deflate.cpp. What Matcher does,
// without a search. Private to image/.
#pragma once

#include "image/deflate_codes.h"
#include "image/matcher.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

class RunFinder {
public:
    explicit RunFinder(std::span<const std::uint8_t> bytes)
        : bytes_(bytes), end_(bytes.size() - std::min<std::size_t>(bytes.size(), 7)) {}

    // The next run from `at` on, as a match with the byte before, and where it starts; the end of
    // the bytes when there is none. Places from `limit` on are not looked at.
    std::size_t next(std::size_t at, std::size_t limit, Match& match) const {
        match = {};
        const std::size_t last = std::min(limit, end_);
        at = std::max<std::size_t>(at, 1);
        for (; at < last; at += kTogether) {
            const std::uint64_t different = eightAt(at) ^ eightAt(at - 1);
            // The highest bit of each byte that is as the one before it.
            const std::uint64_t equal = ~((((different & kLow) + kLow) | different) | kLow);
            const std::uint64_t two = equal & equal >> 8, four = two & two >> 16;
            if (four == 0) continue;
            at += static_cast<std::size_t>(std::countr_zero(four)) / 8;
            if (at < last) match = {lengthAt(at), 1};
            break;
        }
        return std::min(at, last) < end_ ? std::min(at, last) : bytes_.size();
    }
    void skip(std::size_t, std::size_t) const {}
    // See Matcher.
    bool takeRun(std::size_t at) const {
        return at + kLongestMatch <= bytes_.size() && lengthAt(at) == kLongestMatch;
    }

private:
    static constexpr std::uint64_t kLow = 0x7F7F7F7F7F7F7F7F;
    static constexpr std::size_t kShortRun = 4;
    static constexpr std::size_t kTogether = 8 - kShortRun + 1; // places of which eight bytes tell

    std::uint64_t eightAt(std::size_t at) const {
        return loadLittle<std::uint64_t>(bytes_.data() + at);
    }
    std::size_t lengthAt(std::size_t at) const {
        const std::size_t most = std::min(kLongestMatch, bytes_.size() - at);
        return commonLength(&bytes_[at], &bytes_[at - 1], most);
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t end_; // of the places at which eight bytes are there
};
