// Matcher and RunFinder: find what comes again in a piece of bytes, and what is as the byte before,
// for deflate.cpp. Know nothing of codes.
// Private to image/.
#pragma once

#include "image/bits.h"
#include "image/deflate_codes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

struct Match {
    std::size_t length = 0, distance = 0; // length 0: none
};

// What both have: bytes, of which eight are looked at together.
class LookAtBytes {
protected:
    // Where speed and size meet for pictures (measured with filtered 1920x1080 renders).
    static constexpr std::size_t kShortRun = 4;   // the shortest match with the byte before
    static constexpr std::size_t kShortMatch = 6; // the shortest match elsewhere

    explicit LookAtBytes(std::span<const std::uint8_t> bytes)
        : bytes_(bytes), end_(bytes.size() - std::min<std::size_t>(bytes.size(), 7)) {}

    std::uint64_t eightAt(std::size_t at) const {
        return loadLittle<std::uint64_t>(bytes_.data() + at);
    }
    // The number of bytes that are as those before them.
    std::size_t lengthAt(std::size_t at, std::size_t distance) const {
        const std::uint8_t *const here = &bytes_[at], *const before = here - distance;
        const std::size_t most = std::min(kLongestMatch, bytes_.size() - at);
        std::size_t n = 0;
        for (; n + 8 <= most; n += 8) {
            const std::uint64_t different = eightAt(at + n) ^ eightAt(at + n - distance);
            if (different != 0)
                return n + static_cast<std::size_t>(std::countr_zero(different)) / 8;
        }
        while (n < most && here[n] == before[n]) ++n;
        return n;
    }

    std::span<const std::uint8_t> bytes_;
    std::size_t end_; // of the places at which eight bytes are there
};

// Knows the latest place with the same hash of its first bytes, one place per hash: noise makes
// chains of places long and worthless.
class Matcher : LookAtBytes {
public:
    explicit Matcher(std::span<const std::uint8_t> bytes)
        : LookAtBytes(bytes), latest_(std::size_t{1} << kHashBits) {}

    // The next match from `at` on and where it starts; the end of the bytes when there is none.
    // Places from `limit` on are not looked at.
    std::size_t next(std::size_t at, std::size_t limit, Match& match) {
        const std::size_t first = at;
        for (std::size_t misses = 0; at < std::min(limit, end_); ++misses) {
            match = look(at, 0);
            if (match.length > 0) {
                lookFurther(at, match);
                extendBack(first, at, match);
                return at;
            }
            // In noise a look is worth less and less.
            const std::size_t end = std::min(end_, at + std::min(kLongestStep, 1 + misses));
            while (++at < end) insert(at);
        }
        match = {};
        return at < end_ ? at : bytes_.size();
    }
    // The places in a match; of long ones, which are runs most of the time, the last two.
    void skip(std::size_t at, std::size_t length) {
        constexpr std::size_t kLong = 32;
        const std::size_t end = std::min(at + length, end_);
        std::size_t i = std::max(length <= kLong ? at + 1 : at + length - 2, looked_ + 1);
        for (; i < end; ++i) insert(i);
    }

private:
    static constexpr unsigned kHashBits = 14;    // 32 KiB: stays near the processor
    static constexpr std::size_t kGoodMatch = 8; // long enough: no look at the next place
    static constexpr std::size_t kLongestStep = 32;

    // Where the latest place stands that has the same first kShortMatch bytes, or others by chance.
    std::uint16_t& latestLike(std::uint64_t eight) {
        constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15u; // 2^64 / golden ratio
        return latest_[(eight << (64 - 8 * kShortMatch)) * kGolden >> (64 - kHashBits)];
    }
    // The first `count` bytes?
    static bool isZero(std::uint64_t eight, std::size_t count) {
        return eight << (64 - 8 * count) == 0;
    }
    // Places go in once, in order, before any place after them is looked for.
    void insert(std::size_t at) { latestLike(eightAt(at)) = static_cast<std::uint16_t>(at + 1); }
    // Inserts the place; a match longer than `atLeast`, or none. Runs of one byte come first: a
    // filtered picture is full of them.
    Match look(std::size_t at, std::size_t atLeast) {
        const std::uint64_t here = eightAt(at);
        std::uint16_t& latest = latestLike(here);
        // Wrong for places of long ago: what is there is compared anyway.
        const std::size_t distance = static_cast<std::uint16_t>(at + 1 - latest);
        const bool isThere = latest != 0 && distance != 0 && distance <= std::min(at, kWindow);
        latest = static_cast<std::uint16_t>(at + 1);
        Match best;
        if (at > 0 && isZero(here ^ eightAt(at - 1), kShortRun))
            if (const std::size_t length = lengthAt(at, 1); length > atLeast) best = {length, 1};
        if (isThere && isZero(here ^ eightAt(at - distance), kShortMatch))
            if (const std::size_t length = lengthAt(at, distance);
                length > std::max(atLeast, best.length))
                best = {length, distance};
        return best;
    }
    // A longer match one place later is worth a literal (lazy matching, RFC 1951 section 4).
    void lookFurther(std::size_t& at, Match& match) {
        looked_ = at;
        while (match.length < kGoodMatch && at + 1 < end_) {
            looked_ = at + 1;
            const Match later = look(at + 1, match.length);
            if (later.length == 0) return;
            match = later;
            ++at;
        }
    }
    // Over places that were not looked at.
    void extendBack(std::size_t first, std::size_t& at, Match& match) const {
        while (at > first && match.distance < at && match.length < kLongestMatch &&
               bytes_[at - 1] == bytes_[at - 1 - match.distance]) {
            --at;
            ++match.length;
        }
    }

    std::vector<std::uint16_t> latest_; // by hash: the last bits of place + 1; 0 is none
    std::size_t looked_ = 0;            // the last place that went in
};

// Finds only runs of one byte, without a search.
class RunFinder : LookAtBytes {
public:
    explicit RunFinder(std::span<const std::uint8_t> bytes) : LookAtBytes(bytes) {}

    // As Matcher's; matches are with the byte before.
    std::size_t next(std::size_t at, std::size_t limit, Match& match) const {
        constexpr std::uint64_t kLow = 0x7F7F7F7F7F7F7F7F;
        constexpr std::size_t kTogether = 8 - kShortRun + 1; // places of which eight bytes tell
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
            if (at < last) match = {lengthAt(at, 1), 1};
            break;
        }
        return std::min(at, last) < end_ ? std::min(at, last) : bytes_.size();
    }
    void skip(std::size_t, std::size_t) const {}
};
