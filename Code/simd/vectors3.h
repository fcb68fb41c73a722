// Vectors, lane by lane.
#pragma once

#include "base/vec.h"
#include "simd/lanes.h"

LANES_BEGIN

struct Doubles3 {
    Doubles x, y, z;
    static Doubles3 of(const Floats& x, const Floats& y, const Floats& z) {
        return {Doubles(x), Doubles(y), Doubles(z)};
    }
};

inline Doubles3 forAll(Vec3d v) { return {Doubles(v.x), Doubles(v.y), Doubles(v.z)}; }

inline Doubles3 operator+(const Doubles3& a, const Doubles3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Doubles3 operator-(const Doubles3& a, const Doubles3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Doubles3 operator*(const Doubles3& a, const Doubles& s) {
    return {a.x * s, a.y * s, a.z * s};
}
inline Doubles3 operator/(const Doubles3& a, const Doubles& s) {
    return {a.x / s, a.y / s, a.z / s};
}
inline Doubles dot(const Doubles3& a, const Doubles3& b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
inline Doubles3 cross(const Doubles3& a, const Doubles3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct Floats3 {
    Floats x, y, z;
    static Floats3 of(const Doubles3& v) {
        return {v.x.toFloats(), v.y.toFloats(), v.z.toFloats()};
    }
};

inline Floats3 operator+(const Floats3& a, const Floats3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Floats3 operator-(const Floats3& a, const Floats3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Floats3 operator*(const Floats3& a, const Floats3& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline Floats3 operator*(const Floats3& a, Floats s) { return {a.x * s, a.y * s, a.z * s}; }
inline Floats3 operator/(const Floats3& a, Floats s) { return {a.x / s, a.y / s, a.z / s}; }
inline Floats dot(const Floats3& a, const Floats3& b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
inline Floats3 cross(const Floats3& a, const Floats3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Floats3 negated(const Floats3& a) {
    const Floats sign(-0.0f);
    return {flipSign(a.x, sign), flipSign(a.y, sign), flipSign(a.z, sign)};
}
inline Floats3 normalize(const Floats3& a) { return a / sqrt(dot(a, a)); }
inline Floats3 select(Mask m, const Floats3& a, const Floats3& b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
inline Doubles3 select(Mask m, const Doubles3& a, const Doubles3& b) {
    return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}

LANES_END
