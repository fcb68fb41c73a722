// T6: the edge of the shadow where a ball or a box stands on something, against the closed form in
// double. What rays are moved off a surface by, so that it does not shadow itself, moves the edge.
#include "base/text.h"
#include "integrate/shading.h"
#include "shape/cube.h"
#include "shape/plane.h"
#include "shape/sphere.h"
#include "verify/groups.h"
#include "verify/lamp_ray.h"
#include "verify/meshes.h"

#include <memory>

namespace battery {

namespace {

using meshes::Random;

// The extent of a scene is in [1,2) where it is traced: this is the distance of its floats.
constexpr double kUlp = 0x1p-23;

// A blocker that stands on the plane z = 0 of its own space, placed into a scene without
// stretching.
struct Contact {
    Transform sceneFromLocal;
    std::unique_ptr<Shape> receiver, blocker;
    bool isBall;
    Vec3d half; // sides of the box, or the radius thrice
    Vec3 lamp;  // in the scene: where it is, or the direction to it
    bool isSun;

    // Is the part of a ray between the receiver and the lamp inside the blocker?
    bool isDark(Vec3d p) const {
        const Transform localFromScene = sceneFromLocal.inverse();
        const Vec3d d = isSun ? localFromScene.vector(toDouble(lamp))
                              : localFromScene.point(toDouble(lamp)) - p;
        const Vec3d fromCentre = p - Vec3d{0, 0, half.z};
        if (isBall) { // its lowest point is on the plane and the lamp is above it
            const double along = -dot(fromCentre, d) / dot(d, d);
            return length(fromCentre + d * along) < half.z;
        }
        double enter = 0, exit = isSun ? kInfinity : 1;
        for (std::size_t i = 0; i < 3; ++i) {
            const double a = (-half[i] - fromCentre[i]) / d[i];
            const double b = (half[i] - fromCentre[i]) / d[i];
            enter = max(enter, min(a, b));
            exit = min(exit, max(a, b));
        }
        return enter < exit;
    }

    // As the renderer asks it, at the float point below `p`, which becomes that point.
    bool isBlocked(Vec3d& p) const {
        const Vec3d above = sceneFromLocal.point(p + Vec3d{0, 0, 0.01});
        const Ray eye{toFloat(above), toFloat(sceneFromLocal.vector({0, 0, -1}))};
        Hit hit;
        if (!receiver->intersect(eye, hit)) return false;
        const Surface s = receiver->surface(eye, hit);
        p = sceneFromLocal.inverse().point(toDouble(s.p));
        p.z = 0;
        if (isSun) return blocked({leave(s, s.ng), lamp});
        return blocked(rayFromLamp(s, s.ng, lamp, 0));
    }
    bool blocked(const Ray& ray) const { return receiver->occludes(ray) || blocker->occludes(ray); }

