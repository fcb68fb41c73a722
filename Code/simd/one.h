// One lane, of plain numbers, for every machine: its siblings sse.h, avx2.h and avx512.h define the
// same names, and give in each lane the bits that this gives (tests/unit/test_simd_lanes.cpp).
#pragma once

#include "simd/region.h"

#include <bit>
#include <cmath>
#include <cstdint>

LANES_BEGIN

inline constexpr int W = 1;

struct Mask {
    bool v;
};
struct Floats {
    float v;
    Floats() = default;
    Floats(float a) : v(a) {}
    static Floats load(const void* p) { return *static_cast<const float*>(p); }
    static Floats unaligned(const float* p) { return *p; }
    void store(float* p) const { *p = v; }
};
struct Ints {
    std::uint32_t v;
    Ints(std::uint32_t a) : v(a) {}
    static Ints load(const std::uint32_t* p) { return *p; }
    static Ints unaligned(const std::uint32_t* p) { return *p; }
    static Ints from(std::uint32_t first) { return first; }
    static Ints bytes(const std::uint8_t* p) { return *p; }
    void store(std::uint32_t* p) const { *p = v; }
};
struct Doubles {
    double v;
    Doubles(double a) : v(a) {}
    explicit Doubles(Floats a) : v(a.v) {}
    static Doubles load(const double* p) { return *p; }
    void store(double* p) const { *p = v; }
    Floats toFloats() const { return static_cast<float>(v); }
};

inline Floats operator+(Floats a, Floats b) { return a.v + b.v; }
inline Floats operator-(Floats a, Floats b) { return a.v - b.v; }
inline Floats operator*(Floats a, Floats b) { return a.v * b.v; }
inline Floats operator/(Floats a, Floats b) { return a.v / b.v; }
inline Doubles operator+(Doubles a, Doubles b) { return a.v + b.v; }
inline Doubles operator-(Doubles a, Doubles b) { return a.v - b.v; }
inline Doubles operator*(Doubles a, Doubles b) { return a.v * b.v; }
inline Doubles operator/(Doubles a, Doubles b) { return a.v / b.v; }
inline Floats sqrt(Floats a) { return std::sqrt(a.v); }
inline Doubles sqrt(Doubles a) { return std::sqrt(a.v); }
inline Floats abs(Floats a) { return std::fabs(a.v); }
inline Doubles abs(Doubles a) { return std::fabs(a.v); }
// The second operand wins when one is NaN, and of zeros, as in base/math.h.
inline Floats min(Floats a, Floats b) { return a.v < b.v ? a : b; }
inline Floats max(Floats a, Floats b) { return a.v > b.v ? a : b; }
inline Doubles min(Doubles a, Doubles b) { return a.v < b.v ? a : b; }
inline Doubles max(Doubles a, Doubles b) { return a.v > b.v ? a : b; }
inline Floats maxAbs(Floats a, Floats b) { return max(abs(a), abs(b)); }
// Two roundings, as SSE has them: fma() is used only where the pads cover either way.
inline Floats fma(Floats a, Floats b, Floats c) { return a * b + c; }
inline Floats fnma(Floats a, Floats b, Floats c) { return c - a * b; } // c - a b
inline Floats fms(Floats a, Floats b, Floats c) { return a * b - c; }  // a b - c
inline Floats flipSign(Floats a, Floats by) {
    const std::uint32_t sign = std::bit_cast<std::uint32_t>(by.v) & 0x80000000u;
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(a.v) ^ sign);
}
inline Floats withSign(Floats a, Floats of) { return std::copysign(a.v, of.v); }
inline Doubles withSign(Doubles a, Doubles of) { return std::copysign(a.v, of.v); }
inline Floats floor(Floats a) { return std::floor(a.v); }
// The next float; of those that are not negative.
inline Floats nextFloat(Floats a) {
    return std::bit_cast<float>(std::bit_cast<std::uint32_t>(a.v) + 1);
}
inline Floats roughInverse(Floats a) { return 1.0f / a.v; } // registers are off by 1.5 * 2^-12

inline Mask operator<(Floats a, Floats b) { return {a.v < b.v}; }
inline Mask operator<=(Floats a, Floats b) { return {a.v <= b.v}; }
inline Mask operator>(Floats a, Floats b) { return {a.v > b.v}; }
inline Mask operator>=(Floats a, Floats b) { return {a.v >= b.v}; }
inline Mask operator==(Floats a, Floats b) { return {a.v == b.v}; }
// True for NaN.
inline Mask notGreater(Floats a, Floats b) { return {!(a.v > b.v)}; }
inline Ints operator&(Ints a, Ints b) { return a.v & b.v; }
inline Ints operator+(Ints a, Ints b) { return a.v + b.v; }
inline Mask operator<(Ints a, Ints b) { return {a.v < b.v}; }
inline Mask operator==(Ints a, Ints b) { return {a.v == b.v}; }
inline Mask operator&(Mask a, Mask b) { return {a.v && b.v}; }
inline Mask operator|(Mask a, Mask b) { return {a.v || b.v}; }
inline unsigned bits(Mask m) { return m.v; }
inline Mask maskOf(unsigned laneBits) { return {(laneBits & 1) != 0}; }
inline Floats select(Mask m, Floats a, Floats b) { return m.v ? a : b; }
inline Ints select(Mask m, Ints a, Ints b) { return m.v ? a : b; }
inline Doubles select(Mask m, Doubles a, Doubles b) { return m.v ? a : b; }
// min(a, b) where the mask is set, a elsewhere.
inline Floats minWhere(Mask m, Floats a, Floats b) { return m.v ? min(a, b) : a; }
// There is one lane to take from, whatever the numbers say.
inline Floats permute(Floats a, Ints) { return a; }
inline Ints permute(Ints a, Ints) { return a; }

// Bits of the lanes where it holds.
inline unsigned less(Doubles a, Doubles b) { return a.v < b.v; }
inline unsigned atMost(Doubles a, Doubles b) { return a.v <= b.v; }
inline Mask operator<(Doubles a, Doubles b) { return {a.v < b.v}; }

inline float smallest(Floats a) { return a.v; }
inline float largest(Floats a) { return a.v; }
// Lane i is the smallest or largest number of row i.
inline Floats smallestOfRows(const float (*rows)[W]) { return rows[0][0]; }
inline Floats largestOfRows(const float (*rows)[W]) { return rows[0][0]; }

// x, y, z of W vectors that follow each other.
inline void loadVectors(const float* p, Floats& x, Floats& y, Floats& z) {
    x = p[0], y = p[1], z = p[2];
}

LANES_END
