// What every shape with a formula must do; each test_<shape>.cpp runs it for its kinds.
#pragma once

#include "analytic_kit.h"
#include "check.h"

#include <algorithm>

namespace kit {

inline Ray randomRayAt(Random& random, const Transform& map) {
    const Vec3d from = random.outwards(0, 4);
    return rayThrough(map.point(from), map.point(random.inBox(1)));
}

// intersect, occludes and collect tell the same story, and keep the rules of shape.h.
inline void checkQueries(const Kind& kind, Random& random) {
    for (int s = 0; s < 30; ++s) {
        const Transform map = randomMap(random);
        const auto shape = kind.make(map);
        for (int i = 0; i < 300; ++i) {
            Ray ray = randomRayAt(random, map);
            std::vector<Hit> all;
            shape->collect(ray, all);
            std::sort(all.begin(), all.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
            Hit hit;
            hit.shape = 77;
            const Hit before = hit;
            CHECK_EQUAL(shape->intersect(ray, hit), !all.empty());
            CHECK_EQUAL(shape->occludes(ray), !all.empty());
            if (all.empty()) {
                CHECK(hit == before);
                continue;
            }
            CHECK(hit.t == all[0].t && hit.prim == all[0].prim && hit.shape == 77);

            Hit equal;
            equal.t = all[0].t;
            CHECK(shape->intersect(ray, equal)); // equal t is accepted
            Hit nearer;
            nearer.t = nextDown(all[0].t);
            const Hit kept = nearer;
            CHECK(!shape->intersect(ray, nearer) && nearer == kept);

            ray.tMax = all[0].t; // both ends are excluded
            CHECK(!shape->occludes(ray));
            ray.tMax = nextUp(all[0].t);
            CHECK(shape->occludes(ray));
            ray.tMax = kInfinityF;
            ray.tMin = all[0].t;
            std::vector<Hit> behind;
            shape->collect(ray, behind);
            const auto beyond =
                std::count_if(all.begin(), all.end(), [&](const Hit& h) { return h.t > all[0].t; });
            CHECK_EQUAL(behind.size(), static_cast<std::size_t>(beyond));
            Hit next;
            CHECK_EQUAL(shape->intersect(ray, next), beyond > 0);
        }
    }
}

// Points lie on the ray and in the box; normals have unit length and point outwards (flat shapes:
// to object +z), mirrored or not; dpdu and dpdv turn with the outside and tell how p moves with uv.
inline void checkSurfaces(const Kind& kind, Random& random) {
    int points = 0, slopes = 0;
    for (int s = 0; s < 60; ++s) {
        // Every other map is mild, for difference quotients that mean something.
        const bool isMild = s % 2 == 1;
        const auto mild = [&] { return random.signedUniform(0.7, 1.4); };
        const Vec3d factors = isMild ? Vec3d{mild(), mild(), mild()} : randomFactors(random, 1);
        const Transform map = placed(random, factors, random.inBox(isMild ? 1 : 10));
        const auto shape = kind.make(map);
        const Bounds box = shape->bounds();
        for (int i = 0; i < 100; ++i) {
            const Ray ray = randomRayAt(random, map);
            Hit hit;
            if (!shape->intersect(ray, hit)) continue;
            const Surface at = shape->surface(ray, hit);
            ++points;
            CHECK_EQUAL(at.material, 3u);
            CHECK_EQUAL(at.object, 5u);
            CHECK(box.contains(at.p));
            const Vec3d p = toDouble(at.p), ng = toDouble(at.ng);
            // 20 times the bound: near edges p is kept away from them by up to 4 errors a side,
            // stretched where the sides meet at an angle.
            const Vec3d onRay = toDouble(ray.org) + toDouble(ray.dir) * static_cast<double>(hit.t);
            const double grazing = std::fabs(dot(ng, toDouble(ray.dir)));
            if (grazing > 0.1) CHECK_NEAR(length(p - onRay), 0, 20 * at.error / grazing + 1e-5);
            CHECK_NEAR(length(ng), 1, 1e-7);
            CHECK(at.ns == at.ng);
            CHECK(at.error > 0 && static_cast<double>(at.error) < 1e-5 * (10 + length(p)));
            const Vec3d inside = map.point({0, 0, 0});
            if (kind.isFlat)
                CHECK(dot(ng, map.vector({0, 0, 1})) > 0);
            else
                CHECK(dot(ng, p - inside) > 0);
            CHECK(at.uv.x >= 0 || kind.name == "infinite plane");
            CHECK(at.uv.x <= 1 || kind.name == "infinite plane");

            const SurfaceDerivatives d = shape->derivatives(ray, hit);
            const Vec3d dpdu = toDouble(d.dpdu), dpdv = toDouble(d.dpdv);
            const Vec3d turn = cross(dpdu, dpdv);
            CHECK(dot(turn, ng) * (map.mirrors() ? -1 : 1) > 0);
            CHECK(std::fabs(dot(normalize(turn), ng)) > 0.999);
            if (!isMild) continue;
            // A neighbour on the same part, a little further.
            const Vec3d step = normalize(cross(ng, random.direction()));
            const double small = 1e-3 * min(length(dpdu), length(dpdv));
            const Ray beside = rayThrough(toDouble(ray.org), p + step * small);
            Hit other;
            if (!shape->intersect(beside, other) || other.prim != hit.prim) continue;
            const Surface next = shape->surface(beside, other);
            const double du = static_cast<double>(next.uv.x) - static_cast<double>(at.uv.x);
            const double dv = static_cast<double>(next.uv.y) - static_cast<double>(at.uv.y);
            const Vec3d moved = toDouble(next.p) - p;
            if (std::fabs(du) > 0.02 || std::fabs(dv) > 0.02 || length(moved) > 3 * small) continue;
            ++slopes;
            // Curvature moves it by a part of the step, rounding of p and uv by 1e-6 of them.
            CHECK_NEAR(length(moved - dpdu * du - dpdv * dv), 0,
                       0.02 * length(moved) + 3e-6 * (1 + maxAbs(p)));
        }
    }
    CHECK_INFO(points > 500 && slopes > 200, kind.name << points << " " << slopes);
}

// The box holds every point, in double and rounded, and is the smallest but for 1 %.
inline void checkBounds(const Kind& kind, Random& random) {
    for (int s = 0; s < 100; ++s) {
        Vec3d factors = randomFactors(random, random.logUniform(1e-4, 1e4));
        if (s % 4 == 0) factors.y *= 1e-6; // nearly flat
        const Vec3d offset = s % 3 == 0 ? Vec3d{} : random.inBox(random.logUniform(1e-4, 1e4));
        const Transform map = s % 5 == 0 ? Transform::translate(offset) * Transform::scale(factors)
                                         : placed(random, factors, offset);
        const auto shape = kind.make(map);
        const Bounds box = shape->bounds();
        if (kind.name == "infinite plane") {
            CHECK(box.lo.x == -kInfinityF && box.hi.z == kInfinityF && box.lo.y == -kInfinityF);
            continue;
        }
        BoundsD reached;
        bool holds = true;
        for (int i = 0; i < 3000; ++i) {
            const Vec3d p = map.point(kind.rim(random));
            reached.extend(p);
            holds = holds && toDouble(box).contains(p) && box.contains(toFloat(p));
        }
        CHECK_INFO(holds, kind.name);
        const Vec3d size = reached.size();
        const double slack = 0x1p-20 * max(maxAbs(reached.lo), maxAbs(reached.hi));
        for (std::size_t i = 0; i < 3; ++i) {
            CHECK_NEAR(box.lo[i], reached.lo[i], 0.01 * size[i] + slack);
            CHECK_NEAR(box.hi[i], reached.hi[i], 0.01 * size[i] + slack);
        }
    }
}

// At every time a moving shape is the shape at rest there, and its box holds it.
inline void checkMotion(const Kind& kind, Random& random) {
    for (int s = 0; s < 20; ++s) {
        // Keys that are not mirrors of each other: between those the map would be flat.
        const Vec3d factors{random.uniform(0.5, 2), random.uniform(0.5, 2), -random.uniform(1, 2)};
        std::vector<Transform> keys;
        for (int k = 0; k < 3; ++k) {
            const Vec3d place = random.inBox(3);
            keys.push_back(Transform::translate(place) * random.turn() * Transform::scale(factors));
        }
        const MovingTransform motion{std::span<const Transform>(keys)};
        const auto moving = kind.make(motion);
        const Bounds box = moving->bounds();
        for (int i = 0; i < 50; ++i) {
            const float time = i == 0 ? 0.0f : i == 1 ? 1.0f : static_cast<float>(random.unit());
            const Transform map = motion.at(static_cast<double>(time));
            const auto still = kind.make(map);
            Ray ray = randomRayAt(random, map);
            ray.time = time;
            Hit a, b;
            CHECK_EQUAL(moving->intersect(ray, a), still->intersect(ray, b));
            CHECK(a == b);
            if (a.t == kInfinityF) continue;
            const Surface p = moving->surface(ray, a), q = still->surface(ray, b);
            CHECK(p.p == q.p && p.ng == q.ng && p.uv == q.uv && p.error == q.error);
            const SurfaceDerivatives d = moving->derivatives(ray, a),
                                     e = still->derivatives(ray, b);
            CHECK(d.dpdu == e.dpdu && d.dpdv == e.dpdv);
            CHECK(box.contains(p.p));
        }
    }
}

// Rays that are none: a miss, no crash. Rays with extreme numbers: no NaN.
inline void checkBadRays(const Kind& kind, Random& random) {
    const Transform map = placed(random, {1, 2, 0.5}, {0.1, 0.2, 0.3});
    const auto shape = kind.make(map);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float bad[] = {nan, kInfinityF, -kInfinityF};
    const auto misses = [&](const Ray& ray) {
        Hit hit;
        std::vector<Hit> all;
        shape->collect(ray, all);
        return !shape->intersect(ray, hit) && hit == Hit{} && !shape->occludes(ray) && all.empty();
    };
    const Ray good = rayThrough({5, 5, 5}, map.point({0.1, 0.1, 0.2}));
    for (const float x : bad) {
        for (std::size_t i = 0; i < 3; ++i) {
            Ray ray = good;
            ray.org[i] = x;
            CHECK(misses(ray));
            ray = good;
            ray.dir[i] = x;
            CHECK(misses(ray));
        }
        Ray ray = good;
        // NOLINTNEXTLINE(bugprone-narrowing-conversions): float from float, clang-tidy 14 is wrong
        ray.tMin = x == -kInfinityF ? kInfinityF : x;
        CHECK(misses(ray));
    }
    Ray zero = good;
    zero.dir = {0, 0, 0};
    CHECK(misses(zero));
    zero.dir = {-0.0f, 0, -0.0f};
    CHECK(misses(zero));
    const float sizes[] = {0, 1e-45f, 1e-38f, 1e-20f, 1, 1e20f, 3e38f};
    for (int i = 0; i < 20000; ++i) {
        const auto pick = [&] {
            return sizes[static_cast<std::size_t>(random.unit() * 7)] *
                   (random.coin() ? 1.0f : -1.0f);
        };
        const Ray ray{{pick(), pick(), pick()}, {pick(), pick(), pick()}};
        Hit hit;
        if (!shape->intersect(ray, hit)) continue;
        CHECK(hit.t > 0 && hit.t < kInfinityF);
        const Surface at = shape->surface(ray, hit);
        CHECK(at.p.x == at.p.x && at.p.y == at.p.y && at.p.z == at.p.z);
        CHECK_NEAR(length(toDouble(at.ng)), 1, 1e-6);
        CHECK(at.uv.x == at.uv.x && at.uv.y == at.uv.y && at.error == at.error);
    }
    // A map without inverse: nothing to hit.
    const auto flat = kind.make(Transform::scale(Vec3d{1, 0, 1}));
    Hit hit;
    CHECK(!flat->intersect(good, hit));
}

inline void checkShape(const std::string& name, std::uint64_t seed) {
    Random random(seed);
    const Kind kind = kindNamed(name);
    checkQueries(kind, random);
    checkSurfaces(kind, random);
    checkBounds(kind, random);
    checkMotion(kind, random);
    checkBadRays(kind, random);
}

// Rays from anywhere inside a closed shape, at its edges: every one gets out (T1 for solids).
inline long long leaks(const std::string& name, std::uint64_t seed, int rayCount) {
    Random random(seed);
    const Kind kind = kindNamed(name);
    long long missed = 0;
    Transform map;
    std::unique_ptr<Shape> shape;
    for (int i = 0; i < rayCount; ++i) {
        if (i % 1000 == 0) {
            map = randomMap(random);
            shape = kind.make(map);
        }
        Vec3d target = kind.rim(random);
        const double along = random.uniform(-1, 1);
        if (kind.name == "cube" && random.coin()) // any place on an edge
            target[static_cast<std::size_t>(random.unit() * 3)] = along;
        // Half-way to the middle at least, so that rounding to float leaves the origin inside.
        const double inwards = random.uniform(0, 0.25);
        const Vec3d from = kind.rim(random) * inwards + target * 0.25;
        const Ray ray = rayThrough(map.point(from), map.point(target));
        Hit hit;
        std::vector<Hit> all;
        shape->collect(ray, all);
        if (!shape->intersect(ray, hit) || all.size() != 1) ++missed;
    }
    return missed;
}

} // namespace kit
