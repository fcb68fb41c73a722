#include "image/zero_runs.h"

#include "image/byte_lanes.h"
#include "image/huffman.h"
#include "image/matcher.h"
#include "image/run_codes.h"

#include <algorithm>
#include <array>
#include <vector>

namespace {

using Bytes = std::span<const std::uint8_t>;

// Measured with filtered renders, charts and pages of text: with these limits files are a little
// smaller in all, as the lengths of runs are chosen for their codes.
constexpr std::size_t kLeastBytes = 4096, kMostBytes = std::size_t{1} << 24;
constexpr std::size_t kZerosPerByte = 8; // at least so many bytes to one that isn't zero
// The bits that matches have to spare, of all bytes and, where more may be due to chance, of a
// sample of one in so many.
constexpr std::size_t kPercentWorthMatches = 16, kPercentOfSample = 20, kSampleOf = 16;

// Where the bytes that aren't zero stand, in order; false where there are too many.
bool findPlaces(Bytes bytes, std::vector<std::uint32_t>& places) {
    return byteLanes().nonzeroPlaces(bytes, bytes.size() / kZerosPerByte, places);
}

// Would matches spare more of the block's bits? By the places in its middle: as the finder of
// matcher.h would find them, at what they and the places usually take.
bool areWorthMatches(Bytes bytes, std::span<const std::uint32_t> places, std::size_t percent) {
    constexpr std::size_t kMostPlaces = 2048;
    constexpr std::size_t kPlaceBits = 9, kMatchBits = 24;
    constexpr unsigned kHashBits = 12;
    const std::size_t count = std::min(kMostPlaces, places.size());
    places = places.subspan((places.size() - count) / 2, count);
    std::array<std::uint32_t, 1 << kHashBits> latest{}; // by hash: place + 1; 0 is none
    const auto eightAt = [&](std::size_t at) { return loadLittle<std::uint64_t>(&bytes[at]); };
    std::size_t spared = 0, i = 0;
    while (i < places.size() && places[i] + 8 <= bytes.size()) {
        const std::size_t at = places[i];
        const std::uint64_t here = eightAt(at);
        std::uint32_t& entry = latest[MatchFinder::hashOf(here, kHashBits)];
        const std::size_t distance = at + 1 - entry;
        const bool isMatch =
            entry != 0 && distance <= kWindow &&
            MatchFinder::isZero(here ^ eightAt(at - distance), MatchFinder::kShortMatch);
        entry = static_cast<std::uint32_t>(at + 1);
        std::size_t covered = 0;
        if (isMatch) {
            const std::size_t most = std::min(kLongestMatch, bytes.size() - at);
            const std::size_t end = at + commonLength(&bytes[at], &bytes[at - distance], most);
            while (i + covered < places.size() && places[i + covered] < end) ++covered;
        }
        const bool spares = covered * kPlaceBits > kMatchBits;
        if (spares) spared += covered * kPlaceBits - kMatchBits;
        i += spares ? covered : 1;
    }
    return 100 * spared > percent * kPlaceBits * i;
}

} // namespace

bool putZeroRuns(BitWriter& out, Bytes bytes, bool last) {
    if (bytes.size() < kLeastBytes || bytes.size() > kMostBytes) return false;
    thread_local std::vector<std::uint32_t> places; // the system need not clear it every time
    const auto areRuns = [&](std::size_t size, std::size_t percent) {
        const Bytes middle = bytes.subspan((bytes.size() - size) / 2, size);
        return findPlaces(middle, places) && !areWorthMatches(middle, places, percent);
    };
    // A look at the middle tells of most of the others that they aren't worth more.
    if (!areRuns(std::max(bytes.size() / kSampleOf, kLeastBytes), kPercentOfSample) ||
        !areRuns(bytes.size(), kPercentWorthMatches))
        return false;

    Gaps gaps;
    SymbolCounts single;
    std::size_t next = 0; // behind the byte before
    for (const std::uint32_t place : places) {
        gaps.add(place - next);
        ++single.literals[bytes[place]];
        next = place + 1;
    }
    gaps.add(bytes.size() - next);
    single.literals[kEndOfBlock] = 1;
    const auto counted = [&] {
        SymbolCounts counts = single;
        gaps.addTo(counts);
        return counts;
    };
    // Which runs are worth a match depends on the codes, and these on it.
    for (int round = 0; round < 2; ++round)
        gaps.choose(huffmanLengths(counted().literals, kMaxCodeLength));
    const RunCodes codes(gaps, counted());
    if (!codes.fit()) return false;
    codes.put(out, bytes, places, last);
    return true;
}
