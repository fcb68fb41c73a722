// ShapeSet: the answers of the top tree are those of the linear search, bit for bit, and the three
// queries agree with each other and with asking every shape.
#include "analytic_kit.h"
#include "check.h"
#include "scene/shape_set.h"
#include "shape/mesh_instance.h"
#include "verify/meshes.h"

#include <algorithm>
#include <tuple>

namespace test_shape_set {

using meshes::Random;
using Shadow = ShapeSet::Shadow;

namespace {

MovingTransform place(Random& random, bool moves) {
    const double size = random.logUniform(0.02, 0.2);
    const auto map = [&] {
        return Transform::translate(random.inBox(0.8)) * random.affine(3, 0) *
               Transform::scale(size);
    };
    const Transform first = map();
    if (!moves) return first;
    const Transform keys[2] = {first, Transform::translate(random.inBox(0.1)) * first *
                                          random.affine(1.2, 0)};
    return MovingTransform(std::span<const Transform>(keys));
}

// The widest kernel that this machine has.
const Isa& someKernel() {
    const Isa* best = &oneLane();
    for (const Isa& kernel : allIsas())
        if (kernel.supported() && kernel.width > best->width) best = &kernel;
    return *best;
}

// The same shapes: with a tree, without, and with the trees of a kernel.
struct Scene {
    std::vector<std::unique_ptr<MeshGeometry>> geometries, wideGeometries;
    ShapeSet tree, linear, wide;

