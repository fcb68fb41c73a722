// Mesh and MeshInstance: what a hit says about its point, its texture coordinates and its normals.
#include "check.h"
#include "shape/mesh_instance.h"
#include "unit/mesh_kit.h"
#include "verify/meshes.h"

#include <algorithm>

namespace test_mesh_surface {

using mesh_kit::rayTo;
using mesh_kit::squareWithUvs;
using meshes::Random;

namespace {

double angleBetween(Vec3 a, Vec3d b) { return length(cross(toDouble(a), normalize(b))); }

} // namespace

TEST(mesh_uv_and_position) {
    const MeshGeometry geometry = toGeometry(squareWithUvs(), {});
    const Mesh mesh(geometry, {3}, {{0, 9}});
    Random random(51);
    for (int i = 0; i < 20000; ++i) {
        const double x = random.uniform(0.001, 1.999), y = random.uniform(0.001, 0.999);
        const Vec3d from{x, y, random.chance(0.5) ? 1.0 : -1.0};
        const Ray ray = rayTo(from, {x, y, 0});
        Hit hit;
        CHECK(mesh.intersect(ray, hit));
        const Surface s = mesh.surface(ray, hit);
        const double X = static_cast<double>(ray.org.x), Y = static_cast<double>(ray.org.y);
        CHECK_NEAR(s.p.x, X, 3e-7);
        CHECK_NEAR(s.p.y, Y, 3e-7);
        CHECK_EQUAL(s.p.z, 0.0f);
        CHECK_NEAR(s.uv.x, 0.25 + X / 4, 3e-7);
        CHECK_NEAR(s.uv.y, 0.5 + Y / 2, 3e-7);
        CHECK(s.ng == (Vec3{0, 0, 1}) && s.ns == s.ng && s.material == 3 && s.object == 9);
        // dp/du: 0.5 of u are 2 of x. dp/dv: 0.5 of v are 1 of y.
        const SurfaceDerivatives d = mesh.derivatives(ray, hit);
        CHECK(length(d.dpdu - Vec3{4, 0, 0}) < 1e-5f && length(d.dpdv - Vec3{0, 2, 0}) < 1e-5f);
    }
}

// The point and the texture coordinates of neighbouring hits against the derivatives, and the
// barycentrics against the corners, on a sphere under affine maps.
TEST(mesh_derivatives) {
    Random random(52);
    const MeshDesc desc = meshes::uvSphere(48, 24);
    double worst = 0;
    long long count = 0;
    for (int n = 0; n < 20; ++n) {
        const Transform map = random.affine(3, 1);
        const meshes::Ready r =
            n % 2 ? meshes::instance(desc, map, {}) : meshes::baked(desc, map, {});
        const MeshGeometry& g = *r.geometry;
        for (int i = 0; i < 300; ++i) {
            const Ray ray =
                rayTo(map.point(random.direction() * 3.0), map.point(random.inBox(0.5)));
            Hit hit;
            if (!r.shape->intersect(ray, hit)) continue;
            const auto& t = g.uvTriangles[hit.prim];
            const SurfaceDerivatives d = r.shape->derivatives(ray, hit);
            const Surface s = r.shape->surface(ray, hit);
            Vec3d p[3];
            for (std::size_t k = 0; k < 3; ++k) p[k] = toDouble(r.corner(hit.prim, k));
            const double size = length(p[1] - p[0]) + length(p[2] - p[0]);
            for (std::size_t k = 0; k < 3; ++k) {
                // The map uv -> p is affine: it must take the difference to each corner with it.
                const double du = static_cast<double>(g.uvs[t[k]].x) - static_cast<double>(s.uv.x);
                const double dv = static_cast<double>(g.uvs[t[k]].y) - static_cast<double>(s.uv.y);
                const Vec3d step = toDouble(d.dpdu) * du + toDouble(d.dpdv) * dv;
                const double error = length(toDouble(s.p) + step - p[k]) / size;
                worst = std::max(worst, error);
            }
            ++count;
        }
    }
    std::printf("%lld points, worst %g of the triangle's size, seed 52\n", count, worst);
    CHECK(count > 4000);
    CHECK_INFO(worst < 1e-4, worst); // float uv of a cell of 1/48: 2^-24 * 48 * a few
}

// Without coordinates uv are the barycentrics, and dpdu, dpdv the edges.
TEST(mesh_without_uvs) {
    MeshDesc desc = squareWithUvs();
    desc.uvs.clear(), desc.uvTriangles.clear();
    MeshGeometry geometry = toSharedGeometry(desc);
    geometry.finish(true);
    const MeshInstance mesh(geometry, MovingTransform(Transform::scale({2, 2, -2})), {0}, 0);
    const Ray ray = rayTo({2.4, 0.6, 5}, {2.4, 0.6, 0});
    Hit hit;
    CHECK(mesh.intersect(ray, hit));
    CHECK_EQUAL(hit.prim, 0u);
    const Surface s = mesh.surface(ray, hit);
    CHECK(s.uv == (Vec2{hit.u, hit.v}));
    CHECK_NEAR(hit.u, 0.3, 1e-6); // p = 0.4 v0 + 0.3 v1 + 0.3 v2, in object space (1.2, 0.3)
    CHECK_NEAR(hit.v, 0.3, 1e-6);
    const SurfaceDerivatives d = mesh.derivatives(ray, hit);
    // The mirror has turned the triangle over: its last two corners have changed places.
    CHECK(d.dpdu == (Vec3{4, 2, 0}) && d.dpdv == (Vec3{4, 0, 0}));
}

// Outward normals from outside and inside, under maps of any handedness, baked and as instances,
// and smooth normals near the true ones.
TEST(mesh_normals_point_outward) {
    Random random(53);
    const MeshDesc desc = meshes::uvSphere(64, 32);
    long long inward = 0, count = 0, mirrors = 0;
    double worst = 0, worstSmooth = 0;
    for (int n = 0; n < 60; ++n) {
        const Transform map = random.affine(4, 1);
        mirrors += map.mirrors();
        const SceneFrame frame = meshes::frameFor(desc, map);
        const meshes::Ready r =
            n % 2 ? meshes::instance(desc, map, frame) : meshes::baked(desc, map, frame);
        const Transform scene = frame.placed(map.rows());
        for (int i = 0; i < 100; ++i) {
            const bool fromInside = random.chance(0.5);
            const Vec3d from = fromInside ? random.inBox(0.3) : random.direction() * 3.0;
            const Ray ray =
                rayTo(scene.point(from),
                      scene.point(fromInside ? random.direction() * 2.0 : random.inBox(0.4)));
            Hit hit;
            if (!r.shape->intersect(ray, hit)) continue;
            const Surface s = r.shape->surface(ray, hit);
            const double side = dot(toDouble(s.ng), toDouble(ray.dir));
            ++count;
            if (fromInside ? side <= 0 : side >= 0) ++inward;
            // Normal of the ellipsoid at the nearest place: the gradient of |q|^2.
            const Vec3d q = scene.inverse().point(toDouble(s.p));
            worstSmooth = std::max(worstSmooth, angleBetween(s.ns, scene.normal(q)));
            Vec3d p[3];
            for (std::size_t k = 0; k < 3; ++k) p[k] = toDouble(r.corner(hit.prim, k));
            const double turned = n % 2 && map.mirrors() ? -1 : 1;
            worst = std::max(worst, angleBetween(s.ng, cross(p[1] - p[0], p[2] - p[0]) * turned));
            CHECK_NEAR(length(s.ng), 1, 3e-7);
            CHECK_NEAR(length(s.ns), 1, 3e-7);
        }
    }
    std::printf("%lld hits, %lld mirrored maps, ng off by %g, ns by %g, seed 53\n", count, mirrors,
                worst, worstSmooth);
    CHECK(count > 5000 && mirrors > 10);
    CHECK_EQUAL(inward, 0);
    CHECK_INFO(worst < 1e-6, worst);
    CHECK_INFO(worstSmooth < 0.1, worstSmooth); // a facet of 1/64, stretched 16 times at most
}

} // namespace test_mesh_surface
