// The formulas of Camera::rayFrom() for a perspective camera at rest, in its order.
#pragma once

#include "base/vec.h"
#include "camera/lens_lanes.h"
#include "sample/hash.h"
#include "sample/sobol.h"
#include "sample/warps.h"
#include "simd/lanes.h"
#include "simd/vectors3.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

LANES_BEGIN

// Where lines from the eye through places of the picture lead, in units of the depth.
inline Doubles3 linesThrough(const Camera::Lens& lens, const Doubles& x, const Doubles& y) {
    return forAll(lens.right) * (Doubles(lens.topLeft.x) + x * Doubles(lens.step.x)) +
           forAll(lens.up) * (Doubles(lens.topLeft.y) - y * Doubles(lens.step.y)) +
           forAll(lens.forward);
}

// A division by what is positive would change no zero.
inline Floats clipAlong(const Camera::Lens& lens, const Doubles3& dir) {
    if (lens.clipStart == 0) return Floats(0.0f);
    return (Doubles(lens.clipStart) / dot(dir, forAll(lens.forward))).toFloats();
}

// Where the rays of the lanes go to; there is room for all.
struct RayPointers {
    Vec3 *org, *dir;
    float* tMin;
};
inline void storeAll(Floats x, Floats y, Floats z, Vec3* to) {
    storeChosenVectors((1u << W) - 1, x, y, z, &to->x);
}
inline void storeAll(const Doubles3& v, Vec3* to) {
    storeAll(v.x.toFloats(), v.y.toFloats(), v.z.toFloats(), to);
}
inline void storeAll(Floats x, float* to) {
    alignas(64) float all[W];
    x.store(all);
    std::memcpy(to, all, sizeof all); // which need not be aligned
}

// make(first, to) for the lanes from each W-th on.
template <class MakeFn> inline void forEachLanes(const RaySpans& to, const MakeFn& make) {
    const bool hasOrg = !to.org.empty();
    const std::size_t count = to.dir.size();
    std::size_t first = 0;
    for (; first + W <= count; first += W)
        make(first,
             RayPointers{hasOrg ? &to.org[first] : nullptr, &to.dir[first], &to.tMin[first]});
    if (first == count) return;
    std::array<Vec3, W> org, dir;
    std::array<float, W> tMin;
    make(first, RayPointers{org.data(), dir.data(), tMin.data()});
    if (hasOrg) std::copy_n(org.data(), count - first, &to.org[first]);
    std::copy_n(dir.data(), count - first, &to.dir[first]);
    std::copy_n(tMin.data(), count - first, &to.tMin[first]);
}

inline void raysFrom(const Camera::Lens& lens, const PlaceBlock& places, std::size_t first,
                     const RayPointers& to) {
    const Doubles3 right = forAll(lens.right), up = forAll(lens.up), forward = forAll(lens.forward),
                   eye = forAll(lens.eye);
    const Doubles px = Doubles::load(places.x + first), py = Doubles::load(places.y + first);
    const Doubles3 line = linesThrough(lens, px, py);
    const Doubles3 sharp = eye + line * (Doubles(lens.focusDistance) / dot(line, forward));
    const Floats u = Floats::load(places.u + first), v = Floats::load(places.v + first);
    const Floats2 place = lens.blades != 0 ? polygonFromSquare(lens.corners, lens.blades, u, v)
                                           : diskFromSquare(u, v);
    const Doubles3 onLens =
        right * (Doubles(place.x) / Doubles(lens.apertureRatio)) + up * Doubles(place.y);
    const Doubles3 from = eye + onLens * Doubles(lens.apertureRadius);
    const Floats x = from.x.toFloats(), y = from.y.toFloats(), z = from.z.toFloats();
    const Doubles3 way = sharp - Doubles3{Doubles(x), Doubles(y), Doubles(z)};
    const Doubles3 unit = way / sqrt(dot(way, way));
    storeAll(x, y, z, to.org);
    storeAll(unit, to.dir);
    storeAll(clipAlong(lens, unit), to.tMin);
}

// Filter::sample(): how far from the middle, -1 .. 1, a number of 0 .. 1 is, and with its sign, the
// offset that so many radii are.
inline Doubles signedPlace(Floats u) { return Doubles(2.0) * Doubles(u) - Doubles(1.0); }
inline Doubles movedBy(const Filter::Spread& filter, const Doubles& radii, Floats u) {
    return Doubles(withSign(radii * Doubles(filter.radius), signedPlace(u)).toFloats());
}

// The numbers of a block as places in the filter's table: entry, and how far to the next.
class TablePlaces {
public:
    explicit TablePlaces(const float (&u)[PairBlock::kPairs]) {
        constexpr int kSteps = Filter::kSteps;
        for (std::size_t i = 0; i < PairBlock::kPairs; i += W) {
            const Doubles size = abs(signedPlace(Floats::load(u + i)));
            const Doubles at = sqrt(Doubles(1.0) - size) * Doubles(kSteps);
            const Doubles step = min(floor(at), Doubles(kSteps - 1));
            wholeOf(step).store(entry_ + i);
            (at - step).store(across_ + i);
        }
    }
    // Of W of them.
    Doubles lookUp(const float* table, std::size_t first) const {
        Floats here, next;
        loadPairs([&](std::size_t i) { return table + entry_[first + i]; }, here, next);
        const Doubles across = Doubles::load(across_ + first);
        return Doubles(here) * (Doubles(1.0) - across) + Doubles(next) * across;
    }

private:
    alignas(64) std::uint32_t entry_[PairBlock::kPairs];
    alignas(64) double across_[PairBlock::kPairs];
};

