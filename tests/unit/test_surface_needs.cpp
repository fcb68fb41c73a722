// A surface that is asked for less is the same in all that was asked for.
#include "analytic_kit.h"
#include "check.h"
#include "shape/checkered.h"
#include "shape/one_sided.h"

namespace test_surface_needs {

using kit::Random;

namespace {

// -0 and 0 are told apart: what is skipped must not change the bits of what is not.
bool sameBits(const Surface& a, const Surface& b) {
    const auto same = [](float x, float y) { return x == y && std::signbit(x) == std::signbit(y); };
    const auto sameVec = [&](Vec3 x, Vec3 y) {
        return same(x.x, y.x) && same(x.y, y.y) && same(x.z, y.z);
    };
    return sameVec(a.p, b.p) && sameVec(a.ng, b.ng) && sameVec(a.ns, b.ns) &&
           same(a.error, b.error) && a.material == b.material && a.object == b.object;
}

void checkShape(const Shape& shape, Random& random, const std::string& name) {
    int hits = 0;
    for (int k = 0; k < 60; ++k) {
        const Ray ray = kit::rayThrough(random.outwards(4, 5), random.inBox(0.6));
        Hit hit;
        if (!shape.intersect(ray, hit)) continue;
        ++hits;
        const Surface all = shape.surface(ray, hit);
        for (const SurfaceNeeds needs :
             {SurfaceNeeds{}, {false, true}, {true, false}, {false, false}}) {
            const Surface some = shape.surfaceFor(ray, hit, needs);
            CHECK_INFO(sameBits(all, some), name);
            CHECK_INFO(!needs.uv || some.uv == all.uv, name);
            CHECK_INFO(!needs.lift || some.lift == all.lift, name);
        }
    }
    CHECK_INFO(hits > 0, name);
}

} // namespace

TEST(surface_needs_change_nothing_else) {
    Random random(907);
    for (const kit::Kind& kind : kit::kinds())
        for (int i = 0; i < check::scaled(10); ++i) {
            const Transform still = random.turn() * Transform::scale(1.5);
            const Transform keys[] = {still, Transform::translate({0.2, 0, 0}) * still};
            checkShape(*kind.make(still), random, kind.name);
            checkShape(*kind.make(MovingTransform{std::span(keys)}), random, kind.name + " moving");
            checkShape(Checkered(kind.make(still), 7), random, kind.name + " checkered");
            checkShape(OneSided(kind.make(still), OneSided::Side::Front), random,
                       kind.name + " one-sided");
        }
    const MeshDesc ball = meshes::uvSphere(12, 6); // with normals and texture coordinates
    const SceneFrame frame = meshes::frameFor(ball, {});
    checkShape(*meshes::baked(ball, {}, frame).shape, random, "mesh");
    checkShape(*meshes::instance(ball, Transform::scale({1, 1.5, 0.7}), frame).shape, random,
               "instance");
}

} // namespace test_surface_needs
