// The nearest, any and all triangles by the plain tree against brute force on hostile triangles.
#include "accel/triangle.h"
#include "check.h"
#include "verify/meshes.h"

#include <algorithm>

namespace test_triangle_tree {

using meshes::Random;

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
        CHECK(withTree.hasTree() && !without.hasTree());
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

} // namespace test_triangle_tree
