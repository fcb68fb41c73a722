// Pairs of Sobol numbers and places on a disk, a register of them at a time: the formulas of
// Sampler::get2D() and diskFromSquare(). Included by sobol_*.inl of each instruction set.

namespace {

// As many whole numbers as the compiler's registers have room for, which sobol.inl takes.
using Bits __attribute__((vector_size(4 * kSobolLanes))) = std::uint32_t;
using SignedBits __attribute__((vector_size(4 * kSobolLanes))) = std::int32_t;
using UnitFloats __attribute__((vector_size(4 * kSobolLanes))) = float;

// These 16 bytes, again and again.
inline Bits bytes(std::uint64_t low, std::uint64_t high) {
    using Longs __attribute__((vector_size(4 * kSobolLanes))) = std::uint64_t;
    Longs all{};
    for (std::size_t i = 0; i < kSobolLanes / 2; i += 2) all[i] = low, all[i + 1] = high;
    return reinterpret_cast<Bits>(all);
}

// What sobol.inl has for numbers, by looking up four bits at a time.
inline Bits reversed(Bits x) {
    const Bits four = bytes(0x0e060a020c040800u, 0x0f070b030d050901u);
    const Bits order = bytes(0x0405060700010203u, 0x0c0d0e0f08090a0bu);
    const Bits low = x & 0x0f0f0f0fu, high = (x >> 4) & 0x0f0f0f0fu;
    return pickBytes((pickBytes(four, low) << 4) | pickBytes(four, high), order);
}

#include "sample/sobol.inl"

inline Bits loadBits(const std::uint32_t* from) {
    Bits all;
    std::memcpy(&all, from, sizeof(all));
    return all;
}
// unitFloat(): 24 bits fit into a signed number, which lanes can convert.
inline void storeUnit(const Bits& all, float* to) {
    const Bits upper = all >> 8;
    SignedBits number;
    std::memcpy(&number, &upper, sizeof(number));
    const UnitFloats unit = __builtin_convertvector(number, UnitFloats) * 0x1p-24f;
    std::memcpy(to, &unit, sizeof(unit));
}

// Seeds and first sample number of W streams of pairs.
struct PairsInLanes {
    alignas(64) std::uint32_t index[W], x[W], y[W], sample[W];

    // Those of the samples that are `later` than the first ones.
    void make(std::uint32_t later, float (&u)[W], float (&v)[W]) const {
        for (std::size_t i = 0; i < W; i += kSobolLanes) {
            const auto pair = sobolPair<Bits>(loadBits(sample + i) + later, loadBits(index + i),
                                              loadBits(x + i), loadBits(y + i));
            storeUnit(pair.x, u + i), storeUnit(pair.y, v + i);
        }
    }
};

struct DiskLanes {
    Floats x, y;
};

// sinKernel() and cosKernel() of base/math.cpp for an angle of no lower part, each the upper part
// of its result.
inline Doubles sineOf(const Doubles& x) {
    constexpr double c3 = -1.0 / 6, c5 = 1.0 / 120, c7 = -1.0 / 5040, c9 = 1.0 / 362880;
    constexpr double c11 = -1.0 / 39916800, c13 = 1.0 / 6227020800, c15 = -1.0 / 1307674368000;
    constexpr double c17 = 1.0 / 355687428096000;
    const Doubles z = x * x, z2 = z * z, z4 = z2 * z2;
    const Doubles low = (Doubles(c5) + z * Doubles(c7)) + z2 * (Doubles(c9) + z * Doubles(c11));
    const Doubles high = (Doubles(c13) + z * Doubles(c15)) + z2 * Doubles(c17);
    return x + (x * z) * (Doubles(c3) + z * (low + z4 * high));
}
inline Doubles cosineOf(const Doubles& x) {
    constexpr double c4 = 1.0 / 24, c6 = -1.0 / 720, c8 = 1.0 / 40320, c10 = -1.0 / 3628800;
    constexpr double c12 = 1.0 / 479001600, c14 = -1.0 / 87178291200, c16 = 1.0 / 20922789888000;
    const Doubles z = x * x, z2 = z * z, z4 = z2 * z2, one(1.0);
    const Doubles low = (Doubles(c4) + z * Doubles(c6)) + z2 * (Doubles(c8) + z * Doubles(c10));
    const Doubles high = (Doubles(c12) + z * Doubles(c14)) + z2 * Doubles(c16);
    const Doubles half = Doubles(0.5) * z, main = one - half;
    return main + (((one - main) - half) + z2 * (low + z4 * high));
}

// Without the places that exact::sinCos() has other ways for, those of the angle 0 and from pi/4
// on: their lanes are added to `seams`.
[[gnu::always_inline]] inline DiskLanes betweenSeams(Floats u, Floats v, unsigned& seams) {
    // Exact, as u and v are of 24 bits.
    const Floats two(2.0f), one(1.0f), x = two * u - one, y = two * v - one;
    const Mask isSide = abs(y) < abs(x);
    const Floats longer = select(isSide, x, y), shorter = select(isSide, y, x);
    const Doubles radius(longer), angle = Doubles(kPi / 4) * (Doubles(shorter) / radius);
    const Floats along = (radius * cosineOf(angle)).toFloats(),
                 across = (radius * sineOf(angle)).toFloats();
    seams |= bits((shorter == Floats(0.0f)) | (abs(x) == abs(y)));
    return {select(isSide, along, across), select(isSide, across, along)};
}

// Places in the unit square and on the disk, in rows of lanes.
struct DiskRow {
    alignas(64) float u[W], v[W], x[W], y[W];
};

// x and y from u and v. Row by row, and nothing is called: the processor works at several.
inline void placeOnDisk(DiskRow* rows, std::size_t count) {
    unsigned seams = 0;
    for (DiskRow* row = rows; row != rows + count; ++row) {
        const DiskLanes disk = betweenSeams(Floats::load(row->u), Floats::load(row->v), seams);
        disk.x.store(row->x), disk.y.store(row->y);
    }
    for (; seams != 0; seams &= seams - 1)
        for (DiskRow* row = rows; row != rows + count; ++row) {
            const auto i = static_cast<std::size_t>(std::countr_zero(seams));
            const Vec2 place = diskFromSquare({row->u[i], row->v[i]});
            row->x[i] = place.x, row->y[i] = place.y;
        }
}

} // namespace
