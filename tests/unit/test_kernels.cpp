// Every kernel that this CPU runs against the scalar code: the same hits, to the last bit, for
// hostile triangles and hostile rays, in bundles and one by one; and the trees that they walk.
#include "accel/kernels/kernels.h"
#include "analytic_kit.h"
#include "base/error.h"
#include "check.h"
#include "render/merge.h"
#include "render/shape_set.h"
#include "shape/mesh_instance.h"
#include "verify/hostile_rays.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

using namespace battery;
using meshes::Random;

namespace {

std::vector<const Kernel*> vectorKernels() {
    std::vector<const Kernel*> out;
    for (const Kernel& kernel : allKernels())
        if (kernel.supported() && kernel.width > 0) out.push_back(&kernel);
    return out;
}

// The same mesh with the trees of each kernel, the fast one and the best, and that of the scalar
// code.
struct Meshes {
    explicit Meshes(const MeshGeometry& bare) : scalar(bare) {
        scalar.finish(true);
        for (const Kernel* kernel : vectorKernels())
            for (const double rays : {0.0, kCountlessRays}) {
                wide.push_back(std::make_unique<MeshGeometry>(bare));
                wide.back()->finish(true, *kernel, 1, rays);
            }
    }
    MeshGeometry scalar;
    std::vector<std::unique_ptr<MeshGeometry>> wide;
};

std::string shown(const Ray& r) {
    std::ostringstream out;
    out.precision(9);
    out << "org " << r.org.x << ' ' << r.org.y << ' ' << r.org.z << " dir " << r.dir.x << ' '
        << r.dir.y << ' ' << r.dir.z << " t " << r.tMin << ' ' << r.tMax;
    return out.str();
}
std::string shown(const Hit& h) {
    std::ostringstream out;
    out.precision(9);
    if (h.isHit())
        out << "triangle " << h.prim << " at " << h.t << ' ' << h.u << ' ' << h.v;
    else
        out << "nothing";
    return out.str();
}

// -0 is not 0.
bool sameBits(const Hit& a, const Hit& b) {
    using Words = std::array<std::uint32_t, 5>;
    return std::bit_cast<Words>(a) == std::bit_cast<Words>(b);
}
bool sameBits(const TriangleHit& a, const Hit& b) {
    if (!b.isHit()) return a.t == kInfinityF && a.triangle == TriangleHit::kNone;
    return a.t == b.t && a.triangle == b.prim;
}

struct Counts {
    std::size_t rays = 0, hits = 0, hidden = 0;
};

// Asks all kernels about the rays; the scalar code says what is right.
void compare(const Meshes& meshes, const RayList& rays, const std::string& name, Counts& counts) {
    const std::size_t n = rays.org.size();
    const Mesh oracle(meshes.scalar, {0}, {{0, 0}});
    std::vector<Hit> expected(n), got(n);
    std::vector<TriangleHit> brief(n);
    std::vector<std::uint8_t> expectedHidden(n), hidden(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Ray ray = rays.span()[i];
        expected[i].t = ray.tMax;
        if (oracle.intersect(ray, expected[i])) expected[i].shape = 3;
        expectedHidden[i] = oracle.occludes(ray);
        counts.hits += expected[i].isHit(), counts.hidden += expectedHidden[i];
    }
    counts.rays += n;
    for (const auto& geometry : meshes.wide) {
        const Mesh mesh(*geometry, {0}, {{0, 0}});
        CHECK(mesh.takesBatches());
        got.assign(n, {.t = -7}), brief.assign(n, {.t = -7}); // for rays that nobody answers
        mesh.intersectBatch(rays.span(), 3, got);
        closestHits(*geometry->kernel, geometry->wideMesh(), rays.span(), brief);
        mesh.occludesBatch(rays.span(), hidden);
        for (std::size_t i = 0; i < n; ++i) {
            CHECK_INFO(sameBits(got[i], expected[i]) && sameBits(brief[i], expected[i]),
                       name << ", " << geometry->kernel->name << ", ray " << i << " of " << n
                            << ": " << shown(rays.span()[i]) << ": " << shown(got[i])
                            << ", without u and v: " << brief[i].triangle << " at " << brief[i].t
                            << ", expected " << shown(expected[i]));
            CHECK_INFO(hidden[i] == expectedHidden[i],
                       name << ", " << geometry->kernel->name << ", ray " << i << " of " << n
                            << ": " << shown(rays.span()[i]) << ": hidden " << int(hidden[i]));
        }
    }
}

} // namespace

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

