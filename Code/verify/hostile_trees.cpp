#include "verify/hostile_trees.h"

#include "base/math.h"

#include <cmath>

namespace battery {

namespace {

using meshes::Random;

std::array<Vec3, 3> triangleAt(Random& random, Vec3d place, double size) {
    const Vec3d a = random.inBox(size), b = random.inBox(size), c = random.inBox(size);
    return {toFloat(place + a), toFloat(place + b), toFloat(place + c)};
}

Triangles identical(Random& random, std::size_t count) {
    return Triangles(count, triangleAt(random, random.inBox(0.3), 0.5));
}

// The centres of all boxes are 0, none is like another.
Triangles concentric(Random& random, std::size_t count) {
    Triangles out;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 p = toFloat(random.inBox(1));
        Vec3 q = -p;
        q[random.below(3)] *= -1; // the box stays that of p and -p
        out.push_back({p, -p, q});
    }
    return out;
}

// Each as far from the next one as from 0: a split in the middle takes off a few at one end.
Triangles exponential(Random& random, std::size_t count) {
    Triangles out;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = std::ldexp(1 + random.unit(), -static_cast<int>(random.below(120)));
        const Vec3d places[] = {{x, 0, 0}, {0, x, 0}, {0, 0, x}, {-x, x, x}};
        out.push_back(triangleAt(random, places[random.below(4)], x * random.logUniform(1e-3, 1)));
    }
    return out;
}

// Powers of 17 on three axes in turn: every split into 16 bins takes off the outermost only.
Triangles peeled(Random& random, std::size_t count) {
    Triangles out;
    for (std::size_t i = 0; i < count; ++i) {
        Vec3d place;
        const double x = std::exp2(-4.0875 * random.below(29));
        place[i % 3] = x;
        out.push_back(triangleAt(random, place, x * 1e-3));
    }
    return out;
}

// A mesh of 1e-6 of the stadium, whose few walls are 2.
Triangles teapotInStadium(Random& random, std::size_t count) {
    Triangles out;
    for (std::size_t i = 0; i < std::min<std::size_t>(count, 20); ++i)
        out.push_back(triangleAt(random, random.direction() * 0.8, 1));
    const Vec3d place = random.inBox(0.3);
    while (out.size() < count)
        out.push_back(triangleAt(random, place + random.direction() * 1e-6, 1e-8));
    return out;
}

// From one corner of the scene to the opposite one: every box is nearly the whole.
Triangles longDiagonals(Random& random, std::size_t count) {
    Triangles out;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3d off = random.inBox(0.1), end = random.inBox(0.1), wide = random.inBox(1e-3);
        out.push_back({toFloat(off - Vec3d{0.9, 0.9, 0.9}), toFloat(end + Vec3d{0.9, 0.9, 0.9}),
                       toFloat(off + wide - Vec3d{0.9, 0.9, 0.9})});
    }
    return out;
}

// Neighbouring floats: bins narrower than the last place.
Triangles lastPlaces(Random& random, std::size_t count) {
    Triangles out;
    for (std::size_t i = 0; i < count; ++i) {
        const auto near = [&] {
            return meshes::stepped(1, static_cast<int>(random.below(64)) - 32);
        };
        const auto corner = [&] { return Vec3{near(), near(), near()}; };
        const Vec3 a = corner(), b = corner();
        out.push_back({a, b, corner()});
    }
    return out;
}

constexpr HostileTree kTrees[] = {
    {"identical", identical},
    {"concentric", concentric},
    {"exponential spacing", exponential},
    {"powers of 17", peeled},
    {"teapot in a stadium", teapotInStadium},
    {"long diagonals", longDiagonals},
    {"neighbouring floats", lastPlaces},
};

} // namespace

std::span<const HostileTree> hostileTrees() { return kTrees; }

Triangles evenTriangles(Random& random, std::size_t count) {
    Triangles out;
    const double size = 2 / std::sqrt(static_cast<double>(count));
    for (std::size_t i = 0; i < count; ++i)
        out.push_back(triangleAt(random, random.direction() * 0.9, size));
    return out;
}

} // namespace battery
