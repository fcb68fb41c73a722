#include "base/motion.h"
#include "check.h"

#include <random>

namespace test_motion {

namespace {

struct Draw {
    std::mt19937_64 engine{23}; // the seed of all tests here
    double uniform(double lo, double hi) {
        return lo + (hi - lo) * (static_cast<double>(engine() >> 11) * 0x1p-53);
    }
    Vec3d vector(double size) {
        return {uniform(-size, size), uniform(-size, size), uniform(-size, size)};
    }
    // Turned, stretched along any axes and moved; all mirror or none.
    Transform transform(bool mirrors) {
        const auto factor = [&] { return std::exp2(uniform(-3, 3)); };
        return Transform::translate(vector(10)) * Transform::rotate(vector(1), uniform(-7, 7)) *
               Transform::scale({mirrors ? -factor() : factor(), factor(), factor()}) *
               Transform::rotate(vector(1), uniform(-7, 7));
    }
};

double largestDifference(const Transform& a, const Transform& b) {
    double largest = 0;
    for (std::size_t i = 0; i < 12; ++i)
        largest = max(largest, std::fabs(a.rows()[i] - b.rows()[i]));
    return largest;
}

} // namespace

TEST(motion_static) {
    const Transform map = Transform::translate({1, 2, 3}) * Transform::rotate({1, 1, 0}, 0.3);
    CHECK(MovingTransform().isStatic());
    CHECK(MovingTransform().at(0.5).isIdentity());
    const std::vector<Transform> same(3, map);
    const MovingTransform still(same);
    CHECK(still.isStatic());
    CHECK(still.at(0.37) == map);
    CHECK(MovingTransform(map).at(0.7) == map);
    const BoundsD box{{0, 0, 0}, {1, 2, 3}};
    CHECK(still.bounds(box) == map.bounds(box));
    CHECK(MovingTransform(std::span<const Transform>{}).at(0.5).isIdentity());
}

TEST(motion_keys_are_met) {
    Draw draw;
    for (int i = 0; i < check::scaled(2000); ++i) {
        std::vector<Transform> keys;
        const std::size_t count = 2 + draw.engine() % 4;
        for (std::size_t k = 0; k < count; ++k) keys.push_back(draw.transform(i % 2));
        const MovingTransform moving(keys);
        CHECK(!moving.isStatic());
        for (std::size_t k = 0; k < count; ++k) {
            const double time = static_cast<double>(k) / static_cast<double>(count - 1);
            CHECK(moving.at(time) == keys[k]);
            // And the way there is continuous: a step of 1e-9 moves entries by at most 1e-9 times
            // the speed (turn pi, stretch 8, distance 20, 4 pieces).
            if (k > 0) CHECK(largestDifference(moving.at(time - 1e-9), keys[k]) < 4e-7);
            if (k + 1 < count) CHECK(largestDifference(moving.at(time + 1e-9), keys[k]) < 4e-7);
        }
        CHECK(moving.at(-1) == keys.front());
        CHECK(moving.at(2) == keys.back());
        CHECK(moving.at(std::nan("")) == keys.front());
    }
}

// A turn about a fixed axis by less than half a revolution, with a stretch and a translation that
// commute with nothing: R turns at constant speed, S and T move linearly.
TEST(motion_closed_form) {
    Draw draw;
    for (int i = 0; i < check::scaled(5000); ++i) {
        const Vec3d axis = draw.vector(1), t0 = draw.vector(10), t1 = draw.vector(10);
        const double start = draw.uniform(-3, 3), turn = draw.uniform(-3.1, 3.1);
        const Transform s0 = Transform::scale({1, 2, draw.uniform(0.5, 3)});
        const Transform s1 = Transform::scale({draw.uniform(0.5, 3), 1, 2});
        const double mirror = i % 2 ? -1 : 1; // all factors negative
        const auto pose = [&](Vec3d t, double angle, Vec3d s) {
            return Transform::translate(t) * Transform::rotate(axis, angle) *
                   Transform::scale(s * mirror);
        };
        const Vec3d d0{s0.rows()[0], s0.rows()[5], s0.rows()[10]};
        const Vec3d d1{s1.rows()[0], s1.rows()[5], s1.rows()[10]};
        const std::vector<Transform> keys{pose(t0, start, d0), pose(t1, start + turn, d1)};
        const MovingTransform moving(keys);
        for (const double time : {0.1, 0.25, 0.5, 0.9}) {
            const Transform expected =
                pose(lerp(t0, t1, time), start + time * turn, lerp(d0, d1, time));
            CHECK(largestDifference(moving.at(time), expected) < 1e-13);
        }
    }
}

// Pure translation: the linear part does not change by one bit.
TEST(motion_translation) {
    const Transform start = Transform::rotate({1, 2, 3}, 1) * Transform::scale({1, 2, 3});
    const std::vector<Transform> keys{start, Transform::translate({4, 0, -2}) * start};
    const MovingTransform moving(keys);
    const Transform half = moving.at(0.25);
    for (const std::size_t i : {0u, 1u, 2u, 4u, 5u, 6u, 8u, 9u, 10u})
        CHECK_EQUAL(half.rows()[i], start.rows()[i]);
    CHECK(half.translation() == (Vec3d{1, 0, -0.5}));
    CHECK(length(half.inverse().point(half.point({1, 2, 3})) - Vec3d{1, 2, 3}) < 1e-14);
    const BoundsD box{{-1, -1, -1}, {1, 1, 1}};
    const BoundsD hull = merge(keys[0].bounds(box), keys[1].bounds(box));
    CHECK(moving.bounds(box).contains(hull));
    CHECK(hull.padded(1e-12).contains(moving.bounds(box))); // as tight as can be
}

// What lanes follow: the offset of the inverse, to the last bit, at keys and between them.
TEST(motion_drift_is_the_inverse_of_at) {
    Draw draw;
    for (int n = 0; n < check::scaled(200); ++n) {
        std::vector<Transform> keys{draw.transform(n % 2 == 0)};
        for (int k = 0; k < 1 + n % 4; ++k)
            keys.push_back(Transform::translate(draw.vector(5)) * keys[0]);
        const MovingTransform moving(keys);
        const auto drift = moving.drift();
        CHECK(drift.has_value());
        if (!drift) continue;
        for (int k = -1; k < 40; ++k) {
            const double time = k < 9 ? k / 8.0 : draw.uniform(-0.1, 1.1);
            const AffineRows inverse = moving.at(time).inverseRows();
            CHECK_INFO((drift->offsetAt(time) == Vec3d{inverse[3], inverse[7], inverse[11]}),
                       "motion " << n << " time " << time);
        }
        keys.back() = keys.back() * Transform::rotate({0, 0, 1}, 0.1);
        CHECK(!MovingTransform(keys).drift());
        keys.back() = Transform::scale(0);
        CHECK(!MovingTransform(keys).drift());
    }
}

// No point at any time leaves the box: 2e5 random points, times and motions.
TEST(motion_bounds) {
    Draw draw;
    double largestRatio = 0;
    for (int i = 0; i < check::scaled(4000); ++i) {
        std::vector<Transform> keys;
        const std::size_t count = 2 + draw.engine() % 2;
        for (std::size_t k = 0; k < count; ++k)
            // Every fourth motion mixes mirrored keys with others.
            keys.push_back(draw.transform(i % 4 == 3 ? draw.engine() % 2 : i % 2));
        if (i % 5 == 0) // far from the origin of the object as well
            for (Transform& key : keys) key = key * Transform::translate({50, 0, 0});
        const MovingTransform moving(keys);
        BoundsD box;
        box.extend(draw.vector(2));
        box.extend(draw.vector(2));
        const BoundsD swept = moving.bounds(box);
        BoundsD seen;
        for (int k = 0; k < 50; ++k) {
            const double time = draw.uniform(0, 1);
            const Transform map = moving.at(time);
            // Corners are the extreme points; every other one is anywhere inside.
            Vec3d p = box.corner(static_cast<int>(draw.engine() % 8));
            if (k % 2) {
                const Vec3d d = box.size();
                const Vec3d s{draw.uniform(0, d.x), draw.uniform(0, d.y), draw.uniform(0, d.z)};
                p = box.lo + s;
            }
            CHECK_INFO(swept.contains(map.point(p)), "motion " << i << " time " << time);
        }
        if (i % 7 != 0) continue;
        for (int k = 0; k <= 200; ++k)
            for (int c = 0; c < 8; ++c) seen.extend(moving.at(k / 200.0).point(box.corner(c)));
        const double ratio = maxAbs(swept.size()) / maxAbs(seen.size());
        largestRatio = max(largestRatio, ratio);
    }
    // Not wasteful either.
    CHECK_INFO(largestRatio < 1.15, largestRatio);
}

// The bulge of a turning corner: a square that turns by more than pi/4 reaches its diagonal, at a
// time when no key and, for most of these angles, no piece of the proof ends.
TEST(motion_bounds_bulge) {
    for (const double angle : {kPi / 4, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4, kHalfPi}) {
        const std::vector<Transform> keys{Transform(), Transform::rotate({0, 0, 1}, angle)};
        const BoundsD swept = MovingTransform(keys).bounds({{-1, -1, 0}, {1, 1, 0}});
        CHECK_INFO(swept.hi.x >= std::sqrt(2.0), angle << ": " << swept.hi.x);
        CHECK(swept.hi.x < std::sqrt(2.0) * 1.006); // sagitta of pi/16: 0.5 %
    }
    const std::vector<Transform> keys{Transform(), Transform::rotate({0, 0, 1}, kHalfPi)};
    const BoundsD plane{{-kInfinity, -kInfinity, 0}, {kInfinity, kInfinity, 0}};
    CHECK(MovingTransform(keys).bounds(plane).lo.z == -kInfinity);
    CHECK(MovingTransform(keys).bounds(BoundsD{}).isEmpty());
}

// Singular keys (an object that shrinks to nothing) move linearly and never give NaN.
TEST(motion_singular_keys) {
    const std::vector<Transform> keys{Transform::scale(2), Transform::scale(0)};
    const MovingTransform moving(keys);
    CHECK(largestDifference(moving.at(0.75), Transform::scale(0.5)) < 1e-15);
    CHECK(moving.bounds({{-1, -1, -1}, {1, 1, 1}}).contains(Vec3d{2, 2, 2}));
}

} // namespace test_motion