// A moving mesh is at each time the copy of it that the kernels trace, with u and v.
TEST(kernels_on_copies_of_a_moving_mesh) {
    kit::Random random(78);
    std::size_t rays = 0, hits = 0;
    for (int n = 0; n < check::scaled(6); ++n) {
        const MeshDesc desc = n % 2 != 0 ? meshes::torus(0.3, 24, 12) : meshes::doubleFan(20);
        MeshGeometry shared = toSharedGeometry(desc);
        shared.finish(true);
        const Transform keys[2] = {Transform::scale(0.3) * random.turn(),
                                   Transform::translate(random.inBox(0.4)) * random.turn() *
                                       Transform::scale(0.4)};
        const MovingTransform motion{std::span<const Transform>(keys)};
        const MeshInstance moving(shared, motion, {0}, 0);
        for (const float time : {0.0f, 0.3f, 0.75f}) {
            const Transform now = motion.at(static_cast<double>(time));
            MeshGeometry copy;
            for (const Vec3d p : shared.exactPoints) copy.points.push_back(placedPoint(now, p));
            copy.triangles = shared.triangles;
            const Meshes copies(copy);
            for (RayList list : {looseRays(random, copies.scalar, 200),
                                 raysFromPoints(random, copies.scalar, 200)}) {
                list.time.assign(list.size(), time);
                std::vector<Hit> expected(list.size()), got(list.size());
                moving.intersectBatch(list.span(), 3, expected);
                for (const auto& geometry : copies.wide) {
                    Mesh(*geometry, {0}, {{0, 0}}).intersectBatch(list.span(), 3, got);
                    for (std::size_t i = 0; i < list.size(); ++i)
                        CHECK_INFO(sameBits(got[i], expected[i]),
                                   geometry->kernel->name
                                       << ", time " << time << ": " << shown(list.span()[i]) << ": "
                                       << shown(got[i]) << ", expected " << shown(expected[i]));
                }
                rays += list.size();
                for (const Hit& hit : expected) hits += hit.isHit();
            }
        }
    }
    CHECK_INFO(hits > rays / 3, hits << " of " << rays);
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
            closestHits(*geometry->kernel, mesh, rays.span(), 3, got);
            anyHits(*geometry->kernel, mesh, rays.span(), hidden);
            for (std::size_t i = 0; i < n; ++i) {
                const Ray ray = rays.span()[i];
                Hit expected{.t = ray.tMax};
                if (oracle.intersect(ray, expected)) expected.shape = 3;
                CHECK_INFO(sameBits(got[i], expected) && hidden[i] == oracle.occludes(ray),
                           geometry->kernel->name
                               << ", " << most << " of " << lines << " lines: " << shown(ray)
                               << ": " << shown(got[i]) << ", hidden " << int(hidden[i]));
            }
        }
    }
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

