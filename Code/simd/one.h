// One lane, of plain numbers: what code for registers says of one thing alone.
#pragma once

#include "simd/region.h"

#include <cmath>
#include <cstdint>

LANES_BEGIN

constexpr int W = 1;

struct Mask {
    bool v;
};
struct Floats {
    float v;
    Floats() = default;
    Floats(float a) : v(a) {}
    static Floats load(const float* p) { return *p; }
    void store(float* p) const { *p = v; }
};
struct Ints {
    std::uint32_t v;
    Ints(std::uint32_t a) : v(a) {}
    static Ints load(const std::uint32_t* p) { return *p; }
};

inline Floats operator+(Floats a, Floats b) { return a.v + b.v; }
inline Floats operator-(Floats a, Floats b) { return a.v - b.v; }
inline Floats operator*(Floats a, Floats b) { return a.v * b.v; }
inline Floats operator/(Floats a, Floats b) { return a.v / b.v; }
inline Floats sqrt(Floats a) { return std::sqrt(a.v); }
inline Floats abs(Floats a) { return std::fabs(a.v); }
// The second operand wins when one is NaN.
inline Floats min(Floats a, Floats b) { return a.v < b.v ? a : b; }
inline Floats max(Floats a, Floats b) { return a.v > b.v ? a : b; }

inline Mask operator<(Floats a, Floats b) { return {a.v < b.v}; }
inline Mask operator>(Floats a, Floats b) { return {a.v > b.v}; }
inline Mask operator==(Floats a, Floats b) { return {a.v == b.v}; }
inline Mask operator==(Ints a, Ints b) { return {a.v == b.v}; }
inline Mask operator&(Mask a, Mask b) { return {a.v && b.v}; }
inline Mask operator|(Mask a, Mask b) { return {a.v || b.v}; }
inline unsigned bits(Mask m) { return m.v; }
inline Mask maskOf(unsigned laneBits) { return {(laneBits & 1) != 0}; }
inline Floats select(Mask m, Floats a, Floats b) { return m.v ? a : b; }

LANES_END
