// The canonical hit of a ray and a triangle: against integers where it must be exact, against long
// double where it rounds.
#include "accel/triangle.h"
#include "check.h"
#include "shown_triangle.h"
#include "verify/meshes.h"

namespace test_triangle {

using meshes::Random;

namespace {

using Int3 = std::array<std::int64_t, 3>;
__extension__ using Wide = __int128;

// What integers say. Directions have +-16 on the dominant axis, so slopes and sheared coordinates
// have no error in float, and the hit is decided without rounding.
struct Oracle {
    bool inside = false;       // moved by (2^-20, 2^-40) the ray is strictly inside
    long double z = 0;         // depth of the plane
    long double condition = 1; // how much relative error of the terms grows in z
};

Oracle oracle(const std::array<Int3, 3>& v, const Int3& org, const Int3& dir, const RaySetup& s) {
    Oracle out;
    std::int64_t x[3], y[3];
    Int3 local[3];
    const std::int64_t sign = dir[s.k] < 0 ? -1 : 1;
    for (std::size_t i = 0; i < 3; ++i) {
        local[i] = {v[i][s.kx] - org[s.kx], v[i][s.ky] - org[s.ky], sign * (v[i][s.k] - org[s.k])};
        x[i] = 16 * local[i][0] - dir[s.kx] * local[i][2];
        y[i] = 16 * local[i][1] - dir[s.ky] * local[i][2];
    }
    // Coordinates are below 2^14: such a move changes no sign of an edge function but zero, and its
    // two parts stay apart.
    const auto edge = [&](int a, int b) {
        constexpr Wide kOne = Wide(1) << 40;
        const auto movedX = [&](int i) { return x[i] * kOne - (kOne >> 20); };
        const auto movedY = [&](int i) { return y[i] * kOne - 1; };
        return movedX(a) * movedY(b) - movedY(a) * movedX(b);
    };
    const Wide e[3] = {edge(2, 1), edge(0, 2), edge(1, 0)};
    out.inside = (e[0] > 0 && e[1] > 0 && e[2] > 0) || (e[0] < 0 && e[1] < 0 && e[2] < 0);
    if (!out.inside) return out;
    // z = n.v0 / (n.S) with S = (dir_kx, dir_ky, 16) / 16.
    Int3 n;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = (local[1][j] - local[0][j]) * (local[2][k] - local[0][k]) -
               (local[1][k] - local[0][k]) * (local[2][j] - local[0][j]);
    }
    const Int3 slope = {dir[s.kx], dir[s.ky], 16};
    std::int64_t N = 0, D = 0, sizeN = 0, sizeD = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        N += n[i] * local[0][i], sizeN += std::abs(n[i] * local[0][i]);
        D += n[i] * slope[i], sizeD += std::abs(n[i] * slope[i]);
    }
    out.z = 16 * static_cast<long double>(N) / static_cast<long double>(D);
    if (N != 0)
        out.condition = static_cast<long double>(sizeN) / static_cast<long double>(std::abs(N)) +
                        static_cast<long double>(sizeD) / static_cast<long double>(std::abs(D));
    return out;
}

Vec3 toVec(const Int3& v) {
    return {static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2])};
}

} // namespace

TEST(triangle_against_integers) {
    Random random(31);
    long long inside = 0, onEdge = 0, wrong = 0, farOff = 0, throughOrigin = 0;
    for (int i = 0; i < check::scaled(1000000); ++i) {
        const std::int64_t size = random.chance(0.5) ? 4 : 100; // small: many rays meet edges
        const auto number = [&] {
            return static_cast<std::int64_t>(random.below(static_cast<std::size_t>(2 * size + 1))) -
                   size;
        };
        const auto corner = [&] { return Int3{number(), number(), number()}; };
        std::array<Int3, 3> v = {corner(), corner(), corner()};
        const Int3 org = corner();
        Int3 dir;
        for (auto& d : dir) d = static_cast<std::int64_t>(random.below(33)) - 16;
        dir[random.below(3)] = random.chance(0.5) ? 16 : -16;
        const auto step = static_cast<std::int64_t>(random.below(9));
        if (random.chance(0.3)) // the ray goes through a corner
            for (std::size_t a = 0; a < 3; ++a) v[0][a] = org[a] + dir[a] * step;
        const std::array<Vec3, 3> t = {toVec(v[0]), toVec(v[1]), toVec(v[2])};
        const Vec3 o = toVec(org), d = toVec(dir);
        const RaySetup setup(o, d, 256);
        const Oracle exact = oracle(v, org, dir, setup);
        const float key = canonicalKey(setup, t[0], t[1], t[2]);
        const ShearedTriangle sheared(setup, t[0], t[1], t[2]);
        const Vec3d e = sheared.edgesExact();
        if (sheared.containsRay() != exact.inside) {
            if (++wrong <= 3) CHECK_INFO(false, "seed 31: " << shown(t, o, d));
            continue;
        }
        if (!exact.inside) {
            if (key != 0) ++wrong;
            continue;
        }
        ++inside;
        if (e.x == 0 || e.y == 0 || e.z == 0) ++onEdge;
        if (exact.z == 0) { // the origin is on the triangle: not in front of it
            ++throughOrigin;
            if (key != 0 && key < 1e4f)
                ++wrong; // t = 0, or so near that tMin = 0 alone excludes it
            continue;
        }
        if ((key > 0) != (exact.z > 0)) {
            if (++wrong <= 3)
                CHECK_INFO(false, "seed 31: z " << static_cast<double>(exact.z) << " key " << key
                                                << ' ' << shown(t, o, d));
            continue;
        }
        if (exact.z < 0) continue;
        // Ten roundings from the plane; the entry into the triangle's own box ends it 2^-19 sooner.
        const long double error = std::fabs(1 / (static_cast<long double>(key) * exact.z) - 1);
        if (error > 10 * 0x1p-24L * exact.condition) ++farOff;
    }
    std::printf("%lld inside, %lld of them on an edge, %lld from the origin, seed 31\n", inside,
                onEdge, throughOrigin);
    CHECK(inside > 100000 && onEdge > 50000);
    CHECK_EQUAL(wrong, 0);
    CHECK_EQUAL(farOff, 0);
}

