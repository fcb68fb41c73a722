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

// Of rows that are two vectors or more.
class RowFilter {
public:
    RowFilter(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
              std::size_t pixelBytes)
        : row_(row), above_(above), pixelBytes_(pixelBytes) {}

    std::array<std::uint64_t, kPngFilterCount> costs() const {
        std::array<std::uint64_t, kPngFilterCount> out{};
        constexpr std::size_t kPiece = 128 * kVector; // sums of at most 129 * 256
        const std::size_t whole = row_.size() / kVector * kVector;
        for (std::size_t start = 0; start < whole; start += kPiece) {
            AllSums sums{};
            const std::size_t end = std::min(whole, start + kPiece);
            std::size_t i = start;
            if (i == 0) addTo(sums, first(), ~Lanes{}), i += kVector;
            for (; i < end; i += kVector) addTo(sums, at(i), ~Lanes{});
            if (end == whole) addTo(sums, at(lastAt()), lastLanes(row_.size() - whole));
            for (std::size_t f = 0; f < kPngFilterCount; ++f)
                for (std::size_t lane = 0; lane < kVector / 2; ++lane) out[f] += sums[f][lane];
        }
        return out;
    }

    template <PngFilter filter> void write(std::span<std::uint8_t> out) const {
        const auto put = [&](std::size_t i, const Place& place) { // a size that is known: one store
            const Lanes lanes = place.here - predict<filter>(place.near);
            std::memcpy(out.data() + i, &lanes, kVector);
        };
        put(0, first());
        for (std::size_t i = kVector; i < lastAt(); i += kVector) put(i, at(i));
        put(lastAt(), at(lastAt()));
    }

private:
    struct Place {
        Lanes here;
        Neighbours near;
    };
    using AllSums = std::array<Sums, kPngFilterCount>;

    // i > 0.
    [[gnu::always_inline]] Place at(std::size_t i) const {
        const std::uint8_t* const here = row_.data() + i;
        const std::uint8_t* const up = above_.data() + i;
        return {load(here), {load(here - pixelBytes_), load(up), load(up - pixelBytes_)}};
    }
    // Has zeros at its left.
    Place first() const {
        const Lanes here = load(row_.data()), up = load(above_.data());
        return {here, {movedRight(here), up, movedRight(up)}};
    }
    Lanes movedRight(Lanes lanes) const {
        std::array<std::uint8_t, kVector + 8> bytes{}; // a pixel has at most 8
        std::memcpy(bytes.data() + pixelBytes_, &lanes, kVector);
        return load(bytes.data());
    }
    // Where the last vector starts, among the bytes of the one before if the row isn't whole
    // vectors.
    std::size_t lastAt() const { return row_.size() - kVector; }
    static Lanes lastLanes(std::size_t count) { // all bits of so many
        std::array<std::uint8_t, 2 * kVector> bytes{};
        std::fill_n(bytes.begin() + kVector, kVector, std::uint8_t{0xFF});
        return load(bytes.data() + count);
    }

    // What the filters leave of the bytes that are in the mask.
    [[gnu::always_inline]] static void addTo(AllSums& sums, const Place& place, Lanes mask) {
        add<PngFilter::None>(sums, place, mask);
        if (isPlain(place.here, place.near)) return; // the others leave nothing
        add<PngFilter::Sub>(sums, place, mask);
        add<PngFilter::Up>(sums, place, mask);
        add<PngFilter::Average>(sums, place, mask);
        add<PngFilter::Paeth>(sums, place, mask);
    }
    template <PngFilter filter>
    [[gnu::always_inline]] static void add(AllSums& sums, const Place& place, Lanes mask) {
        const Lanes filtered = (place.here - predict<filter>(place.near)) & mask;
        const Sums sizes = reinterpret_cast<Sums>(smaller(filtered, -filtered));
        sums[static_cast<std::size_t>(filter)] += (sizes & 0xFF) + (sizes >> 8);
    }

    std::span<const std::uint8_t> row_, above_;
    std::size_t pixelBytes_;
};

PngFilter bestOf(const RowFilter& row) {
    const auto costs = row.costs();
    return static_cast<PngFilter>(std::min_element(costs.begin(), costs.end()) - costs.begin());
}

PngFilter filterLongRow(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                        std::size_t pixelBytes, std::optional<PngFilter> given,
                        std::span<std::uint8_t> out) {
    const RowFilter by(row, above, pixelBytes);
    const PngFilter filter = given ? *given : bestOf(by);
    switch (filter) {
    case PngFilter::None: by.write<PngFilter::None>(out); break;
    case PngFilter::Sub: by.write<PngFilter::Sub>(out); break;
    case PngFilter::Up: by.write<PngFilter::Up>(out); break;
    case PngFilter::Average: by.write<PngFilter::Average>(out); break;
    case PngFilter::Paeth: by.write<PngFilter::Paeth>(out); break;
    }
    return filter;
}

// With zeros in front, which the filters take for the pixels left of it and leave zeros.
PngFilter filterShortRow(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                         std::size_t pixelBytes, std::optional<PngFilter> given,
                         std::span<std::uint8_t> out) {
    constexpr std::size_t kSize = 2 * kVector;
    std::array<std::uint8_t, kSize> longRow{}, longAbove{}, longOut;
    const auto start = static_cast<std::ptrdiff_t>(kSize - row.size());
    std::copy(row.begin(), row.end(), longRow.begin() + start);
    std::copy(above.begin(), above.end(), longAbove.begin() + start);
    const PngFilter filter = filterLongRow(longRow, longAbove, pixelBytes, given, longOut);
    std::copy(longOut.begin() + start, longOut.end(), out.begin());
    return filter;
}

} // namespace

PngFilter filterRow(std::span<const std::uint8_t> row, std::span<const std::uint8_t> above,
                    std::size_t pixelBytes, std::optional<PngFilter> given,
                    std::span<std::uint8_t> out) {
    // The same row again, as in a plain background: Up leaves nothing, None is as good for zeros.
    if (std::memcmp(row.data(), above.data(), row.size()) == 0) {
        std::fill_n(out.begin(), row.size(), std::uint8_t{0});
        const bool isZero = std::memcmp(row.data(), out.data(), row.size()) == 0;
        return isZero ? PngFilter::None : PngFilter::Up;
    }
    return row.size() < 2 * kVector ? filterShortRow(row, above, pixelBytes, given, out)
                                    : filterLongRow(row, above, pixelBytes, given, out);
}
