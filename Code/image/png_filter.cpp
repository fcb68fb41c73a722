#include "image/png_filter.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace {

// Vectors of the compiler: 16 bytes are one register on every machine.
constexpr std::size_t kVector = PngRow::kVector;
using Lanes __attribute__((vector_size(kVector))) = std::uint8_t;
using Sums __attribute__((vector_size(kVector))) = std::uint16_t;

Lanes load(const std::uint8_t* from) {
    Lanes lanes;
    std::memcpy(&lanes, from, sizeof lanes);
    return lanes;
}
Lanes smaller(Lanes a, Lanes b) { return a < b ? a : b; }
Lanes larger(Lanes a, Lanes b) { return a > b ? a : b; }
Lanes difference(Lanes a, Lanes b) { return larger(a, b) - smaller(a, b); }

// The neighbours of 16 bytes: see PngFilter.
struct Neighbours {
    Lanes a, b, c;
};

// (a + b) / 2 rounded down, without a ninth bit.
Lanes average(Lanes a, Lanes b) {
    const Sums halves = reinterpret_cast<Sums>((a ^ b) & 0xFE) >> 1;
    return (a & b) + reinterpret_cast<Lanes>(halves);
}

// paethPredictor() in bytes: where c is between a and b, its distance to a + b - c is the
// difference of the others; else it is their sum, and a or b is nearer or as near.
[[gnu::always_inline]] inline Lanes paeth(const Neighbours& n) {
    const Lanes toA = difference(n.b, n.c), toB = difference(n.a, n.c);
    const auto isBetween = (n.a < n.c) == (n.c < n.b);
    const Lanes toC = isBetween ? difference(toA, toB) : larger(toA, toB);
    const Lanes bOrC = toB <= toC ? n.b : n.c;
    return ((toA <= toB) & (toA <= toC)) ? n.a : bOrC;
}

template <PngFilter filter> Lanes predict(const Neighbours& n) {
    if constexpr (filter == PngFilter::None) return Lanes{};
    if constexpr (filter == PngFilter::Sub) return n.a;
    if constexpr (filter == PngFilter::Up) return n.b;
    if constexpr (filter == PngFilter::Average) return average(n.a, n.b);
    if constexpr (filter == PngFilter::Paeth) return paeth(n);
}

// One colour as far as the 16 bytes and their neighbours reach?
bool isPlain(Lanes here, const Neighbours& n) {
    const Lanes different = (here ^ n.a) | (here ^ n.b) | (here ^ n.c);
    std::array<std::uint64_t, 2> halves;
    std::memcpy(halves.data(), &different, sizeof different);
    return (halves[0] | halves[1]) == 0;
}

class RowFilter {
public:
    RowFilter(const PngRow& row, const PngRow& above, std::size_t pixelBytes)
        : row_(row), above_(above), pixelBytes_(pixelBytes) {}

    std::array<std::uint64_t, kPngFilterCount> costs() const {
        std::array<std::uint64_t, kPngFilterCount> out{};
        constexpr std::size_t kPiece = 128 * kVector; // sums of at most 128 * 256
        for (std::size_t start = 0; start < row_.size(); start += kPiece) {
            const std::size_t end = std::min(row_.size(), start + kPiece);
            std::array<Sums, kPngFilterCount> sums{};
            for (std::size_t i = start; i < end; i += kVector) {
                const Lanes here = load(row_.data() + i);
                const Neighbours n = neighbours(i);
                addTo<PngFilter::None>(sums, here, n);
                if (isPlain(here, n)) continue; // the others leave nothing
                addTo<PngFilter::Sub>(sums, here, n);
                addTo<PngFilter::Up>(sums, here, n);
                addTo<PngFilter::Average>(sums, here, n);
                addTo<PngFilter::Paeth>(sums, here, n);
            }
            for (std::size_t f = 0; f < kPngFilterCount; ++f)
                for (std::size_t lane = 0; lane < kVector / 2; ++lane) out[f] += sums[f][lane];
        }
        return out;
    }

    template <PngFilter filter> void write(std::span<std::uint8_t> out) const {
        const auto lanesAt = [&](std::size_t i) {
            return load(row_.data() + i) - predict<filter>(neighbours(i));
        };
        std::size_t i = 0;
        for (; i + kVector <= row_.size(); i += kVector) { // a size that is known: one store
            const Lanes lanes = lanesAt(i);
            std::memcpy(out.data() + i, &lanes, kVector);
        }
        if (i == row_.size()) return;
        const Lanes lanes = lanesAt(i);
        std::memcpy(out.data() + i, &lanes, row_.size() - i);
    }

private:
    Neighbours neighbours(std::size_t i) const {
        // In front of the row for its first pixel: see PngRow.
        const std::uint8_t* const left = row_.data() + i - pixelBytes_;
        const std::uint8_t* const up = above_.data() + i;
        return {load(left), load(up), load(up - pixelBytes_)};
    }
    template <PngFilter filter>
    static void addTo(std::array<Sums, kPngFilterCount>& sums, Lanes here, const Neighbours& n) {
        const Lanes filtered = here - predict<filter>(n);
        const Sums sizes = reinterpret_cast<Sums>(smaller(filtered, -filtered));
        sums[static_cast<std::size_t>(filter)] += (sizes & 0xFF) + (sizes >> 8);
    }

    const PngRow& row_;
    const PngRow& above_;
    std::size_t pixelBytes_;
};

} // namespace

PngFilter filterRow(const PngRow& row, const PngRow& above, std::size_t pixelBytes,
                    std::span<std::uint8_t> out) {
    // The same row again, as in a plain background: Up leaves nothing, None is as good for zeros.
    if (std::memcmp(row.data(), above.data(), row.size()) == 0) {
        std::fill_n(out.begin(), row.size(), std::uint8_t{0});
        const bool isZero = std::memcmp(row.data(), out.data(), row.size()) == 0;
        return isZero ? PngFilter::None : PngFilter::Up;
    }
    const RowFilter filter(row, above, pixelBytes);
    const auto costs = filter.costs();
    const auto best =
        static_cast<PngFilter>(std::min_element(costs.begin(), costs.end()) - costs.begin());
    switch (best) {
    case PngFilter::None: filter.write<PngFilter::None>(out); break;
    case PngFilter::Sub: filter.write<PngFilter::Sub>(out); break;
    case PngFilter::Up: filter.write<PngFilter::Up>(out); break;
    case PngFilter::Average: filter.write<PngFilter::Average>(out); break;
    case PngFilter::Paeth: filter.write<PngFilter::Paeth>(out); break;
    }
    return best;
}