// Random floats: where the edge functions in long double are clear of rounding, so is the decision;
// and the depth is that of the plane within the bound of ten roundings.
TEST(triangle_against_long_double) {
    Random random(33);
    long long clear = 0, wrong = 0, farOff = 0, hits = 0;
    for (int i = 0; i < check::scaled(500000); ++i) {
        std::array<Vec3, 3> t;
        const double size = random.logUniform(1e-3, 2);
        const Vec3d at = random.inBox(1);
        for (Vec3& v : t) v = toFloat(at + random.inBox(size));
        const Vec3 org = toFloat(random.inBox(2));
        const Vec3 dir = toFloat(at + random.inBox(size)) - org;
        const RaySetup s(org, dir, 2);
        long double x[3], y[3], z[3], reach = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto local = [&](std::size_t axis) {
                return static_cast<long double>(t[k][axis]) - static_cast<long double>(org[axis]);
            };
            z[k] = local(s.k) * s.sign;
            const long double dz = std::fabs(static_cast<long double>(dir[s.k]));
            x[k] = local(s.kx) - dir[s.kx] / dz * z[k];
            y[k] = local(s.ky) - dir[s.ky] / dz * z[k];
            reach = std::fmax(reach, std::fmax(std::fabs(local(s.kx)), std::fabs(local(s.ky))) +
                                         std::fabs(z[k]));
        }
        const long double e[3] = {x[2] * y[1] - y[2] * x[1], x[0] * y[2] - y[0] * x[2],
                                  x[1] * y[0] - y[1] * x[0]};
        // Each sheared coordinate is off by at most 4 u reach: 8 u reach (|x|+|y|) per function.
        long double slack = 0;
        for (std::size_t k = 0; k < 3; ++k)
            slack = std::fmax(slack, std::fabs(x[k]) + std::fabs(y[k]));
        slack *= 20 * 0x1p-24L * reach;
        bool isClear = true, inside = true, flipped = true;
        for (const long double edge : e) {
            if (std::fabs(edge) < slack) isClear = false;
            if (edge < 0) inside = false;
            if (edge > 0) flipped = false;
        }
        const long double sum = e[0] + e[1] + e[2];
        const long double depth = (e[0] * z[0] + e[1] * z[1] + e[2] * z[2]) / sum;
        const long double zMin = std::fmin(z[0], std::fmin(z[1], z[2]));
        if (!isClear || zMin < 1e-3L) continue; // in front, not across the origin
        ++clear;
        const float key = canonicalKey(s, t[0], t[1], t[2]);
        if ((key > 0) != (inside || flipped)) {
            if (++wrong <= 3) CHECK_INFO(false, "seed 33 " << shown(t, org, dir));
            continue;
        }
        if (key == 0) continue;
        ++hits;
        // A lateral error of 4 u reach is a depth error of that times the slope of the plane, which
        // is at most (range of z) / (height of the projected triangle).
        const long double zMax = std::fmax(z[0], std::fmax(z[1], z[2]));
        long double longest = 0;
        for (std::size_t k = 0; k < 3; ++k)
            longest = std::fmax(longest, std::hypot(x[k] - x[(k + 1) % 3], y[k] - y[(k + 1) % 3]));
        const long double height = std::fabs(sum) / longest;
        const long double bound = 16 * 0x1p-24L * reach * (1 + (zMax - zMin + longest) / height);
        if (std::fabs(1 / static_cast<long double>(key) - depth) > bound && ++farOff <= 3)
            CHECK_INFO(false, "seed 33 " << shown(t, org, dir) << " depth "
                                         << static_cast<double>(depth) << " key " << 1 / key
                                         << " bound " << static_cast<double>(bound));
    }
    std::printf("%lld clear, %lld hits, seed 33\n", clear, hits);
    CHECK(clear > 300000 && hits > 30000);
    CHECK_EQUAL(wrong, 0);
    CHECK_EQUAL(farOff, 0);
}

} // namespace test_triangle
