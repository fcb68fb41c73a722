// A triangle and a ray, for the message of a test that failed.
#pragma once

#include "base/vec.h"

#include <array>
#include <sstream>
#include <string>

inline std::string shown(const std::array<Vec3, 3>& t, Vec3 o, Vec3 d) {
    std::ostringstream out;
    out.precision(9);
    for (const Vec3 v : {t[0], t[1], t[2], o, d})
        out << '(' << v.x << ' ' << v.y << ' ' << v.z << ") ";
    return out.str();
}
