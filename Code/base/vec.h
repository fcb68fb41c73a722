// Vectors and colours: plain data and free functions, usable in constant expressions.
// Knows nothing above arithmetic.
#pragma once

#include <cmath>
#include <cstddef>

template <class T> struct Vec2T {
    T x{}, y{};
    constexpr bool operator==(const Vec2T&) const = default;
};

template <class T> struct Vec3T {
    T x{}, y{}, z{};
    constexpr T operator[](std::size_t axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr T& operator[](std::size_t axis) { return axis == 0 ? x : axis == 1 ? y : z; }
    constexpr bool operator==(const Vec3T&) const = default;
};

using Vec2 = Vec2T<float>;
using Vec3 = Vec3T<float>;
using Vec2d = Vec2T<double>;
using Vec3d = Vec3T<double>;

template <class T> constexpr Vec2T<T> operator+(Vec2T<T> a, Vec2T<T> b) {
    return {a.x + b.x, a.y + b.y};
}
template <class T> constexpr Vec2T<T> operator-(Vec2T<T> a, Vec2T<T> b) {
    return {a.x - b.x, a.y - b.y};
}
template <class T> constexpr Vec2T<T> operator*(Vec2T<T> a, T s) { return {a.x * s, a.y * s}; }

template <class T> constexpr Vec3T<T> operator+(Vec3T<T> a, Vec3T<T> b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T> constexpr Vec3T<T> operator-(Vec3T<T> a, Vec3T<T> b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T> constexpr Vec3T<T> operator-(Vec3T<T> a) { return {-a.x, -a.y, -a.z}; }
template <class T> constexpr Vec3T<T> operator*(Vec3T<T> a, T s) {
    return {a.x * s, a.y * s, a.z * s};
}
template <class T> constexpr Vec3T<T> operator*(T s, Vec3T<T> a) { return a * s; }
template <class T> constexpr Vec3T<T> operator/(Vec3T<T> a, T s) {
    return {a.x / s, a.y / s, a.z / s};
}
template <class T> constexpr Vec3T<T>& operator+=(Vec3T<T>& a, Vec3T<T> b) { return a = a + b; }
template <class T> constexpr Vec3T<T>& operator-=(Vec3T<T>& a, Vec3T<T> b) { return a = a - b; }
template <class T> constexpr Vec3T<T>& operator*=(Vec3T<T>& a, T s) { return a = a * s; }

template <class T> constexpr T dot(Vec3T<T> a, Vec3T<T> b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T> constexpr Vec3T<T> cross(Vec3T<T> a, Vec3T<T> b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T> T length(Vec3T<T> a) { return std::sqrt(dot(a, a)); }
// A zero vector has no direction: the caller makes sure that it is none.
template <class T> Vec3T<T> normalize(Vec3T<T> a) { return a / length(a); }
template <class T> constexpr Vec3T<T> lerp(Vec3T<T> a, Vec3T<T> b, T s) {
    return a * (T(1) - s) + b * s;
}
// Largest absolute component.
template <class T> constexpr T maxAbs(Vec3T<T> a) {
    const T x = a.x < 0 ? -a.x : a.x, y = a.y < 0 ? -a.y : a.y, z = a.z < 0 ? -a.z : a.z;
    const T xy = x > y ? x : y;
    return xy > z ? xy : z;
}

constexpr Vec3 toFloat(Vec3d a) {
    return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}
constexpr Vec3d toDouble(Vec3 a) { return {a.x, a.y, a.z}; }

// Linear light; what a channel means (radiance, reflectance, weight) is in the variable's name.
struct Rgb {
    float r = 0, g = 0, b = 0;
    constexpr bool operator==(const Rgb&) const = default;
};

constexpr Rgb operator+(Rgb a, Rgb b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
constexpr Rgb operator-(Rgb a, Rgb b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
constexpr Rgb operator*(Rgb a, Rgb b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
constexpr Rgb operator*(Rgb a, float s) { return {a.r * s, a.g * s, a.b * s}; }
constexpr Rgb operator*(float s, Rgb a) { return a * s; }
constexpr Rgb operator/(Rgb a, float s) { return {a.r / s, a.g / s, a.b / s}; }
constexpr Rgb& operator+=(Rgb& a, Rgb b) { return a = a + b; }
constexpr Rgb& operator*=(Rgb& a, Rgb b) { return a = a * b; }
constexpr Rgb lerp(Rgb a, Rgb b, float s) { return a * (1 - s) + b * s; }
constexpr bool isBlack(Rgb a) { return a.r == 0 && a.g == 0 && a.b == 0; }
constexpr float maxChannel(Rgb a) {
    const float rg = a.r > a.g ? a.r : a.g;
    return rg > a.b ? rg : a.b;
}
// Luminance of linear Rec. 709 / sRGB primaries.
constexpr float luminance(Rgb a) { return 0.2126f * a.r + 0.7152f * a.g + 0.0722f * a.b; }
