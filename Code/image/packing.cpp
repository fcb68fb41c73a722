#include "image/packing.h"

#include "image/byte_lanes.h"
#include "image/huffman.h"
#include "image/matcher.h"
#include "image/run_codes.h"
#include "image/zero_runs.h"

#include <algorithm>
#include <array>
#include <bit>

namespace {

using Bytes = std::span<const std::uint8_t>;

// Measured with filtered renders of one sample and more: where time and size of all meet.
constexpr std::size_t kLeastBytes = 4096; // of less, a sample tells little and spares no time
constexpr std::size_t kSpots = 4, kSampleOf = 32, kLeastSpot = 1024, kMostSpot = 2048;
static_assert(kLeastBytes >= kSpots * kLeastSpot);
constexpr std::size_t kPercentSpared = 18; // by matches that pay

// Some bytes and where those stand that aren't zero, from the front of all.
struct Spot {
    std::size_t begin, end;
    RawVector<std::uint32_t> places;
};

// Far from each other: pictures have skies and floors.
std::array<Spot, kSpots> spotsOf(Bytes bytes) {
    const std::size_t part = bytes.size() / kSpots;
    const std::size_t size = std::clamp(part / kSampleOf, kLeastSpot, kMostSpot);
    std::array<Spot, kSpots> spots;
    for (std::size_t k = 0; k < kSpots; ++k) {
        Spot& spot = spots[k];
        spot.begin = k * part + (part - size) / 2;
        spot.end = spot.begin + size;
        byteLanes().nonzeroPlaces(bytes.subspan(spot.begin, size), size, spot.places);
        for (std::uint32_t& place : spot.places) place += static_cast<std::uint32_t>(spot.begin);
    }
    return spots;
}
std::size_t placesOf(std::span<const Spot> spots) {
    std::size_t count = 0;
    for (const Spot& spot : spots) count += spot.places.size();
    return count;
}

// What their bytes take with the runs of zeros between them.
std::uint64_t bitsWithRuns(Bytes bytes, std::span<const Spot> spots) {
    RunCounts counts;
    for (const Spot& spot : spots) counts.add(bytes, spot.begin, spot.places, spot.end);
    counts.choose();
    const SymbolCounts symbols = counts.symbols();
    std::array<std::uint8_t, kDistanceCodes> distances{};
    distances[0] = 1;
    return bitsOf(symbols, huffmanLengths(symbols.literals, kMaxCodeLength), distances);
}

// What matches would spare of that, a place taking so many bits with the zeros before it, times
// kBit: as the finder of matcher.h would find them from these places on.
class Spared {
public:
    static constexpr std::size_t kBit = 64;

    Spared(Bytes bytes, std::size_t bitsOfPlace) : bytes_(bytes), bitsOfPlace_(bitsOfPlace) {}

    void add(std::span<const std::uint32_t> places) {
        std::size_t i = 0;
        while (i < places.size() && places[i] + 8 <= bytes_.size()) {
            const Match match = matchAt(places[i]);
            std::size_t covered = 0;
            while (i + covered < places.size() && places[i + covered] < places[i] + match.length)
                ++covered;
            const std::size_t before = covered * bitsOfPlace_, after = bitsOf(match);
            const bool spares = before > after;
            if (spares) bits_ += before - after;
            i += spares ? covered : 1;
        }
    }
    std::size_t bits() const { return bits_; }

private:
    static constexpr unsigned kHashBits = 12;

    // Of its two codes and what follows them, about.
    static std::size_t bitsOf(const Match& match) {
        return kBit * (8 + static_cast<std::size_t>(std::bit_width(match.distance)));
    }
    Match matchAt(std::size_t at) {
        const auto eightAt = [&](std::size_t i) { return loadLittle<std::uint64_t>(&bytes_[i]); };
        const std::uint64_t here = eightAt(at);
        std::uint32_t& entry = latest_[MatchFinder::hashOf(here, kHashBits)];
        const std::size_t distance = at + 1 - entry;
        const bool isMatch =
            entry != 0 && distance <= kWindow &&
            MatchFinder::isZero(here ^ eightAt(at - distance), MatchFinder::kShortMatch);
        entry = static_cast<std::uint32_t>(at + 1);
        if (!isMatch) return {};
        const std::size_t most = std::min(kLongestMatch, bytes_.size() - at);
        return {commonLength(&bytes_[at], &bytes_[at - distance], most), distance};
    }

    Bytes bytes_;
    std::size_t bitsOfPlace_, bits_ = 0;
    std::array<std::uint32_t, 1 << kHashBits> latest_{}; // by hash: place + 1; 0 is none
};

} // namespace

Packing choosePacking(Bytes bytes) {
    if (bytes.size() < kLeastBytes) return Packing::Matches;
    const std::array<Spot, kSpots> spots = spotsOf(bytes);
    const std::size_t places = placesOf(spots);
    if (places == 0) return Packing::ZeroRuns;
    const std::uint64_t bits = Spared::kBit * bitsWithRuns(bytes, spots);
    Spared spared(bytes, bits / places);
    for (const Spot& spot : spots) spared.add(spot.places);
    if (100 * spared.bits() >= kPercentSpared * bits) return Packing::Matches;
    const std::size_t size = kSpots * (spots[0].end - spots[0].begin);
    return places * kBytesPerNonzero <= size ? Packing::ZeroRuns : Packing::Runs;
}
