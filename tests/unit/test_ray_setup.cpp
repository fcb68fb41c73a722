// The slabs of RaySetup against slabs in long double: never a false miss, monotone, and not wide.
#include "accel/ray_setup.h"
#include "check.h"
#include "verify/meshes.h"

namespace test_ray_setup {

using meshes::Random;

namespace {

struct Exact {
    bool hit = false;
    long double entry = 0; // in z
};

// The box against the ray with the direction as given, closed at all sides.
Exact slabs(Vec3 org, Vec3 dir, const Bounds& box, float grownBy) {
    const std::size_t k =
        std::fabs(dir.z) >= std::fabs(dir.x) && std::fabs(dir.z) >= std::fabs(dir.y) ? 2
        : std::fabs(dir.y) >= std::fabs(dir.x)                                       ? 1
                                                                                     : 0;
    long double entry = 0, exit = INFINITY;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const long double d = dir[axis], o = org[axis];
        const long double lo = static_cast<long double>(box.lo[axis]) - grownBy;
        const long double hi = static_cast<long double>(box.hi[axis]) + grownBy;
        if (d == 0) {
            if (o < lo || o > hi) return {};
            continue;
        }
        const long double a = (lo - o) / d, b = (hi - o) / d;
        entry = std::fmax(entry, std::fmin(a, b));
        exit = std::fmin(exit, std::fmax(a, b));
    }
    return {entry <= exit, entry * std::fabs(static_cast<long double>(dir[k]))};
}

float planeValue(Random& random) { // often equal to others
    return random.chance(0.4) ? static_cast<float>(random.below(9)) * 0.25f - 1
                              : static_cast<float>(random.uniform(-1, 1));
}

Bounds someBox(Random& random) {
    Bounds box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        float a = planeValue(random), b = planeValue(random);
        if (random.chance(0.25)) b = a; // flat
        if (random.chance(0.1)) b = meshes::stepped(a, 1);
        box.lo[axis] = min(a, b), box.hi[axis] = max(a, b);
    }
    return box;
}

Vec3 someOrigin(Random& random, const Bounds& box) {
    Vec3 org = random.chance(0.1) ? toFloat(random.inBox(1000)) : toFloat(random.inBox(2));
    for (std::size_t axis = 0; axis < 3; ++axis) { // on a plane, or next to it
        if (random.chance(0.25))
            org[axis] = meshes::stepped(random.chance(0.5) ? box.lo[axis] : box.hi[axis],
                                        static_cast<int>(random.below(3)) - 1);
    }
    return org;
}

Vec3 someDirection(Random& random, Vec3 org, const Bounds& box) {
    Vec3 d = toFloat(random.direction());
    if (random.chance(0.7)) { // at a corner, an edge or a face
        Vec3 aim;
        for (std::size_t axis = 0; axis < 3; ++axis)
            aim[axis] = random.chance(0.3) ? box.lo[axis]
                        : random.chance(0.5)
                            ? box.hi[axis]
                            : lerp(box.lo[axis], box.hi[axis], static_cast<float>(random.unit()));
        d = aim - org;
    }
    if (random.chance(0.3)) d[random.below(3)] = random.chance(0.5) ? 0.0f : -0.0f;
    if (random.chance(0.2)) d[random.below(3)] = random.chance(0.5) ? 0.0f : 1e-25f;
    if (random.chance(0.2)) d = d * static_cast<float>(random.logUniform(1e-6, 1e6));
    return d;
}

} // namespace

TEST(ray_setup_axes) {
    const RaySetup a({}, {1, 2, -3}, 1), b({}, {1, -3, 3}, 1), c({}, {-4, 2, 3}, 1);
    CHECK(a.k == 2 && a.kx == 0 && a.ky == 1 && a.sign == -1 && a.dz == 3);
    CHECK(b.k == 2 && b.sign == 1); // ties: z, then y
    CHECK(c.k == 0 && c.kx == 1 && c.ky == 2 && c.sign == -1 && c.dz == 4);
    CHECK_EQUAL(c.Sx, 0.5f);
    CHECK_EQUAL(c.Sy, 0.75f);
    CHECK_EQUAL(RaySetup({}, {3, 3, 1}, 1).k, 1u);
}

