// The canonical triangle hit: against integers where it must be exact, against long double where it
// rounds, and the tree against brute force on the soup of CANONICAL.md.
#include "accel/triangle.h"
#include "check.h"
#include "shown_triangle.h"
#include "verify/meshes.h"

#include <algorithm>

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

// Two triangles with a common edge, aimed at it within a few ulp: one of them is hit at least, the
// other edges being far away. Scales and places at random; the two list their corners in any order.
TEST(triangle_shared_edges_are_closed) {
    Random random(32);
    long long leaks = 0, both = 0, count = 0;
    for (int i = 0; i < check::scaled(400000); ++i) {
        const double size = random.logUniform(1e-4, 1);
        const Vec3d shift = random.chance(0.5) ? random.inBox(1) : Vec3d{};
        const auto corner = [&](Vec3d p) { return toFloat(shift + p * size); };
        const Vec3d a = random.inBox(1), b = random.inBox(1);
        const Vec3d along = b - a, view = random.direction();
        const Vec3d side = cross(along, view);
        if (length(side) < 0.02) continue; // edge-on
        const Vec3d lateral = normalize(side);
        const Vec3d middle = lerp(a, b, random.uniform(0.2, 0.8));
        const Vec3 A = corner(a), B = corner(b);
        const Vec3 C =
            corner(middle + lateral * random.uniform(0.5, 2) + view * random.uniform(-1, 1));
        const Vec3 D =
            corner(middle - lateral * random.uniform(0.5, 2) + view * random.uniform(-1, 1));
        Vec3 aim = toFloat(lerp(toDouble(A), toDouble(B), random.uniform(0.25, 0.75)));
        for (std::size_t k = 0; k < 3; ++k)
            aim[k] = meshes::stepped(aim[k], static_cast<int>(random.below(7)) - 3);
        const Vec3 org = corner(middle - view * random.uniform(4, 40));
        const Vec3 dir = random.chance(0.5) ? aim - org : toFloat(normalize(toDouble(aim - org)));
        const RaySetup setup(org, dir, 4);
        const auto rotated = [&](Vec3 p, Vec3 q, Vec3 r) {
            switch (random.below(6)) {
            case 0: return canonicalKey(setup, p, q, r);
            case 1: return canonicalKey(setup, q, r, p);
            case 2: return canonicalKey(setup, r, p, q);
            case 3: return canonicalKey(setup, q, p, r);
            case 4: return canonicalKey(setup, r, q, p);
            default: return canonicalKey(setup, p, r, q);
            }
        };
        const float left = rotated(A, B, C), right = rotated(B, A, D);
        ++count;
        if (left > 0 && right > 0) ++both;
        if (!(left > 0) && !(right > 0) && ++leaks <= 3)
            CHECK_INFO(false, "seed 32 case " << i << ' ' << shown({A, B, C}, org, dir) << D.x);
    }
    std::printf("%lld rays, %lld hit both, seed 32\n", count, both);
    CHECK(count > 300000);
    CHECK_EQUAL(leaks, 0);
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

// Of the triangles around an edge or a corner exactly one is met by a ray at it: in a plane of
// triangles with whole coordinates, and so that rays through a closed mesh enter as often as they
// leave.
TEST(triangle_one_hit_per_crossing) {
    Random random(35);
    std::vector<std::array<Vec3, 3>> plane;
    for (int x = -4; x < 4; ++x) {
        for (int y = -4; y < 4; ++y) {
            const auto at = [](int i, int j) { // z is any plane that floats can hold
                return Vec3{static_cast<float>(i), static_cast<float>(j),
                            static_cast<float>(2 * i - j)};
            };
            const Vec3 a = at(x, y), b = at(x + 1, y), c = at(x + 1, y + 1), d = at(x, y + 1);
            if (random.chance(0.5))
                plane.insert(plane.end(), {{a, b, c}, {c, d, a}});
            else
                plane.insert(plane.end(), {{a, b, d}, {b, c, d}});
        }
    }
    long long wrong = 0, shared = 0;
    const int count = check::scaled(20000);
    for (int i = 0; i < count; ++i) {
        // Aims in the middle, on a grid of halves: at corners, edges, and centres.
        const float x = static_cast<float>(random.below(9)) * 0.5f - 2;
        const float y = static_cast<float>(random.below(9)) * 0.5f - 2;
        const Vec3 dir{static_cast<float>(random.below(5)) - 2,
                       static_cast<float>(random.below(5)) - 2,
                       random.chance(0.5) ? 16.0f : -16.0f};
        const Vec3 org = Vec3{x, y, 2 * x - y} - dir * 2.0f;
        const RaySetup setup(org, dir, 64);
        int touched = 0, met = 0;
        for (const auto& t : plane) {
            const Vec3d e = ShearedTriangle(setup, t[0], t[1], t[2]).edgesExact();
            touched += (e.x >= 0 && e.y >= 0 && e.z >= 0) || (e.x <= 0 && e.y <= 0 && e.z <= 0);
            met += canonicalKey(setup, t[0], t[1], t[2]) > 0;
        }
        shared += touched > 1;
        if (touched < 1 || met != 1) ++wrong;
    }
    std::printf("%lld of %d rays touch several triangles, seed 35\n", shared, count);
    CHECK(shared > 5000);
    CHECK_EQUAL(wrong, 0);

    long long unbalanced = 0, crossings = 0;
    for (const MeshDesc& desc :
         {meshes::icosphere(2), meshes::torus(0.3, 24, 12), meshes::cube()}) {
        const MeshGeometry g = toGeometry(desc, {});
        for (int i = 0; i < check::scaled(3000); ++i) {
            const Vec3 org = toFloat(random.direction() * 4.0);
            const auto& c = g.triangles[random.below(g.triangles.size())];
            const Vec3 a = g.points[c[0]], b = g.points[c[1]];
            const Vec3 dir = (random.chance(0.5) ? a : a + (b - a) * 0.5f) - org;
            const RaySetup setup(org, dir, g.extent);
            int balance = 0;
            for (const auto& t : g.triangles) {
                const Vec3 p = g.points[t[0]], q = g.points[t[1]], r = g.points[t[2]];
                const ShearedTriangle sheared(setup, p, q, r);
                if (!(canonicalKey(setup, p, q, r) > 0)) continue;
                const Vec3d e = sheared.edgesExact();
                balance += e.x + e.y + e.z > 0 ? 1 : -1;
                ++crossings;
            }
            if (balance != 0) ++unbalanced;
        }
    }
    CHECK(crossings > 10000);
    CHECK_EQUAL(unbalanced, 0);
}

namespace {

// Origins in, on and near the soup; aims at corners, edges and insides; zero components.
Ray adversarialRay(Random& random, const std::vector<std::array<Vec3, 3>>& soup) {
    const auto on = [&](const std::array<Vec3, 3>& t) {
        const Vec3d a = toDouble(t[0]), b = toDouble(t[1]), c = toDouble(t[2]);
        switch (random.below(5)) {
        case 0: return a;
        case 1: return lerp(a, b, random.unit());
        case 2: return lerp(b, c, random.uniform(-0.5, 1.5)); // on the edge's continuation too
        default: return lerp(lerp(a, b, random.unit()), c, random.unit());
        }
    };
    const auto& t = soup[random.below(soup.size())];
    Vec3d from;
    switch (random.below(5)) {
    case 0: from = random.direction() * 4.0; break;
    case 1: from = random.inBox(1); break;
    case 2: from = on(soup[random.below(soup.size())]); break;
    case 3: from = on(soup[random.below(soup.size())]) + random.direction() * 1e-6; break;
    default: from = on(t); break; // along its own plane
    }
    Vec3d to = on(t);
    if (random.chance(0.2)) to += random.direction() * 1e-6;
    Ray ray;
    ray.org = toFloat(from);
    ray.dir = toFloat(to) - ray.org;
    if (random.chance(0.3)) ray.dir = toFloat(random.direction());
    if (random.chance(0.2)) ray.dir[random.below(3)] = random.chance(0.5) ? 0.0f : -0.0f;
    if (random.chance(0.5) && maxAbs(ray.dir) > 0) ray.dir = normalize(ray.dir);
    return ray;
}

bool byPrim(const Hit& a, const Hit& b) { return a.prim < b.prim; }

} // namespace

TEST(triangle_tree_equals_brute_force) {
    long long rays = 0, hits = 0, closestWrong = 0, anyWrong = 0, collectWrong = 0, self = 0;
    for (std::uint64_t seed = 1; seed <= check::scaled(8u); ++seed) {
        Random random(3400 + seed);
        const auto triangles = meshes::soup(random, 150);
        const MeshGeometry withTree = meshes::geometryOf(triangles, true);
        const MeshGeometry without = meshes::geometryOf(triangles, false);
        CHECK(!withTree.bvh.nodes.empty() && without.bvh.nodes.empty());
        const Mesh tree(withTree, {0}, {{0, 0}});
        const Mesh all(without, {0}, {{0, 0}});
        for (int i = 0; i < 28000; ++i) {
            Ray ray = adversarialRay(random, triangles);
            if (random.chance(0.3)) ray.tMax = static_cast<float>(random.logUniform(0.01, 2));
            if (random.chance(0.1)) ray.tMin = static_cast<float>(random.logUniform(0.01, 1));
            ++rays;
            Hit fromTree, fromAll;
            fromTree.t = fromAll.t = ray.tMax;
            const bool found = tree.intersect(ray, fromTree);
            // Brute force, written out again.
            Hit best;
            best.t = ray.tMax;
            bool exists = false, inFront = false;
            std::vector<Hit> inRange;
            if (isTraceable(ray)) {
                const RaySetup setup(ray.org, ray.dir, without.extent);
                float bestKey = 0;
                for (std::uint32_t n = 0; n < triangles.size(); ++n) {
                    const float key =
                        canonicalKey(setup, triangles[n][0], triangles[n][1], triangles[n][2]);
                    if (!(key > 0) || !(key < 1.0f / (ray.tMin * setup.dz))) continue;
                    if (key > 1.0f / (ray.tMax * setup.dz)) {
                        inFront = true;
                        inRange.push_back({.t = 1.0f / (key * setup.dz), .prim = n});
                    }
                    if (key > bestKey) {
                        bestKey = key;
                        best.prim = n;
                    }
                }
                const float t = 1.0f / (bestKey * setup.dz);
                exists = bestKey > 0 && t <= ray.tMax;
                if (exists) best.t = t;
            }
            hits += exists;
            bool same =
                found == exists && (!found || (fromTree.t == best.t && fromTree.prim == best.prim));
            bool sameAny = tree.occludes(ray) == inFront;
            if (i % 4 == 0) { // and the mesh without a tree
                all.intersect(ray, fromAll);
                same = same && fromTree == fromAll;
                sameAny = sameAny && all.occludes(ray) == inFront;
            }
            if (!same && ++closestWrong <= 3)
                CHECK_INFO(false, "seed " << 3400 + seed << " ray " << i << " tree " << fromTree.t
                                          << ' ' << fromTree.prim << " brute " << best.t << ' '
                                          << best.prim);
            if (!sameAny) ++anyWrong;
            // The set of all hits that own the ray, in the order of their numbers, with t.
            std::vector<Hit> a;
            tree.collect(ray, a);
            std::sort(a.begin(), a.end(), byPrim);
            bool sameSet = a.size() == inRange.size();
            for (std::size_t k = 0; sameSet && k < a.size(); ++k)
                sameSet = a[k].t == inRange[k].t && a[k].prim == inRange[k].prim;
            if (!sameSet) ++collectWrong;
            for (const Hit& hit : a) self += !(hit.t > 0);
        }
    }
    std::printf("%lld rays, %lld hits, seeds 3401 to %u\n", rays, hits, 3400 + check::scaled(8u));
    CHECK(rays >= 200000 && hits > 80000);
    CHECK_EQUAL(closestWrong, 0);
    CHECK_EQUAL(anyWrong, 0);
    CHECK_EQUAL(collectWrong, 0);
    CHECK_EQUAL(self, 0);
}
