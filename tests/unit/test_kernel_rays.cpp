// Kernels and rays that end at a hit, miss everything, or are none.
#include "base/text.h"
#include "kernel_checks.h"
#include "scene/merge.h"

#include <cmath>

namespace test_kernel_rays {

using namespace battery;
using namespace kernel_checks;
using meshes::Random;

// Rays of points that end where they hit, and a float in front of it or behind: bundles, and trees
// too small for them, know first only bounds of the key at the end of a ray.
TEST(kernels_on_rays_that_end_at_their_hits) {
    Random random(81);
    Counts counts;
    for (const std::size_t size : {1u, 2u, 4u, 5u, 12u, 17u, 300u}) {
        const Meshes meshes(meshes::geometryOf(meshes::soup(random, size), false));
        const Mesh oracle(meshes.scalar, {0}, {{0, 0}});
        const auto n = static_cast<std::size_t>(check::scaled(2000));
        const RayList all = raysFromPoints(random, meshes.scalar, n);
        RayList ending;
        for (std::size_t i = 0; i < n; ++i) {
            Ray ray = all.span()[i];
            Hit hit;
            if (oracle.intersect(ray, hit)) ray.tMax = hit.t;
            if (i % 3 == 1) ray.tMax = std::nextafter(ray.tMax, 0.0f);
            if (i % 3 == 2) ray.tMax = std::nextafter(ray.tMax, kInfinityF);
            ending.push(ray);
        }
        compare(meshes, ending, "ending at hits", counts);
    }
    std::printf("%zu rays, %zu hits, %zu hidden, seed 81\n", counts.rays, counts.hits,
                counts.hidden);
    CHECK(counts.hits > counts.hidden && counts.hidden > counts.rays / 10);
}

// Far smaller than the scene that they are in, so that products of their sides have no room below
// the smallest normal float: what is reckoned without errors elsewhere is nothing but error here.
TEST(kernels_on_triangles_of_almost_no_size) {
    Random random(82);
    Counts counts;
    for (int power = -20; power >= -76; power -= 8) { // t has no room below 2^-90
        const float size = std::ldexp(1.0f, power);
        std::vector<std::array<Vec3, 3>> triangles = meshes::soup(random, 40);
        const MeshGeometry large = meshes::geometryOf(triangles, false);
        for (auto& corners : triangles)
            for (Vec3& corner : corners) corner = corner * size;
        triangles.push_back({Vec3{1, 1, 1}, {2, 1, 1}, {1, 2, 1}});
        const Meshes meshes(meshes::geometryOf(triangles, false));
        const Mesh oracle(meshes.scalar, {0}, {{0, 0}});
        const auto n = static_cast<std::size_t>(check::scaled(500));
        for (const RayList& all : {looseRays(random, large, n), raysFromPoints(random, large, n),
                                   raysInBeams(random, large, n)}) {
            RayList rays, ending;
            for (std::size_t i = 0; i < all.size(); ++i) {
                Ray ray = all.span()[i];
                ray.org = ray.org * size;
                rays.push(ray);
                ray.dir = ray.dir * size;
                rays.push(ray);
                Hit hit;
                if (oracle.intersect(ray, hit)) ray.tMax = i % 2 == 0 ? hit.t : 0.9999f * hit.t;
                ending.push(ray);
            }
            compare(meshes, rays, cat("of size 2^", power), counts);
            compare(meshes, ending, cat("of size 2^", power, ", ending"), counts);
        }
    }
    std::printf("%zu rays, %zu hits, %zu hidden, seed 82\n", counts.rays, counts.hits,
                counts.hidden);
    CHECK(counts.hits > counts.rays / 10);
}

// Rays that leave the tree at its root, among some that don't: before the mesh, beside it, and
// through the hole of a ring, where they are in its box and in none of the root's children.
TEST(kernels_on_rays_that_miss) {
    Random random(79);
    Counts counts;
    const Meshes meshes(toGeometry(meshes::torus(0.1, 64, 24), {}));
    for (const double hits : {0.0, 0.01, 0.5}) {
        RayList loose, bundle;
        const auto n = static_cast<std::size_t>(check::scaled(4000));
        for (std::size_t i = 0; i < n; ++i) {
            const bool meets = random.unit() < hits;
            const Vec3d target = meets ? targetOn(random, meshes.scalar)
                                       : Vec3d{0.2 * random.unit(), 0.2 * random.unit(), 0};
            const Vec3d away{random.unit() - 0.5, random.unit() - 0.5, 9};
            const float end = i % 3 == 0 ? 1.5f : i % 3 == 1 ? 0.5f : kInfinityF;
            const Vec3 org = toFloat(target + away);
            const double turn = i % 5 == 0 && !meets ? 1 : -1; // 1: from the mesh away
            loose.push({org, toFloat(away * turn), i % 7 == 0 ? 0.99f : 0.0f, end});
            const Vec3 lamp{0, 0, 9};
            bundle.push({lamp, (toFloat(target) - lamp) * static_cast<float>(-turn), 0, end});
        }
        const std::size_t before = counts.hits;
        compare(meshes, loose, "missing", counts);
        compare(meshes, bundle, "missing bundles", counts);
        CHECK_INFO(hits == 0 ? counts.hits == before : counts.hits > before, hits);
    }
    std::printf("%zu rays, %zu hits, %zu hidden, seed 79\n", counts.rays, counts.hits,
                counts.hidden);
}

// Zero, infinite and NaN rays meet nothing, wherever in a batch they are.
TEST(kernels_skip_broken_rays) {
    Random random(73);
    Counts counts;
    const float nan = std::nanf(""), inf = kInfinityF;
    const Meshes meshes(toGeometry(meshes::icosphere(2), {}));
    const Ray broken[] = {{{0, 0, 3}, {0, 0, 0}},     {{0, 0, 3}, {0, 0, -inf}},
                          {{0, 0, 3}, {nan, 0, -1}},  {{nan, 0, 3}, {0, 0, -1}},
                          {{0, -inf, 3}, {0, 0, -1}}, {{0, 0, 3}, {0, 1e-35f, -1e-32f}},
                          {{1e35f, 0, 0}, {-1, 0, 0}}};
    RayList loose = looseRays(random, meshes.scalar, 300), bundle;
    for (const Ray& ray : broken) loose.push(ray);
    for (int i = 0; i < 300; ++i) {
        bundle.push({{0, 0, 3}, toFloat(targetOn(random, meshes.scalar)) - Vec3{0, 0, 3}});
        if (i % 50 == 7) bundle.push(broken[i / 50 % 3]);
    }
    compare(meshes, loose, "broken rays", counts);
    compare(meshes, bundle, "broken rays in a bundle", counts);
    for (const Vec3 org : {Vec3{nan, 0, 0}, Vec3{inf, 0, 0}, Vec3{0, 0, 1e36f}}) {
        RayList all;
        for (int i = 0; i < 100; ++i) all.push({org, toFloat(random.direction())});
        compare(meshes, all, "a broken origin", counts);
    }
}

} // namespace test_kernel_rays
