// How the one lane of plain numbers moves: see avx512_moves.h, but for keys, which only trees sort.
#pragma once

#include "simd/one.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

LANES_BEGIN

// W times four bytes, of which number i lies at at(i).
template <class Fn> inline Ints loadWords(const Fn& at) {
    std::uint32_t word;
    std::memcpy(&word, at(std::size_t{0}), sizeof word);
    return word;
}
// W pairs, of which number i lies at at(i).
template <class Fn> inline void loadPairs(const Fn& at, Floats& first, Floats& second) {
    const float* const pair = at(std::size_t{0});
    first = pair[0], second = pair[1];
}
// W pairs (a, b) that follow each other.
inline void storePairs(Floats a, Ints b, float* to) {
    to[0] = a.v;
    std::memcpy(to + 1, &b.v, sizeof b.v);
}
// W rows (a, b, c, d, e) that follow each other.
inline void storeRows(Floats a, Floats b, Floats c, Ints d, Ints e, float* to) {
    to[0] = a.v, to[1] = b.v, to[2] = c.v;
    std::memcpy(to + 3, &d.v, sizeof d.v);
    std::memcpy(to + 4, &e.v, sizeof e.v);
}

// --- chosen lanes ---

// Writes the chosen lanes one after the other. Registers may overwrite what follows them, too.
inline void storeChosen(unsigned chosen, Ints from, std::uint32_t* to) {
    if ((chosen & 1) != 0) *to = from.v;
}
inline void storeChosen(unsigned chosen, const std::uint32_t* from, std::uint32_t* to) {
    storeChosen(chosen, Ints::load(from), to);
}
inline void storeChosen(Mask chosen, const std::uint32_t* from, std::uint32_t* to) {
    storeChosen(bits(chosen), from, to);
}
inline void storeChosenFloats(unsigned chosen, Floats a, float* to) {
    if ((chosen & 1) != 0) *to = a.v;
}
inline void storeChosenVectors(unsigned chosen, Floats x, Floats y, Floats z, float* to) {
    if ((chosen & 1) != 0) to[0] = x.v, to[1] = y.v, to[2] = z.v;
}
// The lowest bits, in order, to where bits of `places` are.
inline unsigned spread(unsigned lowest, unsigned places) {
    unsigned out = 0;
    for (; places != 0; places &= places - 1, lowest >>= 1)
        out |= (lowest & 1) << std::countr_zero(places);
    return out;
}

// --- columns of rows ---

inline constexpr bool kPairsPay = false; // there are no lanes to put one behind the other

// Four numbers that follow each other at row[i], in lane i of four registers.
inline void loadRows(const float* const (&row)[W], Floats (&column)[4]) {
    for (int i = 0; i < 4; ++i) column[i] = row[0][i];
}
// The same of doubles, in memory.
inline void storeRows(const double* const (&row)[W], double (*column)[W]) {
    for (int i = 0; i < 4; ++i) column[i][0] = row[0][i];
}

// Bits of W rows of W, asked for by columns.
class LaneColumns {
public:
    void set(int row, Mask columns) { column_ |= bits(columns) << row; }
    void store(std::uint32_t* to) const { *to = column_; }

private:
    std::uint32_t column_ = 0;
};

// --- look-ups in tables ---

inline Doubles floor(Doubles a) { return std::floor(a.v); }
// Cut towards zero; the smallest number for what is none of 32 bits.
inline Ints wholeOf(Doubles a) {
    const bool fits = a.v > -0x1p31 && a.v < 0x1p31;
    return static_cast<std::uint32_t>(fits ? static_cast<std::int32_t>(a.v)
                                           : std::numeric_limits<std::int32_t>::min());
}
inline Doubles doublesOf(Ints a) { return static_cast<std::int32_t>(a.v); }
// Byte i, 0 to 3, of each.
inline Ints byteOf(Ints a, int i) { return a.v >> 8 * i & 255; }
// The four bytes at each offset.
inline Ints fourBytesAt(const std::uint8_t* from, Ints offset) {
    return loadWords([&](std::size_t) { return from + offset.v; });
}
// Element i of a table for each i, which are below 2^31; 0 in lanes that are not chosen, whatever
// their i.
inline Ints elementsAt(const std::uint32_t* table, Ints i, unsigned chosen) {
    return (chosen & 1) != 0 ? table[i.v] : 0;
}
// The first two elements of row i, for each i, of a table whose rows are kStride long.
template <int kStride>
inline void pairsAt(const double* rows, Ints i, Doubles& first, Doubles& second) {
    const double* const row = rows + std::size_t{kStride} * i.v;
    first = row[0], second = row[1];
}

// --- bits of powers ---

inline Ints bitsOf(Floats a) { return std::bit_cast<std::uint32_t>(a.v); }
inline Floats fromBits(Ints a) { return std::bit_cast<float>(a.v); }
inline Ints plus(Ints a, std::uint32_t b) { return a.v + b; }
inline Ints masked(Ints a, std::uint32_t b) { return a.v & b; }
// Copies of the sign come in from above.
template <int kBits> Ints shiftedRight(Ints a) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(a.v) >> kBits);
}
// 2^k, for k from -1022 to 1023.
inline Doubles powersOfTwo(Ints k) {
    return std::bit_cast<double>(std::uint64_t{plus(k, 1023).v} << 52);
}

// --- bits of Sobol numbers ---

inline constexpr std::size_t kSobolLanes = 4; // whole 16 bytes, which every machine's registers have

// --- lanes of two in turn ---

// The lanes of a and b in turn: those of the lower and of the upper halves.
inline Floats lowInTurn(Floats a, Floats) { return a; }
inline Floats highInTurn(Floats, Floats b) { return b; }

LANES_END
