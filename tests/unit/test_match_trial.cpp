// Code/image/match_trial.h, and what matcher.h makes of it.
#include "check.h"
#include "deflate_kit.h"

#include "image/checksum.h"
#include "image/deflate.h"
#include "image/inflate.h"
#include "image/match_trial.h"
#include "image/matcher.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace {

constexpr std::uint32_t kSeed = 17;
// So many random bits in each byte, 7 at most.
Buffer noise(std::size_t size, unsigned bits, std::uint32_t& state) {
    Buffer bytes(size);
    for (std::uint8_t& byte : bytes)
        byte = static_cast<std::uint8_t>(nextRandom(state) & ((1u << bits) - 1));
    return bytes;
}
// As the rows of a shaded surface are when they are filtered: each value half as often as the one
// before.
Buffer geometric(std::size_t size, std::uint32_t& state) {
    Buffer bytes(size);
    for (std::uint8_t& byte : bytes)
        byte = static_cast<std::uint8_t>(std::countr_zero(nextRandom(state) | 0x80u));
    return bytes;
}
void add(Buffer& to, const Buffer& more) { to.insert(to.end(), more.begin(), more.end()); }

struct Steps {
    std::size_t runs = 0, others = 0; // matches from a place on
};
Steps stepsFrom(const Buffer& bytes, std::size_t from) {
    Matcher matcher(bytes, 2048);
    Steps steps;
    for (std::size_t at = 0; at < bytes.size();) {
        Match match;
        at = matcher.next(at, bytes.size(), match);
        matcher.skip(at, match.length);
        if (match.length > 0 && at >= from) ++(match.distance == 1 ? steps.runs : steps.others);
        at += match.length;
    }
    return steps;
}

} // namespace

// A match costs 19 bits, whatever its length is.
TEST(match_trial_weighs_bits) {
    std::uint32_t state = kSeed;
    for (const unsigned bits : {1u, 2u, 4u, 7u})
        for (std::size_t length = 3; length <= 40; ++length) {
            constexpr std::size_t kSize = 2048, kMatches = 40;
            const Buffer bytes = noise(kSize, bits, state);
            MatchTrial trial;
            trial.start(0, kSize);
            for (std::size_t i = 0; i < kMatches; ++i)
                trial.addMatch(std::span(bytes).subspan(i * length, length));
            const double spared = kMatches * (static_cast<double>(length * bits) - 19),
                         all = static_cast<double>(kSize * bits);
            // A twentieth for the counts that chance gives and for the logarithm.
            const double error = 0.05 * static_cast<double>(kMatches * length * bits);
            if (std::abs(spared - all / 32) < error) continue;
            CHECK_INFO(trial.pays(bytes) == (spared > all / 32),
                       kMatches << " of " << length << " bytes of " << bits << " bits, seed "
                                << kSeed);
        }
}

// Runs are found anyway: what is in them counts for nothing.
TEST(match_trial_leaves_runs_out) {
    std::uint32_t state = kSeed;
    Buffer bytes = noise(200, 7, state);
    add(bytes, Buffer(1800, 3));
    MatchTrial trial;
    trial.start(0, bytes.size());
    trial.addRun(3, 1800);
    CHECK(!trial.pays(bytes));
    trial.addMatch(std::span(bytes).first(8)); // 56 bits less 19, of 1400
    CHECK(!trial.pays(bytes));
    trial.addMatch(std::span(bytes).subspan(8, 8));
    CHECK(trial.pays(bytes));
}

// Short matches by chance in what packs well are not looked for after a trial; runs are.
TEST(matcher_looks_for_runs_alone_where_others_do_not_pay) {
    std::uint32_t state = kSeed;
    Buffer bytes = geometric(40'000, state);
    for (std::size_t at = 100; at < bytes.size(); at += 500) std::fill_n(&bytes[at], 60, 9);
    const Steps early = stepsFrom(Buffer(bytes.begin(), bytes.begin() + 2000), 0);
    CHECK_INFO(early.others > 0, early.others);
    bytes.resize(30'000); // in front of the next trial
    const Steps late = stepsFrom(bytes, 2500);
    CHECK_EQUAL(late.others, std::size_t{0});
    CHECK_INFO(late.runs >= 55, late.runs); // those of chance, too
}

// And others where they do.
TEST(matcher_looks_for_all_matches_where_they_pay) {
    std::uint32_t state = kSeed;
    const Buffer word = noise(700, 7, state);
    Buffer bytes;
    for (int i = 0; i < 60; ++i) add(bytes, word);
    const Steps steps = stepsFrom(bytes, 4000);
    CHECK_INFO(steps.others >= (bytes.size() - 4000) / kLongestMatch, steps.others);
}

// Without trials they are looked for everywhere.
TEST(matcher_looks_for_all_matches_without_trials) {
    std::uint32_t state = kSeed;
    const Buffer bytes = geometric(30'000, state);
    Matcher matcher(bytes);
    Match match;
    std::size_t others = 0;
    for (std::size_t at = 0; at < bytes.size(); at += match.length) {
        at = matcher.next(at, bytes.size(), match);
        matcher.skip(at, match.length);
        others += at > 2500 && match.distance > 1;
    }
    CHECK_INFO(others > 100, others);
}

// Pieces that change between both, at places of any kind.
TEST(deflate_round_trips_where_matches_pay_here_and_there) {
    std::uint32_t state = kSeed;
    for (int trial = 0; trial < 20; ++trial) {
        Buffer bytes;
        while (bytes.size() < 150'000) {
            const std::size_t size = 500 + nextRandom(state) % 40'000;
            switch (nextRandom(state) % 4) {
            case 0: add(bytes, noise(size, 7, state)); break;
            case 1: add(bytes, geometric(size, state)); break;
            case 2: add(bytes, Buffer(size, static_cast<std::uint8_t>(nextRandom(state)))); break;
            default: {
                const Buffer word = noise(20 + nextRandom(state) % 3000, 6, state);
                for (std::size_t i = 0; i < size; i += word.size()) add(bytes, word);
            }
            }
        }
        for (const std::size_t rowBytes : {std::size_t{1}, std::size_t{1921}, std::size_t{5000}}) {
            Buffer packed(kZlibHeader.begin(), kZlibHeader.end());
            add(packed, deflatePiece(bytes, true, rowBytes));
            const auto end = zlibEnd(adler32(bytes));
            packed.insert(packed.end(), end.begin(), end.end());
            CHECK_INFO(inflateZlib(packed, bytes.size(), "trial") == bytes,
                       "trial " << trial << ", rows of " << rowBytes << ", seed " << kSeed);
        }
    }
}