template <FilterKind kKind>
inline void moveBy(const Filter::Spread& filter, const float (&u)[PairBlock::kPairs], double* to) {
    const auto move = [&](std::size_t i, const Doubles& radii) {
        (Doubles::load(to + i) + movedBy(filter, radii, Floats::load(u + i))).store(to + i);
    };
    if constexpr (kKind == FilterKind::Box || kKind == FilterKind::Tent) {
        const Doubles one(1.0);
        for (std::size_t i = 0; i < PairBlock::kPairs; i += W) {
            const Doubles size = abs(signedPlace(Floats::load(u + i)));
            move(i, kKind == FilterKind::Box ? size : size / (one + sqrt(one - size)));
        }
    } else {
        const TablePlaces places(u); // first all, then what is there: the look-ups needn't wait
        for (std::size_t i = 0; i < PairBlock::kPairs; i += W)
            move(i, places.lookUp(filter.inverse, i));
    }
}
template <FilterKind kKind>
inline void spreadAs(const Filter::Spread& filter, const PairBlock& pairs, PlaceBlock& places) {
    moveBy<kKind>(filter, pairs.u, places.x), moveBy<kKind>(filter, pairs.v, places.y);
}

// As many whole numbers as the compiler's registers have room for, which sample/sobol.h takes.
using Bits __attribute__((vector_size(4 * kSobolLanes))) = std::uint32_t;
using SignedBits __attribute__((vector_size(4 * kSobolLanes))) = std::int32_t;
using UnitFloats __attribute__((vector_size(4 * kSobolLanes))) = float;

inline Bits loadBits(const std::uint32_t* from) {
    Bits all;
    std::memcpy(&all, from, sizeof all);
    return all;
}
// unitFloat(): 24 bits fit into a signed number, which lanes can convert.
inline void storeUnit(const Bits& all, float* to) {
    const Bits upper = all >> 8;
    SignedBits number;
    std::memcpy(&number, &upper, sizeof number);
    const UnitFloats unit = __builtin_convertvector(number, UnitFloats) * 0x1p-24f;
    std::memcpy(to, &unit, sizeof unit);
}

using Longs __attribute__((vector_size(sizeof(Bits)))) = std::uint64_t;
constexpr std::uint64_t kLow32 = 0xffffffffu;

// mixBits() and hash() of sample/hash.h for lanes.
inline Longs mixed(Longs x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}
inline Longs hashed(std::uint32_t seed, Longs pixel, std::uint32_t dimension) {
    const Longs both = mixed((pixel | std::uint64_t{seed} << 32) + kHashStep);
    return mixed(both + hashStepOf(dimension));
}

void pairSeeds(std::uint32_t seed, std::uint32_t dimension, std::span<const std::uint32_t> pixels,
               const PairSeedColumns& out) {
    for (std::size_t i = 0; i < pixels.size(); i += kSobolLanes) {
        const auto store = [&](const Longs& all, std::uint32_t* to) {
            std::memcpy(to + i, &all, sizeof(all));
        };
        Longs both;
        std::memcpy(&both, &pixels[i], sizeof(both));
        // Every other pixel is the lower half of a lane.
        const Longs even = hashed(seed, both & kLow32, dimension),
                    odd = hashed(seed, both >> 32, dimension);
        store((even & kLow32) | odd << 32, out.index);
        store(even >> 32 | (odd & ~kLow32), out.x);
        store((mixed(even + kHashStep) & kLow32) | mixed(odd + kHashStep) << 32, out.y);
    }
}

void sobolPairs(PairBlock& block, std::size_t count) {
    for (std::size_t i = 0; i < count; i += kSobolLanes) {
        const auto pair = sobolPair<Bits>(loadBits(block.sample + i), loadBits(block.index + i),
                                          loadBits(block.x + i), loadBits(block.y + i));
        storeUnit(pair.x, block.u + i), storeUnit(pair.y, block.v + i);
    }
}

void spreadPlaces(const Filter::Spread& filter, const PairBlock& pairs, PlaceBlock& places) {
    switch (filter.kind) {
    case FilterKind::Box: return spreadAs<FilterKind::Box>(filter, pairs, places);
    case FilterKind::Tent: return spreadAs<FilterKind::Tent>(filter, pairs, places);
    case FilterKind::Gaussian:
    case FilterKind::BlackmanHarris:
        return spreadAs<FilterKind::BlackmanHarris>(filter, pairs, places);
    }
}

void lensRays(const Camera::Lens& lens, const PlaceBlock& places, const RaySpans& to) {
    forEachLanes(
        to, [&](std::size_t first, const RayPointers& at) { raysFrom(lens, places, first, at); });
}

void pinholeRays(const Camera::Lens& lens, const PlaceBlock& places, const RaySpans& to) {
    forEachLanes(to, [&](std::size_t first, const RayPointers& at) {
        const Doubles3 line =
            linesThrough(lens, Doubles::load(places.x + first), Doubles::load(places.y + first));
        const Doubles3 unit = line / sqrt(dot(line, line));
        storeAll(unit, at.dir);
        storeAll(clipAlong(lens, unit), at.tMin);
    });
}

LANES_END
