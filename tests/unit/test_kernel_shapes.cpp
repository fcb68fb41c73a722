// Kernels behind shapes: copies of a moving mesh, and meshes beside other shapes of a scene.
#include "analytic_kit.h"
#include "kernel_checks.h"
#include "scene/merge.h"
#include "scene/shape_set.h"
#include "shape/mesh_instance.h"

#include <algorithm>
#include <array>

namespace test_kernel_shapes {

using namespace battery;
using namespace kernel_checks;
using meshes::Random;

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
                        CHECK_INFO(battery::haveSameBits(got[i], expected[i]),
                                   geometry->isa->name
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

// A scene's batches: meshes with kernels, opaque and see-through, beside shapes that are asked ray
// by ray. The scalar code without any tree says what is right.
TEST(kernels_in_a_shape_set) {
    for (const Isa* kernel : vectorKernels()) {
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

} // namespace test_kernel_shapes
