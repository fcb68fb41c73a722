// Filters a row of a PNG picture so that it packs well. Knows bytes only, no colours and no files.
// byte_lanes.h says what; the file that includes this says how many bytes are a vector: kVector.

namespace {

// Vectors of the compiler.
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

// The neighbours of a vector's bytes: see PngFilter.
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

// One colour as far as the bytes and their neighbours reach?
bool isPlain(Lanes here, const Neighbours& n) {
    const Lanes different = (here ^ n.a) | (here ^ n.b) | (here ^ n.c);
    std::array<std::uint64_t, kVector / 8> parts;
    std::memcpy(parts.data(), &different, sizeof different);
    std::uint64_t any = 0;
    for (const std::uint64_t part : parts) any |= part;
    return any == 0;
}

class RowFilter {
public:
    RowFilter(const PngRow& row, const PngRow& above, std::size_t pixelBytes)
        : row_(row), above_(above), pixelBytes_(pixelBytes) {}

    std::array<std::uint64_t, kPngFilterCount> costs() const {
        std::array<std::uint64_t, kPngFilterCount> out{};
        constexpr std::size_t kPiece = 128 * kVector; // sums of at most 128 * 256
        const std::size_t whole = row_.size() / kVector * kVector;
        for (std::size_t start = 0; start < row_.size(); start += kPiece) {
            AllSums sums{};
            const std::size_t end = std::min(whole, start + kPiece);
            for (std::size_t i = start; i < end; i += kVector) addVector(sums, i, ~Lanes{});
            if (end == whole && end < start + kPiece && whole < row_.size())
                addVector(sums, whole, firstLanes(row_.size() - whole));
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
    using AllSums = std::array<Sums, kPngFilterCount>;
    // All bits of so many.
    static Lanes firstLanes(std::size_t count) {
        std::array<std::uint8_t, kVector> bytes{};
        std::fill_n(bytes.begin(), count, std::uint8_t{0xFF});
        return load(bytes.data());
    }
    // What the filters leave of the bytes from i on that are in the mask.
    [[gnu::always_inline]] void addVector(AllSums& sums, std::size_t i, Lanes mask) const {
        const Lanes here = load(row_.data() + i);
        const Neighbours n = neighbours(i);
        addTo<PngFilter::None>(sums, here, n, mask);
        if (isPlain(here, n)) return; // the others leave nothing
        addTo<PngFilter::Sub>(sums, here, n, mask);
        addTo<PngFilter::Up>(sums, here, n, mask);
        addTo<PngFilter::Average>(sums, here, n, mask);
        addTo<PngFilter::Paeth>(sums, here, n, mask);
    }
    template <PngFilter filter>
    [[gnu::always_inline]] static void addTo(AllSums& sums, Lanes here, const Neighbours& n,
                                             Lanes mask) {
        const Lanes filtered = (here - predict<filter>(n)) & mask;
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
