// Pairs of Sobol numbers and places on a disk, a register of them at a time: the formulas of
// Sampler::get2D() and diskFromSquare().
#pragma once

#include "base/vec.h"
#include "sample/sobol.h"
#include "sample/warp.h"
#include "simd/lanes.h"
#include "simd/vectors3.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

LANES_BEGIN

// As many whole numbers as the compiler's registers have room for, which sample/sobol.h takes.
using Bits __attribute__((vector_size(4 * kSobolLanes))) = std::uint32_t;
using SignedBits __attribute__((vector_size(4 * kSobolLanes))) = std::int32_t;
using UnitFloats __attribute__((vector_size(4 * kSobolLanes))) = float;
// How many of them are of a row of W lanes: where W is 1 the others are idle.
constexpr std::size_t kSobolInRow = std::min<std::size_t>(kSobolLanes, W);

// These 16 bytes, again and again.
inline Bits bytes(std::uint64_t low, std::uint64_t high) {
    using Longs __attribute__((vector_size(4 * kSobolLanes))) = std::uint64_t;
    Longs all{};
    for (std::size_t i = 0; i < kSobolLanes / 2; i += 2) all[i] = low, all[i + 1] = high;
    return reinterpret_cast<Bits>(all);
}

// In each byte: its lower four bits, which are all it has, in the opposite order.
inline Bits reversedNibbles(Bits x) {
    return pickBytes(bytes(0x0e060a020c040800u, 0x0f070b030d050901u), x);
}
// What sample/sobol.h has for numbers, by looking up four bits at a time.
inline Bits reversed(Bits x) {
    const Bits order = bytes(0x0405060700010203u, 0x0c0d0e0f08090a0bu);
    const Bits low = x & 0x0f0f0f0fu, high = (x >> 4) & 0x0f0f0f0fu;
    return pickBytes((reversedNibbles(low) << 4) | reversedNibbles(high), order);
}

template <std::size_t kCount = kSobolLanes> Bits loadBits(const std::uint32_t* from) {
    Bits all{};
    std::memcpy(&all, from, 4 * kCount);
    return all;
}
// unitFloat(): 24 bits fit into a signed number, which lanes can convert.
template <std::size_t kCount = kSobolLanes> void storeUnit(const Bits& all, float* to) {
    const Bits upper = all >> 8;
    SignedBits number;
    std::memcpy(&number, &upper, sizeof(number));
    const UnitFloats unit = __builtin_convertvector(number, UnitFloats) * 0x1p-24f;
    std::memcpy(to, &unit, 4 * kCount);
}

// Four bytes in each lane: each the lowest one of `x`.
inline Bits inEachByte(Bits x) {
    return pickBytes(x, bytes(0x0404040400000000u, 0x0c0c0c0c08080808u));
}
using ShortBits __attribute__((vector_size(4 * kSobolLanes))) = std::uint16_t;
// Bytes by bytes whose products are bytes.
inline Bits bytesTimes(Bits a, Bits b) {
    return reinterpret_cast<Bits>(reinterpret_cast<ShortBits>(a) *
                                  reinterpret_cast<ShortBits>(b & 0x00ff00ffu));
}

// Sixteen numbers in each lane that differ in their uppermost four bits only: these are bytes, four
// to a register. On them no other bits of a sum or a product depend.
struct SixteenNumbers {
    static constexpr std::uint32_t kRest = 0x0fffffffu, kTops = 0x0f0f0f0fu;
    Bits rest, tops[4];

    // `all`: what became of the rest, whose carry the tops don't have yet.
    SixteenNumbers& carry(Bits all) {
        const Bits carried = inEachByte(all >> 28);
        for (Bits& top : tops) top = (top + carried) & kTops;
        rest = all & kRest;
        return *this;
    }
    SixteenNumbers& operator+=(Bits b) { return carry(rest + b); }
    SixteenNumbers& operator*=(Bits b) {
        const Bits factor = inEachByte(b & 15u);
        for (Bits& top : tops) top = bytesTimes(top, factor);
        return carry(rest * b);
    }
    SixteenNumbers operator*(std::uint32_t b) const {
        SixteenNumbers product = *this;
        return product *= Bits{} + b;
    }
    SixteenNumbers& operator^=(const SixteenNumbers& b) {
        for (std::size_t i = 0; i < 4; ++i) tops[i] ^= b.tops[i];
        rest ^= b.rest;
        return *this;
    }
};

// Seeds and first sample numbers of W streams of pairs.
struct PairsInLanes {
    const std::uint32_t *index, *x, *y, *sample;
};

// kSobolLanes of them, from `first` on.
class RunsOfPairs {
public:
    RunsOfPairs(const PairsInLanes& pairs, std::size_t first)
        : index_(loadBits<kSobolInRow>(pairs.index + first)),
          x_(loadBits<kSobolInRow>(pairs.x + first)), y_(loadBits<kSobolInRow>(pairs.y + first)),
          sample_(loadBits<kSobolInRow>(pairs.sample + first)) {}