TEST(ray_setup_never_misses_a_box) {
    Random random(21);
    long long falseMisses = 0, late = 0, wide = 0, hits = 0, count = 0;
    for (int i = 0; i < check::scaled(1500000); ++i) {
        const Bounds box = someBox(random);
        const Vec3 org = someOrigin(random, box), dir = someDirection(random, org, box);
        if (!isTraceable({org, dir})) continue;
        ++count;
        const RaySetup setup(org, dir, 1);
        const Exact exact = slabs(org, dir, box, 0);
        float z = -1;
        const bool enters = setup.enters(box, kInfinityF, z);
        if (exact.hit) {
            ++hits;
            if (!enters) {
                if (++falseMisses <= 3)
                    CHECK_INFO(enters, "seed 21 case " << i << " org " << org.x << ' ' << org.y
                                                       << ' ' << org.z << " dir " << dir.x << ' '
                                                       << dir.y << ' ' << dir.z);
            } else if (!(static_cast<long double>(z) <= exact.entry))
                ++late;
        }
        // The pad is 2 e on each axis, plus rounding: a box grown by 3 e covers what is entered.
        const float e = max(1.0f, maxAbs(org)) * 0x1p-19f;
        if (enters && !slabs(org, dir, box, 3 * e).hit) {
            // Slopes below 1e-18 are raised to it: they move the ray by nothing in this space.
            ++wide;
        }
    }
    std::printf("%lld rays, %lld hits, %lld false misses, %lld late, %lld wide\n", count, hits,
                falseMisses, late, wide);
    CHECK(hits > 300000);
    CHECK_EQUAL(falseMisses, 0);
    CHECK_EQUAL(late, 0);
    CHECK_EQUAL(wide, 0);
}

// To the last bit: what a box inside another enters, the outer one enters, and not later. So
// culling by any ancestor removes nothing that culling by the box itself would keep.
TEST(ray_setup_is_monotone) {
    Random random(22);
    long long broken = 0, entered = 0;
    for (int i = 0; i < check::scaled(1000000); ++i) {
        const Bounds inner = someBox(random);
        Bounds outer = inner;
        for (int k = 0; k < 3; ++k) {
            const std::size_t axis = random.below(3);
            const int ulps = static_cast<int>(random.below(4));
            if (random.chance(0.5)) outer.lo[axis] = meshes::stepped(outer.lo[axis], -ulps);
            if (random.chance(0.5)) outer.hi[axis] = meshes::stepped(outer.hi[axis], ulps);
            if (random.chance(0.2)) outer.extend(someBox(random));
        }
        const Vec3 org = someOrigin(random, inner), dir = someDirection(random, org, inner);
        if (!isTraceable({org, dir})) continue;
        const RaySetup setup(org, dir, 1);
        const float cut =
            random.chance(0.5) ? kInfinityF : static_cast<float>(random.uniform(0, 2));
        float zInner = 0, zOuter = 0;
        if (!setup.enters(inner, cut, zInner)) continue;
        ++entered;
        if (!setup.enters(outer, cut, zOuter) || !(zOuter <= zInner)) ++broken;
        // The cut is closed: a box that starts right at it is entered, one float nearer is not.
        if (!setup.enters(inner, zInner, zOuter) || zOuter != zInner) ++broken;
        if (zInner > 0 && setup.enters(inner, nextDown(zInner), zOuter)) ++broken;
    }
    std::printf("%lld entered, seed 22\n", entered);
    CHECK(entered > 200000);
    CHECK_EQUAL(broken, 0);
}

TEST(ray_setup_what_is_traceable) {
    const float nan = std::nanf(""), inf = kInfinityF;
    CHECK(isTraceable({{1, 2, 3}, {0, 0, 1e-10f}}));
    CHECK(isTraceable({{-1e5f, 2, 3}, {1e5f, -0.0f, 0}}));
    for (const Vec3 bad : {Vec3{0, 0, 0}, Vec3{nan, 1, 0}, Vec3{0, nan, 1}, Vec3{1, 0, nan},
                           Vec3{inf, 0, 0}, Vec3{1, -inf, 0}, Vec3{inf, -inf, 1}})
        CHECK_INFO(!isTraceable({{}, bad}), bad.x << ' ' << bad.y << ' ' << bad.z);
    for (const Vec3 bad : {Vec3{nan, 1, 0}, Vec3{0, nan, 1}, Vec3{1, 0, nan}, Vec3{inf, 0, 0},
                           Vec3{1, -inf, 0}, Vec3{0, 0, inf}})
        CHECK_INFO(!isTraceable({bad, {1, 0, 0}}), bad.x << ' ' << bad.y << ' ' << bad.z);
}

// A triangle at depth 1/key is never cut: 1 / key loses half an ulp twice, the cut adds 8 u.
TEST(ray_setup_depth_cut) {
    Random random(23);
    for (int i = 0; i < check::scaled(100000); ++i) {
        const float key = static_cast<float>(random.logUniform(1e-6, 1e6));
        const long double z = 1.0L / static_cast<long double>(key);
        const long double excess = static_cast<long double>(depthCut(key)) / z - 1;
        CHECK_INFO(excess > 6 * 0x1p-24L && excess < 11 * 0x1p-24L, key);
    }
    CHECK(depthCut(0) > 1e38f && depthCut(kInfinityF) == 0);
}

} // namespace test_ray_setup