// A scene's batches: meshes with kernels, opaque and see-through, beside shapes that are asked ray
// by ray. The scalar code without any tree says what is right.
TEST(kernels_in_a_shape_set) {
    for (const Kernel* kernel : vectorKernels()) {
        Random random(75);
        std::array<MeshGeometry, 2> plain = {toGeometry(meshes::torus(0.3, 32, 16), {}),
                                             meshes::geometryOf(meshes::soup(random, 200), false)};
        std::array<MeshGeometry, 2> fast = plain;
        ShapeSet linear, batched;
        for (const bool isFast : {false, true}) {
            ShapeSet& set = isFast ? batched : linear;
            Random same(76);
            for (int n = 0; n < 12; ++n) {
                const auto kinds = kit::kinds();
                const MovingTransform place =
                    Transform::translate(same.inBox(1)) * same.affine(2, 0) * Transform::scale(0.3);
                if (n == 3 || n == 8) {
                    MeshGeometry& g = (isFast ? fast : plain)[n == 3 ? 0 : 1];
                    g.finish(isFast, *kernel);
                    set.add(std::make_unique<Mesh>(g, std::vector<std::uint32_t>{0},
                                                   std::vector<MeshPart>{{0, 0}}),
                            n == 3 ? ShapeSet::Shadow::Opaque : ShapeSet::Shadow::SeeThrough);
                } else {
                    set.add(kinds[static_cast<std::size_t>(n) % kinds.size()].make(place),
                            n % 3 ? ShapeSet::Shadow::Opaque : ShapeSet::Shadow::None);
                }
            }
            set.finish(isFast);
        }
        CHECK_EQUAL(batched.batched.size(), 2u);
        CHECK(linear.batched.empty());
        RayList rays = looseRays(random, plain[0], check::scaled(1000u));
        const RayList bundles = raysFromPoints(random, plain[1], check::scaled(1000u));
        for (std::size_t i = 0; i < bundles.org.size(); ++i) rays.push(bundles.span()[i]);
        std::vector<Hit> hits, some, expected;
        std::vector<std::uint8_t> hidden;
        batched.closest(rays.span(), hits);
        batched.occluded(rays.span(), hidden);
        std::vector<std::size_t> perShape(12);
        for (std::size_t i = 0; i < hits.size(); ++i) {
            const Ray ray = rays.span()[i];
            const Hit hit = linear.closest(ray);
            CHECK_INFO(hits[i] == hit, kernel->name << ": " << shown(ray) << ": " << shown(hits[i])
                                                    << ", expected " << shown(hit));
            CHECK_INFO((hidden[i] != 0) == linear.occluded(ray),
                       kernel->name << ": " << shown(ray) << ": hidden " << int(hidden[i]));
            CHECK(batched.closest(ray) == hit); // one ray at a time
            some.clear(), expected.clear();
            batched.seeThroughHits(ray, some);
            linear.seeThroughHits(ray, expected);
            CHECK_INFO(some == expected, kernel->name << ": " << shown(ray));
            if (hit.isHit()) ++perShape[hit.shape];
        }
        for (const std::size_t shape : {2u, 3u, 8u, 9u}) CHECK_INFO(perShape[shape] > 0, shape);
    }
}

TEST(kernels_wide_trees) {
    Random random(74);
    for (const int width : {8, 16}) {
        for (const std::size_t size : {std::size_t{1}, std::size_t{3}, std::size_t{16},
                                       std::size_t{500}, std::size_t{5000}}) {
            const MeshGeometry g = meshes::geometryOf(meshes::soup(random, size), false);
            const WideTree tree = buildWide(width, g.points, g.triangles);
            CHECK_EQUAL(tree.width, width);
            CHECK(tree.leaves * static_cast<std::uint64_t>(width) >= size);
            auto ids = tree.triangleIds; // every triangle once
            std::sort(ids.begin(), ids.end());
            for (std::uint32_t i = 0; i < size; ++i) CHECK(ids[i] == i);
            CHECK_EQUAL(ids.size(), size);
        }
        CHECK(buildWide(width, {}, {}).isEmpty());
        // All in one place: halving ends it.
        std::vector<std::array<Vec3, 3>> same(300, {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}});
        const MeshGeometry g = meshes::geometryOf(same, false);
        CHECK(buildWide(width, g.points, g.triangles).leaves >= 300u / 5);
    }
}

TEST(kernels_are_chosen_by_name) {
    const auto names = kernelNames();
    CHECK_EQUAL(names.back(), "scalar");
    CHECK_EQUAL(std::string(chooseKernel("scalar").name), "scalar");
    CHECK(chooseKernel("auto").supported());
    for (const Kernel& kernel : allKernels()) {
        if (kernel.supported())
            CHECK_EQUAL(std::string(chooseKernel(kernel.name).name), kernel.name);
        else
            CHECK_THROWS(chooseKernel(kernel.name), "this CPU can't run");
    }
    CHECK_THROWS(chooseKernel("avx51"), "did you mean 'avx512'");
    CHECK_THROWS(chooseKernel(""), "scalar");
}
