// What the tests of the shapes with a formula share: random numbers, transforms, and one of each.
#pragma once

#include "base/math.h"
#include "base/motion.h"
#include "shape/cone.h"
#include "shape/cube.h"
#include "shape/cylinder.h"
#include "shape/disk.h"
#include "shape/infinite_plane.h"
#include "shape/plane.h"
#include "shape/sphere.h"

#include <cstdio>
#include <functional>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace kit {

// mt19937_64 gives the same numbers everywhere; the distributions of <random> do not, nor do two
// draws in one expression, whose order the compiler chooses.
class Random {
public:
    explicit Random(std::uint64_t seed) : bits_(seed) {
        std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
    }
    double unit() { return static_cast<double>(bits_() >> 11) * 0x1p-53; }
    double uniform(double lo, double hi) { return lo + (hi - lo) * unit(); }
    double logUniform(double lo, double hi) {
        return lo * exact::exp(unit() * exact::log(hi / lo));
    }
    bool coin() { return unit() < 0.5; }
    Vec3d inBox(double half) {
        return {uniform(-half, half), uniform(-half, half), uniform(-half, half)};
    }
    Vec3d direction() {
        while (true) {
            const Vec3d v = inBox(1);
            const double l = length(v);
            if (l > 0.01 && l <= 1) return v / l;
        }
    }
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

private:
    std::mt19937_64 bits_;
};

// Turn, scale along the axes by the factors (which may mirror), turn, move.
inline Transform placed(Random& random, Vec3d factors, Vec3d offset) {
    const Transform turn = random.turn(), turnBack = random.turn();
    return Transform::translate(offset) * turn * Transform::scale(factors) * turnBack;
}

// Factors of condition <= 1e4 about `size`, mirrored half the time.
inline Vec3d randomFactors(Random& random, double size) {
    Vec3d f;
    for (std::size_t i = 0; i < 3; ++i) f[i] = size * random.signedLogUniform(1e-2, 1e2);
    return f;
}

// Any such map of unit size, within 10 of the origin.
inline Transform randomMap(Random& random) {
    const Vec3d factors = randomFactors(random, 1);
    const Vec3d offset = random.inBox(10);
    return placed(random, factors, offset);
}

// One shape of each kind; rim() gives points that reach every side of its smallest box.
struct Kind {
    std::string name;
    bool isClosed, isFlat;
    std::function<std::unique_ptr<Shape>(const MovingTransform&)> make;
    std::function<Vec3d(Random&)> rim;
};
inline Vec3d onCircle(Random& random, double radius, double z) {
    const double angle = random.uniform(0, kTwoPi);
    return {radius * exact::cos(angle), radius * exact::sin(angle), z};
}
inline const Plane::Corners kQuad = {Vec3d{-1, -1, 0.25}, Vec3d{1, -0.5, 0.25},
                                     Vec3d{0.75, 1, 0.25}, Vec3d{-0.5, 0.75, 0.25}};
inline Kind coneKind(const std::string& name, double radius, double topRadius, bool caps) {
    return {
        name, caps, false,
        [=](auto& m) { return std::make_unique<Cone>(m, radius, topRadius, caps, 3u, 5u); },
        [=](Random& r) { return r.coin() ? onCircle(r, radius, -1) : onCircle(r, topRadius, 1); }};
}
inline Kind cylinderKind(const std::string& name, double radius, bool caps) {
    return {name, caps, false,
            [=](auto& m) { return std::make_unique<Cylinder>(m, radius, caps, 3u, 5u); },
            [=](Random& r) { return onCircle(r, radius, r.coin() ? -1 : 1); }};
}
inline std::vector<Kind> kinds() {
    return {
        {"sphere", true, false, [](auto& m) { return std::make_unique<Sphere>(m, 1.0, 3u, 5u); },
         [](Random& r) { return r.direction(); }},
        {"cube", true, false, [](auto& m) { return std::make_unique<Cube>(m, 3u, 5u); },
         [](Random& r) {
             return BoundsD{{-1, -1, -1}, {1, 1, 1}}.corner(static_cast<int>(r.unit() * 8));
         }},
        cylinderKind("cylinder", 1, true),
        cylinderKind("tube", 0.5, false),
        coneKind("cone", 1, 0, true),
        coneKind("inverted cone", 0, 0.25, true),
        coneKind("cut cone", 0.5, 1.5, true),
        coneKind("open cone", 1, 0.5, false),
        {"disk", false, true, [](auto& m) { return std::make_unique<Disk>(m, 1.0, 3u, 5u); },
         [](Random& r) { return onCircle(r, 1, 0); }},
        {"plane", false, true, [](auto& m) { return std::make_unique<Plane>(m, kQuad, 3u, 5u); },
         [](Random& r) { return kQuad[static_cast<std::size_t>(r.unit() * 4)]; }},
        {"infinite plane", false, true,
         [](auto& m) { return std::make_unique<InfinitePlane>(m, 3u, 5u); },
         [](Random& r) { return onCircle(r, r.logUniform(0.1, 100), 0); }},
    };
}
inline Kind kindNamed(const std::string& name) {
    for (const Kind& kind : kinds())
        if (kind.name == name) return kind;
    throw std::runtime_error("no kind " + name);
}

inline Ray rayFrom(Vec3d org, Vec3d dir) { return {toFloat(org), toFloat(dir)}; }
inline Ray rayThrough(Vec3d org, Vec3d target) {
    return rayFrom(org, normalize(target - toDouble(toFloat(org))));
}

} // namespace kit
