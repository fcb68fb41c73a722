// The vocabulary of simd/, an operation each, in the lanes of this unit (simd/region.h): what
// becomes of a number must not depend on how many lanes there are. Moves between lanes are brought
// back to the lane that a number came from.
#pragma once

#include "simd/lanes.h"
#include "unit/simd_given.h"
#include "unit/simd_op.h"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

LANES_BEGIN

inline constexpr Op kSimdOps[] = {
    op("a + b", [](const Given& g) { return g.a + g.b; }),
    op("a - b", [](const Given& g) { return g.a - g.b; }),
    op("a * b", [](const Given& g) { return g.a * g.b; }),
    op("a / b", [](const Given& g) { return g.a / g.b; }),
    op("x + y", [](const Given& g) { return g.x + g.y; }),
    op("x - y", [](const Given& g) { return g.x - g.y; }),
    op("x * y", [](const Given& g) { return g.x * g.y; }),
    op("x / y", [](const Given& g) { return g.x / g.y; }),
    op("sqrt(a)", [](const Given& g) { return sqrt(g.a); }),
    op("sqrt(x)", [](const Given& g) { return sqrt(g.x); }),
    exactOp("abs(a)", [](const Given& g) { return abs(g.a); }),
    exactOp("abs(x)", [](const Given& g) { return abs(g.x); }),
    exactOp("min(a, b)", [](const Given& g) { return min(g.a, g.b); }),
    exactOp("max(a, b)", [](const Given& g) { return max(g.a, g.b); }),
    exactOp("min(x, y)", [](const Given& g) { return min(g.x, g.y); }),
    exactOp("max(x, y)", [](const Given& g) { return max(g.x, g.y); }),
    op("maxAbs(a, b)", [](const Given& g) { return maxAbs(orOne(g.a), orOne(g.b)); }),
    op(
        "fma(a, b, c)", [](const Given& g) { return fma(g.a, g.b, g.c); },
        [](const Numbers& n, std::size_t k) {
            return bitsOfFloat(std::fma(n.a[k], n.b[k], n.c[k]));
        }),
    op(
        "fnma(a, b, c)", [](const Given& g) { return fnma(g.a, g.b, g.c); },
        [](const Numbers& n, std::size_t k) {
            return bitsOfFloat(std::fma(-n.a[k], n.b[k], n.c[k]));
        }),
    op(
        "fms(a, b, c)", [](const Given& g) { return fms(g.a, g.b, g.c); },
        [](const Numbers& n, std::size_t k) {
            return bitsOfFloat(std::fma(n.a[k], n.b[k], -n.c[k]));
        }),
    exactOp("flipSign(a, b)", [](const Given& g) { return flipSign(g.a, g.b); }),
    exactOp("withSign(a, b)", [](const Given& g) { return withSign(g.a, g.b); }),
    exactOp("withSign(x, y)", [](const Given& g) { return withSign(g.x, g.y); }),
    op("floor(a)", [](const Given& g) { return floor(g.a); }),
    op("floor(x)", [](const Given& g) { return floor(g.x); }),
    exactOp("nextFloat(a)", [](const Given& g) { return nextFloat(g.a); }),
    op("roughInverse(a)",
       [](const Given& g) {
           const Floats near = fromOneToTwo(g.a);
           return abs(roughInverse(near) * near - Floats(1.0f)) <= Floats(0x1.81p-12f);
       }),

    op("a < b", [](const Given& g) { return g.a < g.b; }),
    op("a <= b", [](const Given& g) { return g.a <= g.b; }),
    op("a > b", [](const Given& g) { return g.a > g.b; }),
    op("a >= b", [](const Given& g) { return g.a >= g.b; }),
    op("a == b", [](const Given& g) { return g.a == g.b; }),
    op("notGreater(a, b)", [](const Given& g) { return notGreater(g.a, g.b); }),
    op("x < y", [](const Given& g) { return g.x < g.y; }),
    op("less(x, y)", [](const Given& g) { return less(g.x, g.y); }),
    op("atMost(x, y)", [](const Given& g) { return atMost(g.x, g.y); }),
    op("i < j", [](const Given& g) { return g.i < g.j; }),
    op("i == j", [](const Given& g) { return g.i == g.j; }),
    op("i & j", [](const Given& g) { return g.i & g.j; }),
    op("i + j", [](const Given& g) { return g.i + g.j; }),
    op("Mask & Mask", [](const Given& g) { return g.m & (g.i < g.j); }),
    op("Mask | Mask", [](const Given& g) { return g.m | (g.i < g.j); }),
    op("maskOf(chosen)", [](const Given& g) { return g.m; }),
    exactOp("select(m, a, b)", [](const Given& g) { return select(g.m, g.a, g.b); }),
    exactOp("select(m, x, y)", [](const Given& g) { return select(g.m, g.x, g.y); }),
    op("select(m, i, j)", [](const Given& g) { return select(g.m, g.i, g.j); }),
    exactOp("select(a < b, a, b)", [](const Given& g) { return select(g.a < g.b, g.a, g.b); }),
    exactOp("minWhere(m, a, b)", [](const Given& g) { return minWhere(g.m, g.a, g.b); }),

    op("Floats all the same", [](const Given&) { return Floats(0.1f); }),
    op("Doubles all the same", [](const Given&) { return Doubles(0.1); }),
    op("Ints all the same", [](const Given&) { return Ints(0xfedcba98u); }),
    exactOp("Floats::unaligned",
            [](const Given& g) { return Floats::unaligned(kTables.floats + g.first + 1); }),
    op("Ints::unaligned",
       [](const Given& g) { return Ints::unaligned(kTables.words + g.first + 1); }),
    op("Ints::from",
       [](const Given& g) { return Ints::from(static_cast<std::uint32_t>(g.first)); }),
    op("Ints::bytes",
       [](const Given& g) {
           alignas(16) std::uint8_t bytes[16];
           for (std::size_t k = 0; k < W; ++k)
               bytes[k] = static_cast<std::uint8_t>(g.in.i[g.first + k]);
           return Ints::bytes(bytes);
       }),
    op("Doubles(a)", [](const Given& g) { return Doubles(g.a); }),
    op("x.toFloats()", [](const Given& g) { return g.x.toFloats(); }),
    op("wholeOf(x)", [](const Given& g) { return wholeOf(g.x); }),
    op("doublesOf(i)", [](const Given& g) { return doublesOf(g.i); }),
    op("byteOf(i, 0)", [](const Given& g) { return byteOf(g.i, 0); }),
    op("byteOf(i, 3)", [](const Given& g) { return byteOf(g.i, 3); }),
    op("bitsOf(a)", [](const Given& g) { return bitsOf(g.a); }),
    exactOp("fromBits(i)", [](const Given& g) { return fromBits(g.i); }),
    op("plus", [](const Given& g) { return plus(g.i, 0xffffff81u); }),
    op("masked", [](const Given& g) { return masked(g.i, 0x807fff01u); }),
    op("shiftedRight<1>", [](const Given& g) { return shiftedRight<1>(g.i); }),
    op("shiftedRight<23>", [](const Given& g) { return shiftedRight<23>(g.i); }),
    op("powersOfTwo, small",
       [](const Given& g) { return powersOfTwo(plus(masked(g.i, 1023), 0u - 1022)); }),
    op("powersOfTwo, large", [](const Given& g) { return powersOfTwo(masked(g.i, 1023)); }),

    op("elementsAt",
       [](const Given& g) {
           const Ints at = select(g.m, masked(g.i, 255), g.j); // of the others anything
           return elementsAt(kTables.words, at, g.chosen);
       }),
    op("fourBytesAt", [](const Given& g) { return fourBytesAt(kTables.bytes, masked(g.i, 255)); }),
    op("pairsAt, first",
       [](const Given& g) {
           Doubles first(0.0), second(0.0);
           pairsAt<4>(kTables.doubles, masked(g.i, 63), first, second);
           return first;
       }),
    op("pairsAt, second",
       [](const Given& g) {
           Doubles first(0.0), second(0.0);
           pairsAt<2>(kTables.doubles, masked(g.i, 127), first, second);
           return second;
       }),
    op("loadWords",
       [](const Given& g) {
           return loadWords(
               [&](std::size_t k) { return kTables.bytes + (g.in.i[g.first + k] & 255); });
       }),
    op("loadPairs",
       [](const Given& g) {
           Floats first, second;
           loadPairs([&](std::size_t k) { return kTables.floats + (g.in.i[g.first + k] & 255); },
                     first, second);
           const Made one(first), two(second);
           return Made([&](std::size_t k) { return one.of[k] << 32 | two.of[k]; });
       }),
    op("loadVectors",
       [](const Given& g) {
           Floats x, y, z;
           loadVectors(kTables.floats + 3 * g.first, x, y, z);
           const Made all[] = {x, y, z};
           return Made([&](std::size_t k) {
               return all[0].of[k] << 32 ^ all[1].of[k] << 16 ^ all[2].of[k];
           });
       }),
    op("loadRows",
       [](const Given& g) {
           const float* rows[W];
           for (std::size_t k = 0; k < W; ++k)
               rows[k] = kTables.floats + (g.in.i[g.first + k] & 255);
           Floats columns[4];
           loadRows(rows, columns);
           const Made all[] = {columns[0], columns[1], columns[2], columns[3]};
           return Made([&](std::size_t k) {
               std::uint32_t words[4];
               for (std::size_t c = 0; c < 4; ++c)
                   words[c] = static_cast<std::uint32_t>(all[c].of[k]);
               return mixedWords(words, 4);
           });
       }),
    op("storeRows of doubles",
       [](const Given& g) {
           const double* rows[W];
           for (std::size_t k = 0; k < W; ++k)
               rows[k] = kTables.doubles + (g.in.i[g.first + k] & 255);
           alignas(64) double columns[4][W];
           storeRows(rows, columns);
           return Made([&](std::size_t k) {
               const double row[] = {columns[0][k], columns[1][k], columns[2][k], columns[3][k]};
               return mixedWords(row, 8);
           });
       }),
    op("storePairs",
       [](const Given& g) {
           float to[2 * W];
           storePairs(g.a, g.i, to);
           return Made([&](std::size_t k) { return both(to[2 * k], to[2 * k + 1]); });
       }),
    op("storeRows",
       [](const Given& g) {
           float to[5 * W];
           storeRows(g.a, g.b, g.c, g.i, g.j, to);
           return Made([&](std::size_t k) { return mixedWords(to + 5 * k, 5); });
       }),
    op("storeChosen",
       [](const Given& g) {
           std::uint32_t to[2 * W], also[2 * W];
           storeChosen(g.chosen, g.i, to), storeChosen(g.m, g.in.i + g.first, also);
           return unpacked(g.chosen, [&](std::size_t k) { return both(to[k], also[k]); });
       }),
    op("storeChosenFloats",
       [](const Given& g) {
           float to[2 * W];
           storeChosenFloats(g.chosen, g.a, to);
           return unpacked(g.chosen, [&](std::size_t k) { return bitsOfFloat(to[k]); });
       }),
    op("storeChosenVectors",
       [](const Given& g) {
           float to[6 * W];
           storeChosenVectors(g.chosen, g.a, g.b, g.c, to);
           return unpacked(g.chosen, [&](std::size_t k) { return mixedWords(to + 3 * k, 3); });
       }),
    op("spread",
       [](const Given& g) {
           return Made([&](std::size_t k) -> std::uint64_t {
               return spread(g.in.i[g.first + k], g.in.j[g.first + k]);
           });
       }),
    op("permute",
       [](const Given& g) {
           alignas(64) std::uint32_t lanes[W];
           for (std::uint32_t k = 0; k < W; ++k) lanes[k] = k ^ (W - 1);
           const Made a(permute(g.a, Ints::load(lanes))), i(permute(g.i, Ints::load(lanes)));
           return Made([&](std::size_t k) { return a.of[k ^ (W - 1)] << 32 | i.of[k ^ (W - 1)]; });
       }),
    op("lowInTurn, highInTurn",
       [](const Given& g) {
           alignas(64) float to[2 * W];
           lowInTurn(g.a, g.b).store(to);
           const Made high(highInTurn(g.a, g.b));
           for (std::size_t k = 0; k < W; ++k)
               to[W + k] = std::bit_cast<float>(static_cast<std::uint32_t>(high.of[k]));
           return Made([&](std::size_t k) { return both(to[2 * k], to[2 * k + 1]); });
       }),
    op("smallest(a)",
       [](const Given& g) {
           const Floats a = orOne(g.a), least(smallest(a));
           return bits(least <= a) & allIf(bits(least == a) != 0);
       }),
    op("largest(a)",
       [](const Given& g) {
           const Floats a = orOne(g.a), most(largest(a));
           return bits(most >= a) & allIf(bits(most == a) != 0);
       }),
    op("smallestOfRows, largestOfRows",
       [](const Given& g) {
           alignas(64) float low[W][W], high[W][W];
           alignas(64) float a[W];
           orOne(g.a).store(a);
           for (std::size_t row = 0; row < W; ++row)
               for (std::size_t k = 0; k < W; ++k) {
                   const bool isIt = k == row * 3 % W;
                   low[row][k] = isIt ? a[row] : std::numeric_limits<float>::infinity();
                   high[row][k] = isIt ? a[row] : -std::numeric_limits<float>::infinity();
               }
           const Made least(smallestOfRows(low)), most(largestOfRows(high));
           return Made([&](std::size_t k) { return least.of[k] << 32 | most.of[k]; });
       }),
    op("LaneColumns",
       [](const Given& g) {
           LaneColumns columns;
           for (int row = 0; row < W; ++row) columns.set(row, maskOf(g.chosen & 1u << row));
           alignas(64) std::uint32_t of[W];
           columns.store(of);
           return Made([&](std::size_t k) -> std::uint64_t {
               return std::rotr(of[k], static_cast<int>(k));
           });
       }),
};

LANES_END