    // From p, where it is dark or lit, along `step` to where it is not: the fraction of the step.
    double crossing(Vec3d p, Vec3d step) const {
        const bool dark = isDark(p);
        double lo = 0, hi = 1;
        for (int i = 0; i < 60; ++i) {
            const double middle = (lo + hi) / 2;
            (isDark(p + step * middle) == dark ? lo : hi) = middle;
        }
        return hi;
    }
};

// On a square of 1.6 (ball) or on a box of that size (box).
Contact contact(Random& random, bool isBall, bool isSun) {
    Contact at;
    at.isBall = isBall;
    const Vec3d axis = random.direction();
    at.sceneFromLocal = Transform::translate(random.inBox(0.2)) *
                        Transform::rotate(axis, random.uniform(0, kTwoPi));
    const double radius = random.uniform(0.05, 0.3);
    at.half = {radius, radius, radius};
    const Transform standing = at.sceneFromLocal * Transform::translate({0, 0, at.half.z});
    if (isBall) {
        const Plane::Corners square = {Vec3d{-0.8, -0.8, 0}, Vec3d{0.8, -0.8, 0},
                                       Vec3d{0.8, 0.8, 0}, Vec3d{-0.8, 0.8, 0}};
        at.receiver = std::make_unique<Plane>(at.sceneFromLocal, square, 0, 0);
        at.blocker = std::make_unique<Sphere>(standing, radius, 0, 0);
    } else {
        at.half.x = random.uniform(0.05, 0.3), at.half.y = random.uniform(0.05, 0.3);
        const Transform below = at.sceneFromLocal * Transform::translate({0, 0, -0.3});
        at.receiver = std::make_unique<Cube>(below * Transform::scale({0.8, 0.8, 0.3}), 0, 0);
        at.blocker = std::make_unique<Cube>(standing * Transform::scale(at.half), 0, 0);
    }
    // 45 degrees or more above the plane, so that the edge of the shadow is nowhere drawn out.
    at.isSun = isSun;
    const double turn = random.uniform(0, kTwoPi), height = random.uniform(0.71, 0.99);
    const double side = std::sqrt(1 - height * height);
    const Vec3d up{side * exact::cos(turn), side * exact::sin(turn), height};
    at.lamp = toFloat(at.isSun ? at.sceneFromLocal.vector(up)
                               : at.sceneFromLocal.point(up * random.uniform(1, 3)));
    return at;
}

Tally shadowEdge(const Effort& effort, std::uint64_t seed, bool isBall, bool isSun) {
    constexpr int kPoints = 400; // about a place of the edge
    return inBatches(effort, seed, 100, [&](Random& random, Tally& tally) {
        const Contact at = contact(random, isBall, isSun);
        const double angle = random.uniform(0, kTwoPi);
        const Vec3d outwards{exact::cos(angle), exact::sin(angle), 0};
        // Where the blocker stands it is dark, and lit as far away as its shadow reaches.
        const Vec3d edge = outwards * 0.75 * at.crossing({}, outwards * 0.75);
        if (at.isDark(outwards * 0.75)) return;
        for (int i = 0; i < kPoints; ++i) {
            const double a = random.uniform(0, kTwoPi), r = random.logUniform(1e-8, 1e-2);
            Vec3d p = edge + Vec3d{exact::cos(a), exact::sin(a), 0} * r;
            const bool isBlocked = at.isBlocked(p);
            ++tally.cases;
            if (isBlocked == at.isDark(p)) continue;
            // How far it is from where that would be right.
            double nearest = length(p - edge);
            for (int k = 0; k < 32; ++k) {
                const double b = kTwoPi * k / 32;
                const Vec3d step = Vec3d{exact::cos(b), exact::sin(b), 0} * nearest;
                if (at.isDark(p + step) != at.isDark(p)) nearest *= at.crossing(p, step);
            }
            tally.measure(nearest / kUlp, [&] {
                return cat(isBlocked ? "dark" : "lit", " at ", nearest, " from the edge, ",
                           at.isSun ? "sun" : "lamp", " at elevation ",
                           at.sceneFromLocal.inverse().vector(toDouble(at.lamp)).z);
            });
        }
    });
}

template <std::uint64_t Seed, bool isBall, bool isSun> Tally edge(const Effort& effort) {
    return shadowEdge(effort, Seed, isBall, isSun);
}

constexpr Row kContactRows[] = {
    {"T6a", "edge of the shadow of a ball on a plane, under a sun", "ulp of the extent", 4, true,
     edge<61, true, true>},
    {"T6b", "the same of a box on a box", "ulp of the extent", 4, true, edge<62, false, true>},
    {"T6c", "of a ball on a plane, under a lamp 1 to 3 away", "ulp of the extent", 4, true,
     edge<63, true, false>},
    {"T6d", "of a box on a box, under such a lamp", "ulp of the extent", 4, true,
     edge<64, false, false>},
};

} // namespace

std::span<const Row> contactRows() { return kContactRows; }

} // namespace battery
