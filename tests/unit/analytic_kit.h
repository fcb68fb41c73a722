// What the tests of the shapes with a formula share beside Code/verify/shape_kinds.h: random
// numbers that print their seed, and some more of them.
#pragma once

#include "base/math.h"
#include "shape/cone.h"
#include "shape/cube.h"
#include "shape/cylinder.h"
#include "shape/disk.h"
#include "shape/infinite_plane.h"
#include "shape/sphere.h"
#include "verify/shape_kinds.h"

#include <cstdio>

namespace kit {

class Random : public meshes::Random {
public:
    explicit Random(std::uint64_t seed) : meshes::Random(seed) {
        std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
    }
    bool coin() { return chance(0.5); }
    Vec3d outwards(double least, double most) {
        const Vec3d d = direction();
        return d * uniform(least, most);
    }
    // Of either sign.
    double signedUniform(double lo, double hi) {
        const double x = uniform(lo, hi);
        return coin() ? x : -x;
    }
    double signedLogUniform(double lo, double hi) {
        const double x = logUniform(lo, hi);
        return coin() ? x : -x;
    }
    Transform turn() {
        const Vec3d axis = direction();
        return Transform::rotate(axis, uniform(0, kTwoPi));
    }
};

// Any such map of unit size, within 10 of the origin.
inline Transform randomMap(Random& random) {
    const Vec3d factors = randomFactors(random, 1);
    const Vec3d offset = random.inBox(10);
    return placed(random, factors, offset);
}

} // namespace kit
