#include "sample/sampler.h"
#include "base/math.h"
#include "sample/dimensions.h"
#include "sample/hash.h"
#include "sample/sobol.h"
#include "sample/zsobol.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace {

using namespace kernels::one;

// The index-th of `count` in a random order; a bijection on [0, count) for every key. Steps that
// are invertible modulo the next power of two, repeated until the result is in range (Kensler,
// "Correlated Multi-Jittered Sampling", Pixar 13-01; his own steps reach few of the 24 orders of
// four, which would correlate dimensions).
std::uint32_t permuted(std::uint32_t index, std::uint32_t count, std::uint64_t key) {
    const std::uint64_t more = mixBits(key + kHashStep);
    const std::uint32_t rounds[] = {low32(key), high32(key), low32(more), high32(more)};
    const auto bits = static_cast<int>(std::bit_width(count - 1));
    const int shift = (bits + 1) / 2;
    const std::uint32_t mask = static_cast<std::uint32_t>((std::uint64_t{1} << bits) - 1);
    do {
        for (const std::uint32_t random : rounds) {
            index = (index * (random | 1) + (random >> 16)) & mask;
            index ^= index >> shift;
        }
    } while (index >= count);
    return index;
}

// (cell + offset) / count, kept below 1 when it rounds up.
float inCell(std::uint32_t cell, float offset, std::uint32_t count) {
    const double place =
        (static_cast<double>(cell) + static_cast<double>(offset)) / static_cast<double>(count);
    const float value = static_cast<float>(place);
    return min(value, kOneMinusUlp);
}

// The largest divisor of n up to its root: n = rows * columns, as square as it goes.
std::uint32_t squareDivisor(std::uint32_t n) {
    std::uint32_t best = 1;
    for (std::uint64_t d = 2; d * d <= n; ++d)
        if (n % d == 0) best = static_cast<std::uint32_t>(d);
    return best;
}

} // namespace

Sampler::Sampler(SamplerKind kind, int sampleCount, std::uint32_t seed, bool jitter)
    : kind_(kind), jitter_(jitter), seed_(seed),
      count_(sampleCount > 0 ? static_cast<std::uint32_t>(sampleCount) : 1),
      rows_(squareDivisor(count_)) {
    columns_ = count_ / rows_;
}

Sampler Sampler::stream(std::uint32_t id, int repeats) const {
    constexpr std::uint32_t kStreamSalt = 0x73747265u; // keeps streams apart from pixels
    const auto all = static_cast<std::int64_t>(count_) * std::max(repeats, 1);
    const auto count = static_cast<int>(min<std::int64_t>(all, std::numeric_limits<int>::max()));
    Sampler out(kind_, count, low32(hash(seed_, id, kStreamSalt)), jitter_);
    out.isStream_ = true;
    return out;
}

Sampler::PairSeeds Sampler::pairSeeds(std::uint32_t pixel, std::uint32_t dimension) const {
    if (kind_ == SamplerKind::ZSobol) {
        const ZOrder order = zOrder(dimension);
        return {firstSample(pixel, order), order.x, order.y};
    }
    const std::uint64_t bits = hash(seed_, pixel, dimension);
    return {low32(bits), high32(bits), low32(mixBits(bits + kHashStep))};
}

ZOrder Sampler::zOrder(std::uint32_t dimension) const {
    const std::uint64_t bits = hash(seed_, dimension);
    return {low32(bits), high32(bits), low32(mixBits(bits + kHashStep)), sampleBits()};
}

float Sampler::get1D(std::uint32_t pixel, std::uint32_t sample, std::uint32_t dimension) const {
    const std::uint64_t bits = hash(seed_, pixel, alone(dimension));
    switch (kind_) {
    case SamplerKind::Sobol: {
        const std::uint32_t a = low32(bits), b = high32(bits);
        // Shuffling the index is Owen scrambling of the index; the first dimension of Sobol is the
        // reversed index, so the two reversals between them cancel.
        const std::uint32_t shuffled = reversed(scrambledReversed(reversed(sample), a));
        return unitFloat(reversed(scrambledReversed(shuffled, b)));
    }
    case SamplerKind::ZSobol: return get2D(pixel, sample, alone(dimension)).x;
    case SamplerKind::Random: return unitFloat(low32(mixBits(bits + sample * kHashStep)));
    case SamplerKind::Stratified:
    case SamplerKind::Grid: break;
    }
    const std::uint32_t pass = sample / count_, index = sample % count_;
    const std::uint32_t offset = low32(mixBits(bits + sample * kHashStep));
    return inCell(permuted(index, count_, mixBits(bits + pass)), unitFloat(offset), count_);
}

Vec2 Sampler::get2D(std::uint32_t pixel, std::uint32_t sample, std::uint32_t dimension) const {
    const bool isPixel = dimension == kPixelDimension && !isStream_;
    if (isPixel && !jitter_ && count_ == 1) return {0.5f, 0.5f};
    if (!isInLanes()) {
        const std::uint64_t bits = hash(seed_, pixel, dimension);
        return otherPair(bits, mixBits(bits + kHashStep), sample, isPixel);
    }
    const auto [a, b, c] = pairSeeds(pixel, dimension);
    const auto [x, y] = kind_ == SamplerKind::ZSobol ? zSobolPair(sample, a, b, c, sampleBits())
                                                     : sobolPair(sample, a, b, c);
    return {unitFloat(x), unitFloat(y)};
}

// Draws pairs of the kinds that are not in lanes.
Vec2 Sampler::otherPair(std::uint64_t bits, std::uint64_t more, std::uint32_t sample,
                        bool isPixel) const {
    if (kind_ == SamplerKind::Random) {
        const std::uint64_t both = mixBits(bits + sample * kHashStep);
        return {unitFloat(low32(both)), unitFloat(high32(both))};
    }
    const std::uint32_t pass = sample / count_, index = sample % count_;
    const bool inOrder = isPixel && kind_ == SamplerKind::Grid;
    const std::uint32_t cell = inOrder ? index : permuted(index, count_, mixBits(bits + pass));
    Vec2 offset{0.5f, 0.5f};
    if (jitter_ || !isPixel) {
        const std::uint64_t both = mixBits(more + sample * kHashStep);
        offset = {unitFloat(low32(both)), unitFloat(high32(both))};
    }
    return {inCell(cell % columns_, offset.x, columns_), inCell(cell / columns_, offset.y, rows_)};
}
