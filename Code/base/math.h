// Numbers: constants, small helpers, and elementary functions that give the same bits everywhere.
// Knows nothing about vectors or scenes.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTwoPi = 6.28318530717958647693;
inline constexpr double kHalfPi = 1.57079632679489661923;
inline constexpr double kInvPi = 0.31830988618379067154;
inline constexpr double kInvTwoPi = 0.15915494309189533577;
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
inline constexpr float kInfinityF = std::numeric_limits<float>::infinity();
inline constexpr double kQuietNaN = std::numeric_limits<double>::quiet_NaN();
// The largest float below 1: what a random number in [0,1) may reach.
inline constexpr float kOneMinusUlp = 0x1.fffffep-1f;

// The order of operands decides what NaN does: the second operand wins, as in minps and maxps.
template <class T> constexpr T min(T a, T b) { return a < b ? a : b; }
template <class T> constexpr T max(T a, T b) { return a > b ? a : b; }
// NaN gives lo.
template <class T> constexpr T clamp(T x, T lo, T hi) { return min(max(x, lo), hi); }
template <class T> constexpr T sqr(T x) { return x * x; }
constexpr double lerp(double a, double b, double s) { return a * (1 - s) + b * s; }
constexpr float lerp(float a, float b, float s) { return a * (1 - s) + b * s; }
constexpr double radians(double degrees) { return degrees * (kPi / 180); }
constexpr double degrees(double radians) { return radians * (180 / kPi); }

// Bound of the relative error of n float operations, n u / (1 - n u) with u = 2^-24 (Higham 3.1).
constexpr float roundingBound(int n) {
    const double nu = n * 0x1p-24;
    return static_cast<float>(nu / (1 - nu));
}
// The same for double, u = 2^-53.
constexpr double roundingBoundD(int n) {
    const double nu = n * 0x1p-53;
    return nu / (1 - nu);
}

// The next number towards +infinity or -infinity; infinities in that direction and NaN stay.
constexpr float nextUp(float x) {
    if (!(x < kInfinityF)) return x;
    if (x == 0) return std::numeric_limits<float>::denorm_min();
    const auto bits = std::bit_cast<std::uint32_t>(x);
    return std::bit_cast<float>(x > 0 ? bits + 1 : bits - 1);
}
constexpr float nextDown(float x) { return -nextUp(-x); }
constexpr double nextUp(double x) {
    if (!(x < kInfinity)) return x;
    if (x == 0) return std::numeric_limits<double>::denorm_min();
    const auto bits = std::bit_cast<std::uint64_t>(x);
    return std::bit_cast<double>(x > 0 ? bits + 1 : bits - 1);
}
constexpr double nextDown(double x) { return -nextUp(-x); }

// The nearest float at or below, at or above the double. Which of its neighbours that is can't be
// guessed: a step away from zero or towards it, or none, without branches.
constexpr float floatAbove(double x) {
    const float nearest = static_cast<float>(x);
    const auto bits = std::bit_cast<std::int32_t>(nearest);
    const std::int32_t isBelow = static_cast<double>(nearest) < x;
    return std::bit_cast<float>(bits + ((bits >> 31 | 1) & -isBelow));
}
constexpr float floatBelow(double x) { return -floatAbove(-x); }

// a*b - c*d without cancellation: the error is below 0.6 ulp of the result unless a product
// underflows or exceeds 2^996. Products are split exactly (Dekker 1971), as FMA is banned.
double differenceOfProducts(double a, double b, double c, double d);

// Elementary functions with the same bits on every machine, compiler and -O level: built from
// + - * / sqrt and integer steps only. std::sin and the rest are banned in everything that reaches
// a picture, because the C library picks other code by CPU and version (glibc has FMA variants).
// Errors are against the true value, in units in the last place, measured by test_math_angles.cpp
// and test_math_powers.cpp; domain errors give NaN, NaN gives NaN.
namespace exact {

struct SinCos {
    double sin, cos;
};

// 0.85 ulp for |x| < 2^47. Beyond, where the last place of x is 0.03 radians or more: some value in
// [-1,1], the same everywhere. Infinities give NaN.
double sin(double x);
double cos(double x);
SinCos sinCos(double x);
double tan(double x); // 1.1 ulp

double asin(double x); // 1.5 ulp; NaN outside [-1,1]
double acos(double x);
double atan(double x);
// 1.5 ulp. In [-pi,pi]; signed zeros as in C: atan2(0,-1) = pi, atan2(-0.0,-1) = -pi and
// atan2(0,0) = 0.
double atan2(double y, double x);

double exp(double x);  // 0.55 ulp; 0 below -745.2, infinity above 709.8; denormal results 0.75
double exp2(double x); // the same
double log(double x);  // 0.55 ulp; log(0) = -infinity, NaN below 0
double log2(double x); // 0.55 ulp; exact for powers of two
// 0.55 ulp, denormal results 1 ulp. Special values as in C: pow(x,0) = pow(1,y) = 1 even for NaN,
// pow(0,y>0) = 0, pow(0,y<0) = infinity, x < 0 needs a whole y (else NaN).
double pow(double x, double y);
double cbrt(double x); // 0.7 ulp

// The specular lobe's power, the float nearest to base^exponent but for a chance of 1 in 10^4 of
// the neighbour. For base in [0,inf], any exponent; same special values as pow, NaN for base < 0.
float pow(float base, float exponent);

} // namespace exact
