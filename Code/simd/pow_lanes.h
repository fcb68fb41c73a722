// exact::pow(float, float) of W numbers with exponents of their own: its steps in
// base/math_powers.cpp, lane by lane and in their order.
#pragma once

#include "simd/vectors3.h"
#include "base/math.h"
#include "base/function_tables.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

LANES_BEGIN

// (log(1+r) - r + r^2/2) / r^3
inline Doubles logTail(const Doubles& r) {
    const Doubles r2 = r * r;
    const Doubles low = (1.0 / 3 - r * (1.0 / 4)) + r2 * (1.0 / 5 - r * (1.0 / 6));
    const Doubles high = (1.0 / 7 - r * (1.0 / 8)) + r2 * (1.0 / 9 - r * (1.0 / 10));
    return low + (r2 * r2) * high;
}

inline constexpr int kLogRow = sizeof(exact::LogRow) / sizeof(double);

// logParts(): log(x) = exponent * log(2) + the table's row + log(1 + r). For floats from the
// smallest normal one on.
struct LogParts {
    Ints row;
    Doubles exponent, r, log; // log: the upper part of the row's
};
[[gnu::always_inline]] inline LogParts logParts(Floats x) {
    constexpr std::uint32_t minusBias = 0xffffff81; // -127
    const Ints fraction = masked(bitsOf(x), 0x7fffff);
    const Ints row = shiftedRight<16>(plus(fraction, 0x8000));
    const Doubles mantissa(fromBits(plus(fraction, 0x3f800000)));
    const Doubles exponent = doublesOf(plus(shiftedRight<23>(bitsOf(x)), minusBias)) +
                             select(row < Ints(exact::kHalvedFrom), Doubles(0.0), Doubles(1.0));
    Doubles c(0.0), log(0.0);
    pairsAt<kLogRow>(&exact::kLogTable.front().c, row, c, log);
    return {row, exponent, mantissa * c - 1.0, log};
}

// Of numbers from the smallest normal one to 1.
inline Doubles logOf(Floats base) {
    constexpr double ln2 = 0x1.62e42fefa39efp-1;
    const auto [row, exponent, r, log] = logParts(base);
    const Doubles known = exponent * ln2 + log;
    return known + (r + (r * r) * (-0.5 + r * logTail(r)));
}

// e^(x + lo), x from kLeastPower to kMostPower.
inline Doubles expOf(const Doubles& x, const Doubles& lo) {
    constexpr double rounder = 0x1.8p52, perUnit = 32 / 0x1.62e42fefa39efp-1;
    constexpr double step1 = 0x1.62e42feep-6, step2 = 0x1.a39ef35793c76p-38;
    const Doubles n = (x * perUnit + rounder) - rounder;
    const Doubles r = ((x - n * step1) - n * step2) + lo, r2 = r * r;
    const Doubles low = 0.5 + r * (1.0 / 6), high = 1.0 / 24 + r * (1.0 / 120);
    const Doubles tail = r2 * (low + r2 * (high + r2 * (1.0 / 720 + r * (1.0 / 5040))));
    const Ints whole = wholeOf(n), j = masked(whole, 31);
    Doubles hi(0.0), rest(0.0);
    pairsAt<2>(&exact::kExp2Table.front().hi, j, hi, rest);
    return (hi + (rest + hi * (r + tail))) * powersOfTwo(shiftedRight<5>(whole));
}

// e^(exponent log(base)); exponent finite.
[[gnu::always_inline]] inline Floats powByLog(Floats base, Floats exponent) {
    const Doubles power = Doubles(exponent) * logOf(base);
    const unsigned vanishes = less(power, Doubles(exact::kLeastPower));
    const Doubles in =
        select(maskOf(vanishes), Doubles(0.0), min(power, Doubles(exact::kMostPower)));
    return select(maskOf(vanishes), Floats(0.0f), expOf(in, Doubles(0.0)).toFloats());
}

// Of numbers up to 1; the exponents are whole and not negative.
[[gnu::always_inline]] inline Floats powBySquares(Floats base, Ints exponent) {
    const Doubles least(exact::kLeastSquare);
    constexpr unsigned kAll = (1u << W) - 1;
    Doubles square(base), result(1.0);
    for (;; square = max(square * square, least)) {
        const unsigned odd = bits(masked(exponent, 1) == Ints(1));
        if (odd != 0) result = select(maskOf(odd), max(result * square, least), result);
        exponent = shiftedRight<1>(exponent);
        if (bits(exponent == Ints(0)) == kAll) break;
    }
    const unsigned vanishes = less(result, Doubles(exact::kNoFloat));
    return select(maskOf(vanishes), Doubles(0.0), result).toFloats();
}

// Of the lanes whose bit is set; the others are anything. Apart from its callers, which would be
// too large to be inlined themselves.
[[gnu::noinline]] inline Floats powOf(Floats base, Floats exponent, unsigned lanes) {
    const Floats smallest(std::numeric_limits<float>::min()), one(1.0f), zero(0.0f);
    const unsigned plain =
        lanes & bits((base >= smallest) & (base <= one) &
                     (abs(exponent) < Floats(std::numeric_limits<float>::infinity())));
    const Floats x = select(maskOf(plain), base, one), y = select(maskOf(plain), exponent, zero);
    // Whole numbers stand in the last bits of their sums with 2^23.
    const Floats toWhole(0x1p23f), sum = y + toWhole;
    const unsigned squared =
        plain & bits((sum - toWhole == y) & (y >= one) & (y <= Floats(exact::kMostSquared)));
    Floats result = squared != plain ? powByLog(x, y) : one;
    if (squared != 0) {
        const Ints whole = masked(bitsOf(select(maskOf(squared), sum, toWhole)), 0x7fffff);
        result = select(maskOf(squared), powBySquares(x, whole), result);
    }
    if (plain == lanes) return result;
    alignas(64) float bases[W], exponents[W], powers[W];
    base.store(bases), exponent.store(exponents), result.store(powers);
    for (unsigned rest = lanes & ~plain; rest != 0; rest &= rest - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(rest));
        powers[i] = exact::pow(bases[i], exponents[i]);
    }
    return Floats::load(powers);
}

LANES_END
