// Matcher: finds what comes again in a piece of bytes, for deflate.cpp. Knows nothing of codes.
// Private to image/.
#pragma once

#include "image/deflate_codes.h"
#include "image/little_endian.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

struct Match {
    std::size_t length = 0, distance = 0; // length 0: none
};

// The number of equal bytes.
inline std::size_t commonLength(const std::uint8_t* a, const std::uint8_t* b, std::size_t most) {
    std::size_t n = 0;
    for (; n + 16 <= most; n += 16) {
        const std::uint64_t first =
            loadLittle<std::uint64_t>(a + n) ^ loadLittle<std::uint64_t>(b + n);
        const std::uint64_t second =
            loadLittle<std::uint64_t>(a + n + 8) ^ loadLittle<std::uint64_t>(b + n + 8);
        if ((first | second) == 0) continue;
        const std::uint64_t different = first != 0 ? first : second;
        return n + (first != 0 ? 0 : 8) + static_cast<std::size_t>(std::countr_zero(different)) / 8;
    }
    for (; n + 8 <= most; n += 8) {
        const std::uint64_t different =
            loadLittle<std::uint64_t>(a + n) ^ loadLittle<std::uint64_t>(b + n);
        if (different != 0) return n + static_cast<std::size_t>(std::countr_zero(different)) / 8;
    }
    while (n < most && a[n] == b[n]) ++n;
    return n;
}

// The latest place with the same hash of its first bytes, one place per hash: noise makes chains of
// places long and worthless.
class MatchFinder {
public:
    // Where speed and size meet for pictures (measured with filtered 1920x1080 renders).
    static constexpr std::size_t kShortRun = 4;   // the shortest match with the byte before
    static constexpr std::size_t kShortMatch = 6; // the shortest match elsewhere
    static constexpr std::size_t kNoiseMatch = 8; // and in noise, where it spares few bits

    explicit MatchFinder(std::span<const std::uint8_t> bytes)
        : bytes_(bytes), latest_(std::size_t{1} << kHashBits) {}

    // Of the first kShortMatch bytes of eight, in so many bits.
    static std::size_t hashOf(std::uint64_t eight, unsigned bits) {
        // 2^64 / golden ratio
        return (eight << (64 - 8 * kShortMatch)) * 0x9E3779B97F4A7C15u >> (64 - bits);
    }
    // The first `count` bytes?
    static bool isZero(std::uint64_t eight, std::size_t count) {
        return eight << (64 - 8 * count) == 0;
    }
    // Of the places that can be looked at: eight bytes are there.
    std::size_t end() const { return bytes_.size() - std::min<std::size_t>(bytes_.size(), 7); }
    bool canLook(std::size_t at) const { return at < end(); }
    // Places go in once, in order, before any place after them is looked for.
    void insert(std::size_t at) {
        latest_[hashOf(eightAt(at), kHashBits)] = static_cast<std::uint16_t>(at + 1);
    }
    // Inserts the place; a match longer than `atLeast`, or none; elsewhere than with the byte
    // before it has `shortest` bytes. Runs of one byte come first: a filtered picture is full of
    // them.
    Match look(std::size_t at, std::size_t atLeast, std::size_t shortest) {
        const std::uint64_t here = eightAt(at);
        std::uint16_t& latest = latest_[hashOf(here, kHashBits)];
        // Wrong for places of long ago: what is there is compared anyway.
        const std::size_t distance = static_cast<std::uint16_t>(at + 1 - latest);
        const bool isThere = (latest != 0) & (distance != 0) & (distance <= std::min(at, kWindow));
        latest = static_cast<std::uint16_t>(at + 1);
        const std::uint64_t fromRun = here ^ eightAt(at - (at > 0 ? 1 : 0));
        const std::uint64_t fromLatest = here ^ eightAt(at - (isThere ? distance : 0));
        const bool isRun = (at > 0) & isZero(fromRun, kShortRun);
        const bool isMatch = isThere & isZero(fromLatest, shortest);
        // One branch for all that is to be: most looks find nothing.
        if (!(isRun | isMatch)) return {};
        Match best;
        if (isRun) {
            const std::size_t length = lengthAt(at, 1, fromRun);
            if (length > atLeast) best = {length, 1};
            if (best.length == kLongestMatch) return best;
        }
        if (isMatch) {
            const std::size_t length = lengthAt(at, distance, fromLatest);
            if (length > std::max(atLeast, best.length)) best = {length, distance};
        }
        return best;
    }

private:
    static constexpr unsigned kHashBits = 14; // 32 KiB: stays near the processor

