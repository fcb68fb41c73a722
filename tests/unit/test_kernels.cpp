// Kernels on meshes of every kind: hostile triangles, closed meshes, tiny ones, such as bundles
// have a hard time with.
#include "accel/triangle.h"
#include "kernel_checks.h"
#include "scene/merge.h"

#include <cmath>

namespace test_kernels {

using namespace battery;
using namespace kernel_checks;
using meshes::Random;

TEST(kernels_on_hostile_triangles) {
    Random random(71);
    Counts counts;
    for (int round = 0; round < 6; ++round) {
        const std::size_t size[] = {1, 2, 17, 100, 700, 2000};
        const Meshes meshes(meshes::geometryOf(meshes::soup(random, size[round]), false));
        const auto n = static_cast<std::size_t>(check::scaled(round < 3 ? 500 : 3000));
        compare(meshes, looseRays(random, meshes.scalar, n), "soup", counts);
        compare(meshes, raysFromPoints(random, meshes.scalar, n), "soup from points", counts);
    }
    std::printf("%zu rays, %zu hits, %zu hidden, seed 71\n", counts.rays, counts.hits,
                counts.hidden);
    CHECK(counts.hits > counts.rays / 2 && counts.hits < counts.rays);
}

TEST(kernels_on_closed_meshes) {
    Random random(72);
    Counts counts;
    for (const MeshDesc& desc : {meshes::cube(), meshes::icosphere(4), meshes::torus(0.3, 48, 24),
                                 meshes::doubleFan(40)}) {
        const Meshes meshes(toGeometry(desc, {}));
        const auto n = static_cast<std::size_t>(check::scaled(3000));
        compare(meshes, looseRays(random, meshes.scalar, n), "mesh", counts);
        compare(meshes, raysFromPoints(random, meshes.scalar, n), "mesh from points", counts);
    }
    std::printf("%zu rays, %zu hits, %zu hidden, seed 72\n", counts.rays, counts.hits,
                counts.hidden);
}

TEST(kernels_on_edge_on_triangles) {
    Random random(77);
    Counts counts;
    for (int round = 0; round < 4; ++round) {
        const Meshes meshes(meshes::geometryOf(meshes::soup(random, 50), false));
        const auto n = static_cast<std::size_t>(check::scaled(8000));
        const RayList rays = raysInPlanes(random, meshes.scalar, n);
        compare(meshes, rays, "in the plane", counts);
    }
    std::printf("%zu rays, %zu hits, %zu hidden, seed 77\n", counts.rays, counts.hits,
                counts.hidden);
}

// Rays that pass a triangle by a rounding while the points that they have in common are all behind
// their origin, and that meet its plane in front: that is no hit of any kernel.
TEST(kernels_on_edge_on_triangles_behind_rays) {
    Random random(83);
    Counts counts;
    int found = 0;
    for (int i = 0; i < check::scaled(150000); ++i) {
        const Vec3d a = random.inBox(1), e = random.direction(), f = random.direction();
        const Vec3d n = normalize(cross(e, f));
        const std::array<Vec3, 3> t = {toFloat(a), toFloat(a + e), toFloat(a + f)};
        const auto inPlane = [&] {
            return a + e * random.uniform(-1, 1.5) + f * random.uniform(-1, 1.5);
        };
        const Vec3 org = toFloat(inPlane());
        const Vec3 dir = toFloat(inPlane() + n * random.logUniform(1e-9, 1e-7)) - org;
        const RaySetup setup(org, dir, 3);
        if (!ShearedTriangle(setup, t[0], t[1], t[2]).containsRay()) continue;
        const TrianglePlane plane(setup, t[0], t[1], t[2]);
        const float key = plane.key();
        if (!(key > 0) || !plane.isEdgeOn() || plane.keyInChord(key) != 0) continue;
        ++found;
        CHECK(canonicalKey(setup, t[0], t[1], t[2]) == 0);
        RayList rays; // from one point, which bundles take, and beside it
        for (int k = 0; k < 96; ++k) {
            Ray ray{org, dir};
            for (std::size_t axis = 0; axis < 3 && k > 0; ++axis) {
                const auto step = [&] { return static_cast<int>(random.below(5)) - 2; };
                ray.dir[axis] = meshes::stepped(dir[axis], step());
                if (k >= 64) ray.org[axis] = meshes::stepped(org[axis], step());
            }
            rays.push(ray);
        }
        std::vector<std::array<Vec3, 3>> triangles{t};
        compare(Meshes(meshes::geometryOf(triangles, false)), rays, "alone", counts);
        for (int k = 0; k < 40; ++k) { // so many that the tree has leaves
            const Vec3d p = random.inBox(2);
            triangles.push_back(
                {toFloat(p), toFloat(p + e * 1e-3), toFloat(p + random.direction() * 1e-3)});
        }
        compare(Meshes(meshes::geometryOf(triangles, false)), rays, "among others", counts);
    }
    std::printf("%d such rays; %zu rays, %zu hits, %zu hidden, seed 83\n", found, counts.rays,
                counts.hits, counts.hidden);
    CHECK(found >= check::scaled(2));
}

// Packets of rays that go side by side: beams.
TEST(kernels_on_rays_side_by_side) {
    Random random(82);
    Counts counts;
    const auto ask = [&](const Meshes& meshes, const char* name) {
        const auto n = static_cast<std::size_t>(check::scaled(6000));
        compare(meshes, raysInBeams(random, meshes.scalar, n), name, counts);
    };
    for (const std::size_t size : {40u, 700u, 2000u})
        ask(Meshes(meshes::geometryOf(meshes::soup(random, size), false)), "soup");
    for (const MeshDesc& desc : {meshes::icosphere(5), meshes::torus(0.3, 96, 48)})
        ask(Meshes(toGeometry(desc, {})), "mesh");
    std::printf("%zu rays, %zu hits, %zu hidden, seed 82\n", counts.rays, counts.hits,
                counts.hidden);
    CHECK(counts.hits > counts.rays / 2 && counts.hits < counts.rays);
}

// A handful of triangles, that are tested in place, and a few more, that are not. Every third ray
// starts at one point, so that bundles and the others are scattered over the batch.
TEST(kernels_on_tiny_meshes) {
    Random random(78);
    Counts counts;
    for (const std::size_t size : {1u, 2u, 3u, 8u, 9u, 12u, 16u, 17u, 24u, 40u}) {
        const Meshes meshes(meshes::geometryOf(meshes::soup(random, size), false));
        const auto n = static_cast<std::size_t>(check::scaled(1200));
        const RayList loose = looseRays(random, meshes.scalar, n);
        const Vec3 from = toFloat(targetOn(random, meshes.scalar) * 2.0);
        RayList mixed;
        for (std::size_t i = 0; i < n; ++i) {
            Ray ray = loose.span()[i];
            if (i % 3 == 0) ray.org = from;
            mixed.push(ray);
        }
        compare(meshes, loose, "tiny", counts);
        compare(meshes, raysInPlanes(random, meshes.scalar, n / 2), "tiny, in the plane", counts);
        compare(meshes, mixed, "tiny, mixed", counts);
    }
    std::printf("%zu rays, %zu hits, %zu hidden, seed 78\n", counts.rays, counts.hits,
                counts.hidden);
    CHECK(counts.hits > counts.rays / 4 && counts.hits < counts.rays);
}

// What has more lines than bundles can tell apart is answered without them, all the same.
TEST(kernels_on_trees_too_large_for_bundles) {
    Random random(79);
    const Meshes meshes(toGeometry(meshes::icosphere(4), {}));
    const RayList rays = raysFromPoints(random, meshes.scalar, 1000);
    const std::size_t n = rays.size();
    const Mesh oracle(meshes.scalar, {0}, {{0, 0}});
    for (const auto& geometry : meshes.wide) {
        const std::size_t lines = geometry->wide.lines.size();
        for (const std::size_t most : {std::size_t{0}, lines - 1, lines}) {
            WideMesh mesh = geometry->wideMesh();
            mesh.mostLinesForBundles = most;
            std::vector<Hit> got(n, {.t = -7});
            std::vector<std::uint8_t> hidden(n, 7);
            closestHits(*geometry->isa, mesh, rays.span(), 3, got);
            anyHits(*geometry->isa, mesh, rays.span(), hidden);
            for (std::size_t i = 0; i < n; ++i) {
                const Ray ray = rays.span()[i];
                Hit expected{.t = ray.tMax};
                if (oracle.intersect(ray, expected)) expected.shape = 3;
                CHECK_INFO(haveSameBits(got[i], expected) && hidden[i] == oracle.occludes(ray),
                           geometry->isa->name << ", " << most << " of " << lines
                                               << " lines: " << shown(ray) << ": " << shown(got[i])
                                               << ", hidden " << int(hidden[i]));
            }
        }
    }
}

// From one point to all over a thicket, batch after batch: bundles are given up, then left to the
// queue for a while, then tried again.
TEST(kernels_in_a_thicket) {
    Random random(80);
    Counts counts;
    std::vector<std::array<Vec3, 3>> triangles;
    for (int i = 0; i < 6000; ++i) {
        const auto corner = [&](Vec3 middle) { return middle + toFloat(random.inBox(0.04)); };
        const Vec3 middle = toFloat(random.inBox(1));
        triangles.push_back({corner(middle), corner(middle), corner(middle)});
    }
    const Meshes meshes(meshes::geometryOf(triangles, false));
    for (int batch = 0; batch < check::scaled(24); ++batch) {
        RayList rays;
        const Vec3d lamp = random.inBox(2);
        for (int i = 0; i < 150; ++i) {
            const Vec3d target = targetOn(random, meshes.scalar);
            rays.push({toFloat(lamp), toFloat(target - lamp), 0, i % 2 ? 0.999f : kInfinityF});
        }
        compare(meshes, rays, "thicket", counts);
    }
    std::printf("%zu rays, %zu hits, %zu hidden, seed 80\n", counts.rays, counts.hits,
                counts.hidden);
    CHECK(counts.hits > counts.rays / 2 && counts.hidden < counts.rays);
}

// Pencils of rays through long strips in all directions, whose boxes overlap everywhere: a bundle
// looks at many more leaves than it has rays and goes on, and a ray enters up to all the boxes of a
// node at once. Bundles that go too far give up: rays to all sides.
TEST(kernels_among_wires) {
    Random random(81);
    Counts counts;
    std::vector<std::array<Vec3, 3>> triangles;
    for (int i = 0; i < 1500; ++i) {
        const Vec3d from = random.inBox(1), along = random.direction() * random.uniform(0.2, 1.5);
        const Vec3d across = normalize(cross(along, random.direction())) * 0.01;
        const Vec3 a = toFloat(from), b = toFloat(from + across), c = toFloat(from + along),
                   d = toFloat(from + along + across);
        triangles.insert(triangles.end(), {{a, c, d}, {a, d, b}});
    }
    const Meshes meshes(meshes::geometryOf(triangles, false));
    for (const auto& geometry : meshes.wide)
        CHECK_INFO(geometry->wide.leavesPerRay > 12, geometry->wide.leavesPerRay);
    for (int batch = 0; batch < check::scaled(12); ++batch) {
        RayList pencil, others;
        const Vec3d eye = random.inBox(batch % 2 == 0 ? 2 : 0.8);
        const Vec3d ahead = targetOn(random, meshes.scalar) - eye;
        const double width = std::exp2(random.uniform(-6, 0));
        for (int i = 0; i < 300; ++i) {
            const Vec3d dir = ahead + random.inBox(width) * length(ahead);
            pencil.push({toFloat(eye), toFloat(dir), 0, i % 5 ? kInfinityF : 0.9f});
            others.push({toFloat(random.inBox(1)), toFloat(random.direction()), 0, kInfinityF});
        }
        compare(meshes, pencil, "wires, pencil", counts);
        compare(meshes, others, "wires, one by one", counts);
    }
    std::printf("%zu rays, %zu hits, %zu hidden, seed 81\n", counts.rays, counts.hits,
                counts.hidden);
    CHECK(counts.hits > counts.rays / 20 && counts.hits < counts.rays);
}

} // namespace test_kernels