    // The first so many samples: give(s, pair) for each.
    template <class Give> void each(std::uint32_t count, const Give& give) const {
        if (!areNear(count)) {
            for (std::uint32_t s = 0; s < count; ++s)
                give(s, sobolPair<Bits>(sample_ + s, index_, x_, y_));
            return;
        }
        // Reversed and shuffled, samples that differ in the lower four bits only do so again: no
        // others depend on these.
        SixteenNumbers shuffled{reversed(sample_ & ~kLower), {}};
        for (std::uint32_t i = 0; i < 4; ++i)
            shuffled.tops[i] =
                reversedNibbles(inEachByte(sample_ & kLower) + 0x03020100u + i * 0x04040404u);
        shuffled = scrambledReversed(shuffled, index_);
        const Bits x = reversed(shuffled.rest), y = pascalReversed(x);
        for (std::uint32_t s = 0; s < count;) {
            Bits lowX = reversedNibbles(shuffled.tops[s / 4]), lowY = pascalOfNibbles(lowX);
            for (const std::uint32_t end = std::min(s + 4, count); s < end;
                 ++s, lowX >>= 8, lowY >>= 8)
                give(s, Pair<Bits>{reversed(scrambledReversed(x | (lowX & kLower), x_)),
                                   reversed(scrambledReversed(y ^ (lowY & kLower), y_))});
        }
    }

private:
    static constexpr std::uint32_t kLower = 15;
    // Do the first so many samples differ from each other in the lower four bits only?
    bool areNear(std::uint32_t count) const {
        const Bits last = (sample_ & kLower) + (count - 1);
        std::uint32_t upper = 0;
        for (std::size_t i = 0; i < kSobolLanes; ++i) upper |= last[i] & ~kLower;
        return upper == 0;
    }
    // pascalReversed() of each byte, which are below sixteen.
    static Bits pascalOfNibbles(Bits x) {
        return pickBytes(bytes(0x0706040502030100u, 0x08090b0a0d0c0e0fu), x);
    }

    Bits index_, x_, y_, sample_;
};

struct DiskLanes {
    Floats x, y;
};

// cos(pi/4 q) and sin(pi/4 q) / q from q^2 in [0,1]: polynomials through their values at the
// Chebyshev nodes, off by less than 2^-43 of these.
inline Doubles polynomial(const Doubles& w, const double (&c)[6]) {
    Doubles sum(c[5]);
    for (std::size_t i = 5; i > 0; --i) sum = fma(sum, w, Doubles(c[i - 1]));
    return sum;
}
inline Doubles cosineOf(const Doubles& w) {
    constexpr double c[] = {0.9999999999999444,     -0.3084251375300398,    0.01585434419710652,
                            -0.0003259916875350726, 3.5904755349763954e-06, -2.426851890411488e-08};
    return polynomial(w, c);
}
inline Doubles sineOf(const Doubles& w) {
    constexpr double c[] = {0.785398163397445,       -0.08074551218803863, 0.0024903945673670634,
                            -3.6576192120767256e-05, 3.1333840829093e-07,  -1.7365167288597578e-09};
    return polynomial(w, c);
}

// What all numbers within 2^-40 of v round to; lanes where there is no such float are added to
// `unsure` (Ziv 1991).
inline Floats surelyRounded(const Doubles& v, unsigned& unsure) {
    unsure |= nearMiddle(v);
    return v.toFloats();
}

// Reckoned to 2^-41, which is enough for nearly all places; diskFromSquare() is right to 2^-50 and
// so rounds to the same. Lanes of others are added to `unsure`, and of the middle.
[[gnu::always_inline]] inline DiskLanes nearlyOnDisk(Floats u, Floats v, unsigned& unsure) {
    // Exact, as u and v are of 24 bits.
    const Floats two(2.0f), one(1.0f), x = two * u - one, y = two * v - one;
    const Mask isSide = abs(y) < abs(x);
    const Floats longer = select(isSide, x, y), shorter = select(isSide, y, x);
    unsure |= bits(longer == Floats(0.0f));
    const Doubles radius(longer), aside(shorter), q = nearQuotient(aside, radius), w = q * q;
    const Floats along = surelyRounded(radius * cosineOf(w), unsure),
                 across = surelyRounded(aside * sineOf(w), unsure);
    return {select(isSide, along, across), select(isSide, across, along)};
}

// Places in the unit square and on the disk, in rows of lanes.
struct SquareRow {
    alignas(64) float u[W], v[W], x[W], y[W];
};

// u and v of so many samples of each stream.
template <class Row>
inline void drawPairs(const PairsInLanes& pairs, Row* rows, std::uint32_t count) {
    for (std::size_t i = 0; i < W; i += kSobolLanes) {
        RunsOfPairs(pairs, i).each(count, [&](std::uint32_t s, const Pair<Bits>& pair) {
            storeUnit<kSobolInRow>(pair.x, rows[s].u + i);
            storeUnit<kSobolInRow>(pair.y, rows[s].v + i);
        });
    }
}

// x and y from u and v; lanes that take placeSurelyOnDisk() are added to `unsure`.
inline void placeOnDisk(SquareRow& row, unsigned& unsure) {
    const DiskLanes disk = nearlyOnDisk(Floats::load(row.u), Floats::load(row.v), unsure);
    disk.x.store(row.x), disk.y.store(row.y);
}
inline void placeSurelyOnDisk(SquareRow& row, unsigned lanes) {
    for (; lanes != 0; lanes &= lanes - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
        const Vec2 place = diskFromSquare({row.u[i], row.v[i]});
        row.x[i] = place.x, row.y[i] = place.y;
    }
}

LANES_END