    std::uint64_t eightAt(std::size_t at) const {
        return loadLittle<std::uint64_t>(bytes_.data() + at);
    }
    // `different` is zero where the first eight bytes are equal.
    std::size_t lengthAt(std::size_t at, std::size_t distance, std::uint64_t different) const {
        if (different != 0) return static_cast<std::size_t>(std::countr_zero(different)) / 8;
        const std::uint8_t* const ninth = bytes_.data() + at + 8;
        const std::size_t most = std::min(kLongestMatch, bytes_.size() - at) - 8;
        return 8 + commonLength(ninth, ninth - distance, most);
    }

    std::span<const std::uint8_t> bytes_;
    std::vector<std::uint16_t> latest_; // by hash: the last bits of place + 1; 0 is none
};

// Goes through the bytes from the front and hands out steps.
class Matcher {
public:
    explicit Matcher(std::span<const std::uint8_t> bytes) : bytes_(bytes), finder_(bytes) {}

    // The next match from `at` on and where it starts; the end of the bytes when there is none.
    // Places from `limit` on are not looked at.
    std::size_t next(std::size_t at, std::size_t limit, Match& match) {
        const std::size_t first = at;
        for (std::size_t misses = 0; at < limit && finder_.canLook(at); ++misses) {
            const bool isNoise = misses > kNoiseMisses;
            match = finder_.look(at, 0, isNoise ? Finder::kNoiseMatch : Finder::kShortMatch);
            if (match.length > 0) {
                lookFurther(at, match);
                extendBack(first, at, match);
                return at;
            }
            // In noise a look is worth less and less.
            const std::size_t end = at + std::min(kLongestStep, 1 + misses);
            while (++at < end && finder_.canLook(at)) finder_.insert(at);
        }
        match = {};
        return finder_.canLook(at) ? at : bytes_.size();
    }
    // The places in a match; of long ones, which are runs most of the time, the last two.
    void skip(std::size_t at, std::size_t length) {
        constexpr std::size_t kLong = 32, kGroup = 4;
        const std::size_t end = std::min(at + length, finder_.end());
        std::size_t i = std::max(length <= kLong ? at + 1 : at + length - 2, looked_ + 1);
        if (end < i + kGroup) {
            for (; i < end; ++i) finder_.insert(i);
            return;
        }
        // In groups, whose number the processor guesses more often than that of the places; the
        // last one repeats some of the one before.
        for (; i + kGroup < end; i += kGroup)
            for (std::size_t k = 0; k < kGroup; ++k) finder_.insert(i + k);
        for (std::size_t k = end - kGroup; k < end; ++k) finder_.insert(k);
    }

    // Behind a longest match with the byte before, as in a plain background: does another one come,
    // with bytes behind it that are still the same? Then nobody need look for it: all of its places
    // have one hash, and the last one counts.
    bool takeRun(std::size_t at) {
        constexpr std::size_t kSize = kLongestMatch + 8; // the bytes of the last place's hash, too
        if (at + kSize > bytes_.size() || std::memcmp(&bytes_[at], &bytes_[at - 1], kSize) != 0)
            return false;
        finder_.insert(at + kLongestMatch - 1);
        return true;
    }

private:
    using Finder = MatchFinder;
    static constexpr std::size_t kGoodMatch = 8;    // long enough: no look at the next place
    static constexpr std::size_t kNoiseMisses = 12; // looks without a match
    static constexpr std::size_t kLongestStep = 32;

    // A longer match one place later is worth a literal (lazy matching, RFC 1951 section 4).
    void lookFurther(std::size_t& at, Match& match) {
        looked_ = at;
        while (match.length < kGoodMatch && finder_.canLook(at + 1)) {
            looked_ = at + 1;
            const Match later = finder_.look(at + 1, match.length, Finder::kShortMatch);
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

    std::span<const std::uint8_t> bytes_;
    MatchFinder finder_;
    std::size_t looked_ = 0; // the last place that went into the finder
};
