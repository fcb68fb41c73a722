// Mesh, MeshInstance and MeshGeometry: needles, motion, ties, parts; and numbers that others
// published for a scene.
#include "check.h"
#include "shape/mesh_instance.h"
#include "unit/mesh_kit.h"
#include "verify/meshes.h"

#include <algorithm>

namespace test_mesh {

using mesh_kit::rayTo;
using mesh_kit::squareWithUvs;
using meshes::Random;

namespace {

const std::vector<MeshPart> kOnePart = {{0, 0}};

} // namespace

// A ray that leaves a triangle of any shape by its error does not meet that triangle.
TEST(mesh_needles_do_not_hit_themselves) {
    Random random(54);
    long long rays = 0, selfHits = 0, points = 0;
    double largest = 0;
    for (int n = 0; n < 3; ++n) {
        auto triangles = meshes::soup(random, 3000);
        for (const auto& t : triangles) {
            MeshGeometry g = meshes::geometryOf({t}, false);
            if (g.dropDegenerate()) continue;
            g.finish(false);
            const Mesh mesh(g, {0}, kOnePart);
            const double u = 1 - std::sqrt(random.unit()), v = random.unit() * (1 - u);
            const Vec3d aim =
                toDouble(t[0]) * (1 - u - v) + toDouble(t[1]) * u + toDouble(t[2]) * v;
            const Ray ray = rayTo(random.inBox(3), aim);
            Hit hit;
            if (!mesh.intersect(ray, hit)) continue;
            const Surface s = mesh.surface(ray, hit);
            ++points;
            largest =
                std::max(largest, static_cast<double>(s.error) / static_cast<double>(g.extent));
            for (int k = 0; k < 40; ++k) {
                const float side = random.chance(0.5) ? 1.0f : -1.0f;
                Ray out;
                out.org = s.p + s.ng * (side * s.error);
                out.dir = toFloat(random.direction());
                if (random.chance(0.3)) // towards another place of the triangle, and off it
                    out.dir = toFloat(normalize(toDouble(t[random.below(3)] - out.org))) +
                              s.ng * (side * static_cast<float>(random.logUniform(1e-6, 1e-2)));
                if (!(dot(out.dir, s.ng) * side > 0)) continue;
                ++rays;
                if (mesh.occludes(out) && ++selfHits <= 5)
                    CHECK_INFO(false, "seed 54, corners "
                                          << t[0].x << ' ' << t[0].y << ' ' << t[0].z << ", "
                                          << t[1].x << ' ' << t[1].y << ' ' << t[1].z << ", "
                                          << t[2].x << ' ' << t[2].y << ' ' << t[2].z);
            }
        }
    }
    std::printf("%lld points, %lld rays, %lld self hits, largest error %g of the extent\n", points,
                rays, selfHits, largest);
    CHECK(points > 1500 && rays > 50000);
    CHECK_EQUAL(selfHits, 0);
}

// A moving mesh at a time is the mesh under the map of that time.
TEST(mesh_moves_as_its_transform_says) {
    Random random(55);
    const MeshDesc desc = meshes::icosphere(2);
    MeshGeometry g = toSharedGeometry(desc);
    g.finish(true);
    long long wrong = 0, hits = 0, outside = 0;
    for (int n = 0; n < 10; ++n) {
        const Transform keys[3] = {random.affine(2, 1), random.affine(2, 1), random.affine(2, 1)};
        const MovingTransform motion{std::span<const Transform>(keys)};
        const MeshInstance moving(g, motion, {0}, 0);
        const Bounds box = moving.bounds();
        for (int i = 0; i < 500; ++i) {
            Ray ray = rayTo(random.direction() * 4.0, random.inBox(1));
            ray.time = random.chance(0.1) ? 0.5f : static_cast<float>(random.unit());
            const Transform now = motion.at(static_cast<double>(ray.time));
            const MeshInstance still(g, MovingTransform(now), {0}, 0);
            Hit a, b;
            const bool hitA = moving.intersect(ray, a), hitB = still.intersect(ray, b);
            if (hitA != hitB || !(a == b)) ++wrong;
            if (!hitA) continue;
            ++hits;
            const Surface s = moving.surface(ray, a), r = still.surface(ray, b);
            if (!(s.p == r.p && s.ng == r.ng && s.ns == r.ns && s.error == r.error)) ++wrong;
            // On the unit sphere at that time, but for the flat facets (1 - cos of half an edge).
            const double radius = length(now.inverse().point(toDouble(s.p)));
            if (!(radius < 1.00001 && radius > 0.95)) ++wrong;
            if (!box.contains(s.p)) ++outside;
        }
    }
    std::printf("%lld hits, seed 55\n", hits);
    CHECK(hits > 1500);
    CHECK_EQUAL(wrong, 0);
    CHECK_EQUAL(outside, 0);
}

// A turning object turns about its own origin, wherever the middle of its mesh is: like the formula
// of the same sphere.
TEST(mesh_turns_about_the_origin_of_its_object) {
    MeshDesc desc = meshes::icosphere(3);
    for (Vec3d& p : desc.points) p = p * 0.25 + Vec3d{1, 0, 0};
    MeshGeometry g = toSharedGeometry(desc);
    g.finish(true);
    const Transform keys[2] = {Transform(), Transform::rotate({0, 0, 1}, kHalfPi)};
    const MovingTransform motion{std::span<const Transform>(keys)};
    const MeshInstance mesh(g, motion, {0}, 0);
    for (const double time : {0.0, 0.25, 0.5, 1.0}) {
        const double angle = time * kHalfPi;
        const Vec3d middle{std::cos(angle), std::sin(angle), 0};
        Ray ray = rayTo(middle + Vec3d{0, 0, 2}, middle);
        ray.time = static_cast<float>(time);
        Hit hit;
        CHECK_INFO(mesh.intersect(ray, hit), time);
        CHECK_NEAR(mesh.surface(ray, hit).p.z, 0.25, 0.005);
        CHECK(mesh.bounds().contains(mesh.surface(ray, hit).p));
    }
}

// tMin and tMax are open, the limit of intersect() is closed; equal triangles: the lower number.
TEST(mesh_ranges_and_ties) {
    MeshDesc desc = squareWithUvs();
    desc.uvs.clear(), desc.uvTriangles.clear();
    for (int i = 0; i < 3; ++i) // the same again, and again
        desc.triangles.insert(desc.triangles.end(), {{0, 1, 2}, {0, 2, 3}});
    for (const bool withTree : {true, false}) {
        MeshGeometry g = toGeometry(desc, {});
        g.finish(withTree);
        const Mesh mesh(g, {0}, kOnePart);
        Ray ray = rayTo({0.5, 0.75, 2}, {0.5, 0.75, 1}); // meets z = 0 at t = 2 in triangle 1
        Hit hit;
        CHECK(mesh.intersect(ray, hit) && hit.prim == 1);
        CHECK_EQUAL(hit.t, 2.0f);
        Hit atLimit;
        atLimit.t = 2;
        CHECK(mesh.intersect(ray, atLimit));
        atLimit.t = nextDown(2.0f);
        CHECK(!mesh.intersect(ray, atLimit));
        ray.tMax = 2;
        CHECK(!mesh.occludes(ray));
        ray.tMax = nextUp(2.0f) * 1.000001f;
        CHECK(mesh.occludes(ray));
        std::vector<Hit> hits;
        mesh.collect(ray, hits);
        CHECK_EQUAL(hits.size(), 4u);
        ray.tMin = 2;
        CHECK(!mesh.occludes(ray) && !mesh.intersect(ray, hit));
    }
}

TEST(mesh_parts_and_slots) {
    MeshDesc desc = squareWithUvs();
    desc.triangleMaterials = {1, 0};
    const MeshGeometry g = toGeometry(desc, {});
    const Mesh mesh(g, {40, 41}, {{0, 7}, {1, 8}});
    Hit hit;
    const Ray a = rayTo({1.5, 0.25, 1}, {1.5, 0.25, 0}), b = rayTo({0.5, 0.75, 1}, {0.5, 0.75, 0});
    CHECK(mesh.intersect(a, hit));
    CHECK(mesh.surface(a, hit).material == 41 && mesh.surface(a, hit).object == 7);
    hit = {};
    CHECK(mesh.intersect(b, hit));
    CHECK(mesh.surface(b, hit).material == 40 && mesh.surface(b, hit).object == 8);
}

// Haines' SPD scene tetra: numbers published in its Readme for 513 x 513 eye rays through pixel
// corners. The frustum's angle spans the centres of the outer pixels (NFF.TXT): 512/511 wider.
TEST(mesh_spd_tetra) {
    const meshes::Ready r = meshes::baked(meshes::tetra(5), {}, {});
    CHECK_EQUAL(r.geometry->triangles.size(), 4096u);
    const Vec3d from{1.02285, -3.17715, -2.17451}, at{-0.004103, -0.004103, 0.216539};
    const Vec3d up{-0.816497, -0.816497, 0.816497}, light{2, -18, -5};
    const Vec3d forward = normalize(at - from), right = normalize(cross(forward, up));
    const Vec3d above = cross(right, forward);
    const double half = std::tan(radians(22.5)) * 512 / 511;
    long long eye = 0, background = 0, shadow = 0;
    for (int j = 0; j <= 512; ++j) {
        for (int i = 0; i <= 512; ++i) {
            Ray ray;
            ray.org = toFloat(from);
            ray.dir = toFloat(forward + right * (half * (i / 256.0 - 1)) +
                              above * (half * (1 - j / 256.0)));
            ++eye;
            Hit hit;
            if (!r.shape->intersect(ray, hit)) {
                ++background;
                continue;
            }
            const Surface s = r.shape->surface(ray, hit);
            if (dot(toDouble(s.ng), light - toDouble(s.p)) > 0) ++shadow;
        }
    }
    std::printf("%lld eye rays, %lld background, %lld shadow\n", eye, background, shadow);
    CHECK_EQUAL(eye, 263169);
    CHECK_NEAR(background, 213381, 20);
    CHECK_NEAR(shadow, 46111, 20);
}

} // namespace test_mesh
