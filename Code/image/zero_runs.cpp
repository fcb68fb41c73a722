#include "image/zero_runs.h"

#include "image/dynamic_codes.h"
#include "image/matcher.h"

#include <bit>

namespace {

using Bytes = std::span<const std::uint8_t>;

// Measured with filtered renders, charts and pages of text: with these limits files are a little
// smaller in all, as the lengths of runs are chosen for their codes.
constexpr std::size_t kLeastBytes = 4096, kMostBytes = std::size_t{1} << 24;
constexpr std::size_t kZerosPerByte = 8; // at least so many bytes to one that isn't zero
// The bits that matches have to spare, of all bytes and, where more may be due to chance, of a
// sample of one in so many.
constexpr std::size_t kPercentWorthMatches = 16, kPercentOfSample = 20, kSampleOf = 16;

// Which of 64 bytes aren't zero, the first one lowest, and how many.
struct Nonzero {
    std::uint64_t mask = 0;
    std::size_t count = 0;
};
Nonzero nonzeroOf64(const std::uint8_t* from) {
    constexpr std::uint64_t kLow = 0x7F7F7F7F7F7F7F7F;
    Nonzero found;
    for (unsigned i = 0; i < 8; ++i) {
        const auto eight = loadLittle<std::uint64_t>(from + 8 * i);
        const std::uint64_t ones = ((((eight & kLow) + kLow) | eight) & ~kLow) >> 7;
        // The products gather the eight bits, and their sum, in the highest byte.
        found.mask |= ones * 0x0102040810204080 >> 56 << 8 * i;
        found.count += ones * 0x0101010101010101 >> 56;
    }
    return found;
}
bool isZero64(const std::uint8_t* from) {
    std::uint64_t any = 0;
    for (unsigned i = 0; i < 8; ++i) any |= loadLittle<std::uint64_t>(from + 8 * i);
    return any == 0;
}

// Where the bytes that aren't zero stand, in order; false where there are too many.
bool findPlaces(Bytes bytes, std::vector<std::uint32_t>& places) {
    constexpr std::size_t kGroup = 4;
    const std::size_t most = bytes.size() / kZerosPerByte;
    places.resize(most + 64 + kGroup);
    std::size_t count = 0, at = 0;
    for (; at + 64 <= bytes.size() && count <= most; at += 64) {
        if (isZero64(&bytes[at])) continue;
        auto [mask, inThese] = nonzeroOf64(&bytes[at]);
        const std::size_t end = count + inThese;
        // In groups, whose number the processor guesses more often than that of the places; what
        // is too much is overwritten.
        for (; count < end; count += kGroup)
            for (std::size_t k = 0; k < kGroup; ++k, mask &= mask - 1)
                places[count + k] = static_cast<std::uint32_t>(
                    at + static_cast<std::size_t>(std::countr_zero(mask)));
        count = end;
    }
    for (; at < bytes.size() && count <= most; ++at)
        if (bytes[at] != 0) places[count++] = static_cast<std::uint32_t>(at);
    places.resize(count);
    return count <= most;
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

// A gap of zeros: a zero, and behind it zeros or matches with the byte before. Gaps up to the
// longest match have codes of their own; longer ones are such a gap and longest matches.
constexpr std::size_t kGaps = kLongestMatch + 1;
constexpr std::size_t lengthSymbol(std::size_t length) {
    return kEndOfBlock + 1 + kLengthSlot[length];
}
// What is left of a long one.
constexpr std::size_t firstOf(std::size_t zeros) { return (zeros - 1) % kLongestMatch + 1; }

struct Gaps {
    std::array<std::uint32_t, kGaps> counts{}; // by zeros
    std::uint32_t longestMatches = 0;
    // Which of them have a match; at first a guess.
    std::array<bool, kGaps> haveMatch = [] {
        std::array<bool, kGaps> have{};
        std::fill(have.begin() + 10, have.end(), true);
        return have;
    }();

    void add(std::size_t zeros) {
        const std::size_t first = zeros < kGaps ? zeros : firstOf(zeros);
        longestMatches += static_cast<std::uint32_t>((zeros - first) / kLongestMatch);
        ++counts[first];
    }
    void addTo(SymbolCounts& symbols) const {
        symbols.literals[lengthSymbol(kLongestMatch)] += longestMatches;
        symbols.distances[0] += longestMatches;
        for (std::size_t zeros = 1; zeros < kGaps; ++zeros) {
            const std::uint32_t count = counts[zeros];
            symbols.literals[0] +=
                haveMatch[zeros] ? count : count * static_cast<std::uint32_t>(zeros);
            if (!haveMatch[zeros]) continue;
            symbols.literals[lengthSymbol(zeros - 1)] += count;
            symbols.distances[0] += count;
        }
    }
    // What is shorter with these codes.
    void choose(const DynamicCodes& codes) {
        constexpr unsigned kUnknown = 12; // of symbols that nothing used
        const unsigned zero = codes.literalLengths()[0];
        for (std::size_t zeros = 1 + kShortestMatch; zeros < kGaps; ++zeros) {
            const unsigned known = codes.literalLengths()[lengthSymbol(zeros - 1)];
            const unsigned match = (known != 0 ? known : kUnknown) +
                                   kLengthRanges[kLengthSlot[zeros - 1]].extra +
                                   codes.distanceLengths()[0];
            haveMatch[zeros] = match < (zeros - 1) * zero;
        }
    }
};

class RunCodes {
public:
    RunCodes(const Gaps& gaps, const DynamicCodes& codes)
        : literals_(canonicalCodes(codes.literalLengths())),
          before_(canonicalCodes(codes.distanceLengths())[0]) {
        for (std::size_t zeros = 1; zeros < kGaps; ++zeros) {
            Code& code = gaps_[zeros];
            const auto add = [&](std::uint64_t bits, unsigned length) {
                if (code.length + length > kMostBits) {
                    fit_ &= gaps.counts[zeros] == 0;
                    return;
                }
                code.bits |= bits << code.length;
                code.length += length;
            };
            const auto addCode = [&](HuffmanCode part) { add(part.bits, part.length); };
            const std::size_t literals = gaps.haveMatch[zeros] ? 1 : zeros;
            for (std::size_t i = 0; i < literals; ++i) addCode(literals_[0]);
            if (!gaps.haveMatch[zeros]) continue;
            const CodeRange range = kLengthRanges[kLengthSlot[zeros - 1]];
            addCode(literals_[lengthSymbol(zeros - 1)]);
            add(zeros - 1 - range.base, range.extra);
            addCode(before_);
        }
    }
    // Fails where zeros alone are so rare that some gap takes more bits than are put at once.
    bool fit() const { return fit_; }

    void put(BitWriter& out, Bytes bytes, std::span<const std::uint32_t> places) const {
        BitWriter writer = std::move(out); // in registers: nothing written can be part of it
        std::size_t next = 0;
        for (const std::uint32_t place : places) {
            putGap(writer, place - next);
            writer.put(literals_[bytes[place]]);
            writer.flush();
            next = place + 1;
        }
        putGap(writer, bytes.size() - next);
        writer.put(literals_[kEndOfBlock]);
        writer.flush();
        out = std::move(writer);
    }

private:
    // With a byte behind it, a gap fits between two flushes; one with a match always does.
    static constexpr unsigned kMostBits = 56 - kMaxCodeLength;
    static_assert(kMaxCodeLength + kMaxCodeLength + 5 + 1 <= kMostBits);
    struct Code {
        std::uint64_t bits = 0;
        unsigned length = 0;
    };

    void putGap(BitWriter& out, std::size_t zeros) const {
        const std::size_t first = zeros < kGaps ? zeros : firstOf(zeros);
        out.put(gaps_[first].bits, gaps_[first].length);
        for (std::size_t left = zeros - first; left > 0; left -= kLongestMatch) {
            out.flush();
            out.put(literals_[lengthSymbol(kLongestMatch)]);
            out.put(before_);
        }
    }

    std::vector<HuffmanCode> literals_;
    HuffmanCode before_; // the distance of the byte before
    std::array<Code, kGaps> gaps_;
    bool fit_ = true;
};

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
    for (int round = 0; round < 2; ++round) gaps.choose(DynamicCodes(counted()));
    const SymbolCounts counts = counted();
    const DynamicCodes codes(counts);
    const std::uint64_t bits = bitsOf(counts, codes.literalLengths(), codes.distanceLengths());

    const RunCodes runs(gaps, codes);
    if (!runs.fit()) return false;
    out.reserveBits(codes.headerBits() + bits + 64);
    codes.putHeader(out, last);
    runs.put(out, bytes, places);
    return true;
}