    explicit Scene(std::uint64_t seed) {
        Random random(seed);
        const auto kinds = kit::kinds();
        MeshDesc soup;
        for (const auto& triangle : meshes::soup(random, 100)) {
            const auto n = static_cast<std::uint32_t>(soup.points.size());
            for (const Vec3 p : triangle) soup.points.push_back(toDouble(p) * 0.02);
            soup.triangles.push_back({n, n + 1, n + 2});
        }
        for (const MeshDesc& desc :
             {meshes::icosphere(2), meshes::cube(), meshes::torus(0.3, 16, 8), soup}) {
            geometries.push_back(std::make_unique<MeshGeometry>(toSharedGeometry(desc)));
            geometries.back()->finish(true);
            wideGeometries.push_back(std::make_unique<MeshGeometry>(toSharedGeometry(desc)));
            wideGeometries.back()->finish(true, someKernel());
        }
        MovingTransform last;
        for (std::size_t n = 0; n < 240; ++n) {
            const MovingTransform map =
                random.chance(0.1) ? last : place(random, random.chance(0.1));
            last = map; // some are at the same place: equal t, the lower number wins
            const std::uint32_t shadowNumber = random.below(10);
            const Shadow shadow = shadowNumber < 6   ? Shadow::Opaque
                                  : shadowNumber < 9 ? Shadow::SeeThrough
                                                     : Shadow::None;
            const std::size_t kind = n % (kinds.size() + geometries.size());
            for (ShapeSet* set : {&tree, &linear, &wide}) {
                std::unique_ptr<const Shape> shape;
                // Few planes without end, or nothing else would be seen.
                if (kind < kinds.size()) {
                    const bool endless = kinds[kind].name == "infinite plane";
                    shape = kinds[endless && n > 100 ? 0 : kind].make(map);
                } else {
                    const std::size_t mesh = kind - kinds.size();
                    shape = std::make_unique<MeshInstance>(
                        *(set == &wide ? wideGeometries : geometries)[mesh], map,
                        std::vector<std::uint32_t>{0}, static_cast<std::uint32_t>(n));
                }
                set->add(std::move(shape), shadow);
            }
        }
        tree.finish(true);
        linear.finish(false);
        wide.finish(true, someKernel(), 2);
    }
};

Ray someRay(Random& random, const ShapeSet& set) {
    const auto target = [&] {
        const Bounds& box = set.boxes[set.bounded[random.below(set.bounded.size())]];
        Vec3d p;
        for (std::size_t k = 0; k < 3; ++k)
            p[k] =
                lerp(static_cast<double>(box.lo[k]), static_cast<double>(box.hi[k]), random.unit());
        return p;
    };
    Ray ray;
    ray.org = toFloat(random.chance(0.3) ? random.direction() * 3.0 : target());
    ray.dir = random.chance(0.7) ? toFloat(target()) - ray.org : toFloat(random.direction());
    if (random.chance(0.5)) ray.dir = normalize(ray.dir);
    if (random.chance(0.1)) ray.dir[random.below(3)] = 0;
    if (random.chance(0.3)) ray.tMax = static_cast<float>(random.logUniform(0.05, 2));
    if (random.chance(0.1)) ray.tMin = static_cast<float>(random.logUniform(0.01, 0.5));
    ray.time = static_cast<float>(random.unit());
    return ray;
}

// By t; of triangles by their own order, of others by number.
auto nearerIn(const ShapeSet& set, const Ray& ray) {
    return [&set, ray](const Hit& a, const Hit& b) {
        if (a.t != b.t) return a.t < b.t;
        const auto orderA = set.shapes[a.shape]->tieOrder(ray, a);
        const auto orderB = set.shapes[b.shape]->tieOrder(ray, b);
        if (orderA && orderB && *orderA != *orderB) return orderA->isBefore(*orderB);
        return std::tie(a.shape, a.prim) < std::tie(b.shape, b.prim);
    };
}

} // namespace

TEST(shape_set_tree_equals_linear_search) {
    long long rays = 0, hits = 0, closestWrong = 0, anyWrong = 0, seeThroughWrong = 0,
              bruteWrong = 0;
    long long ties = 0, collected = 0;
    for (std::uint64_t seed = 61; seed < 61 + check::scaled(4u); ++seed) {
        const Scene scene(seed);
        CHECK(!scene.tree.solids().lines.empty() && scene.linear.solids().lines.empty());
        CHECK(!scene.wide.solids().lines.empty());
        CHECK(scene.tree.unbounded.size() >= 4 && scene.tree.shapes.size() == 240);
        Random random(seed + 1000);
        std::vector<Hit> a, b, c;
        for (int i = 0; i < 52000; ++i) {
            const Ray ray = someRay(random, scene.tree);
            const auto nearer = nearerIn(scene.tree, ray);
            ++rays;
            const Hit hit = scene.tree.closest(ray);
            if (!(hit == scene.linear.closest(ray) && hit == scene.wide.closest(ray)) &&
                ++closestWrong <= 3)
                CHECK_INFO(false, "seed " << seed << " ray " << i);
            hits += hit.isHit();
            const bool occluded = scene.tree.occluded(ray);
            if (occluded != scene.linear.occluded(ray) || occluded != scene.wide.occluded(ray))
                ++anyWrong;
            a.clear(), b.clear(), c.clear();
            scene.tree.seeThroughHits(ray, a);
            scene.linear.seeThroughHits(ray, b);
            scene.wide.seeThroughHits(ray, c);
            collected += static_cast<long long>(a.size());
            if (a != b || a != c || !std::is_sorted(a.begin(), a.end(), nearer)) ++seeThroughWrong;

            if (i % 16 != 0) continue; // every shape, without any box
            Hit best;
            best.t = ray.tMax;
            bool opaque = false;
            std::size_t seen = 0;
            for (std::uint32_t n = 0; n < scene.tree.shapes.size(); ++n) {
                const Shape& shape = *scene.tree.shapes[n];
                Hit own;
                own.t = ray.tMax;
                b.clear();
                shape.collect(ray, b);
                if (scene.tree.shadows[n] == Shadow::SeeThrough) seen += b.size();
                if (scene.tree.shadows[n] == Shadow::Opaque) opaque = opaque || shape.occludes(ray);
                if (!shape.intersect(ray, own)) continue;
                if (own.t == best.t && best.isHit()) ++ties;
                own.shape = n;
                if (!best.isHit() || nearer(own, best)) best = own;
            }
            if (opaque != occluded || seen != a.size()) ++bruteWrong;
            // t is clamped to the entry into the shape's padded box, which is not behind the hit
            // but for rounding of the hit itself.
            if (best.isHit() != hit.isHit() ||
                (hit.isHit() && (!(hit.t >= best.t && hit.t <= best.t * 1.00001f) ||
                                 (hit.t == best.t && hit.shape != best.shape))))
                ++bruteWrong;
        }
    }
    std::printf("%lld rays, %lld hits, %lld see-through hits, %lld ties, seeds 61 to %u\n", rays,
                hits, collected, ties, 60 + check::scaled(4u));
    CHECK(rays >= 200000 && hits > 100000 && collected > 10000 && ties > 10);
    CHECK_EQUAL(closestWrong, 0);
    CHECK_EQUAL(anyWrong, 0);
    CHECK_EQUAL(seeThroughWrong, 0);
    CHECK_EQUAL(bruteWrong, 0);
}

// any == (closest exists), when all is opaque and the ray has no end.
TEST(shape_set_occluded_is_closest_exists) {
    Scene scene(65);
    for (auto* set : {&scene.tree, &scene.linear})
        std::fill(set->shadows.begin(), set->shadows.end(), Shadow::Opaque);
    Random random(66);
    long long wrong = 0, hits = 0;
    for (int i = 0; i < check::scaled(30000); ++i) {
        Ray ray = someRay(random, scene.tree);
        ray.tMax = kInfinityF;
        const Hit hit = scene.tree.closest(ray);
        hits += hit.isHit();
        if (hit.isHit() != scene.tree.occluded(ray)) ++wrong;
        if (!hit.isHit()) continue;
        // Well beyond the hit it is in the way, well before nothing is.
        ray.tMax = hit.t * 1.0001f;
        if (!scene.tree.occluded(ray) || scene.tree.closest(ray) != hit) ++wrong;
        ray.tMax = hit.t * 0.9999f;
        if (scene.tree.occluded(ray) || scene.tree.closest(ray).isHit()) ++wrong;
    }
    CHECK(hits > 10000);
    CHECK_EQUAL(wrong, 0);
}

TEST(shape_set_ties_and_limits) {
    ShapeSet set;
    for (const Shadow shadow : {Shadow::SeeThrough, Shadow::None, Shadow::Opaque})
        set.add(std::make_unique<Disk>(MovingTransform(), 1.0, 0u, 0u), shadow);
    set.finish(true);
    Ray ray{{0.25f, 0.25f, 2}, {0, 0, -1}};
    CHECK_EQUAL(set.closest(ray).shape, 0u); // equal t: the lowest number, seen by shadows or not
    CHECK_EQUAL(set.closest(ray).t, 2.0f);
    CHECK(set.occluded(ray));
    std::vector<Hit> hits{{}};
    set.seeThroughHits(ray, hits);
    CHECK(hits.size() == 2 && hits[1].shape == 0); // appended
    ray.tMax = 2;
    CHECK(set.closest(ray).isHit() && !set.occluded(ray)); // (tMin, tMax] and (tMin, tMax)
    ray.tMax = nextDown(2.0f);
    CHECK(!set.closest(ray).isHit());
    // Rays that are none meet nothing.
    const float nan = std::nanf("");
    for (const Vec3 dir : {Vec3{0, 0, 0}, Vec3{nan, 0, -1}, Vec3{0, 0, -kInfinityF}}) {
        const Ray bad{{0.25f, 0.25f, 2}, dir};
        CHECK(!set.closest(bad).isHit() && !set.occluded(bad));
    }
    const ShapeSet none;
    CHECK(!none.closest(ray).isHit() && !none.occluded(ray));
}

} // namespace test_shape_set
