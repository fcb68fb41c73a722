// Numbers of 113 bits, and vectors of them: the truth that the battery holds double and float
// against. Nothing of the product may use them.
#pragma once

#include "base/vec.h"

namespace battery {

// long double has as many bits where the compiler has no __float128 (64-bit Arm).
#if defined(__SIZEOF_FLOAT128__)
// NOLINTNEXTLINE(modernize-use-using): no __extension__ before a `using`
__extension__ typedef __float128 Wide;
#else
using Wide = long double;
#endif
using Vec3w = Vec3T<Wide>;

// Newton's method twice from the root in double: 53, 106, 113 bits. x must lie in double's range.
inline Wide squareRoot(Wide x) {
    const double start = std::sqrt(static_cast<double>(x));
    if (!(start > 0)) return 0;
    Wide root = start;
    for (int i = 0; i < 2; ++i) root = (root + x / root) / 2;
    return root;
}

constexpr Wide magnitude(Wide x) { return x < 0 ? -x : x; }
constexpr Vec3w toWide(Vec3d v) { return {v.x, v.y, v.z}; }
constexpr Vec3w toWide(Vec3 v) { return toWide(toDouble(v)); }
constexpr Vec3d toDouble(Vec3w v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

} // namespace battery
