// frameAround() of each lane, for vectors of registers of any kind.
#pragma once

#include "simd/lanes.h"

LANES_BEGIN

template <class Vector> struct Frames {
    Vector x, y, z;
    Vector toWorld(Floats a, Floats b, Floats c) const { return x * a + y * b + z * c; }
};
template <class Vector> inline Frames<Vector> framesAround(const Vector& unit) {
    const Doubles x(unit.x), y(unit.y), z(unit.z), one(1.0), none(-0.0);
    const Doubles sign = withSign(one, z);
    const Doubles a = Doubles(-1.0) / (sign + z), b = x * y * a;
    const auto rounded = [&](const Doubles& i, const Doubles& j, const Doubles& k) {
        return Vector{i.toFloats(), j.toFloats(), k.toFloats()};
    };
    return {rounded(one + sign * x * x * a, sign * b, (none - sign) * x),
            rounded(b, sign + y * y * a, none - y), unit};
}

LANES_END
