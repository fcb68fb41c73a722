// Edges and corners that triangles share: a ray at one passes none by and meets no two.
#include "accel/triangle.h"
#include "check.h"
#include "shown_triangle.h"
#include "verify/meshes.h"

namespace test_triangle_borders {

using meshes::Random;

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

} // namespace test_triangle_borders
