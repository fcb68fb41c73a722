// Promise P2: closed meshes do not leak, surfaces do not hide themselves; baked and as instances,
// near and far from the origin of the world.
#include "analytic_kit.h"
#include "check.h"
#include "render/shape_set.h"
#include "verify/meshes.h"

#include <functional>

using meshes::Random;

namespace {

struct Solid {
    const char* name;
    MeshDesc mesh;
    bool isConvex;
    double tube; // of a torus, 0 for the others
};

const std::vector<Solid>& solids() {
    static const std::vector<Solid> all = {
        {"sphere", meshes::uvSphere(200, 100), true, 0},
        {"icosphere", meshes::icosphere(4), true, 0},
        {"cube", meshes::cube(), true, 0},
        {"fan", meshes::doubleFan(256), true, 0},
        {"torus", meshes::torus(0.3, 96, 48), false, 0.3},
        {"thin torus", meshes::torus(0.005, 64, 8), false, 0.005},
    };
    return all;
}

// Well inside, in mesh space.
Vec3d inside(Random& random, const Solid& solid) {
    if (solid.tube == 0) return random.inBox(0.1);
    const double a = kTwoPi * random.unit();
    // The polygon of the ring lies up to 1 - cos(pi/64) = 0.0012 inside the circle.
    return Vec3d{std::cos(a), std::sin(a), 0} * 0.9994 + random.inBox(solid.tube * 0.2);
}

// A ShapeSet with one mesh in the scene's normalised space.
struct Placed {
    meshes::Ready ready;
    const Solid* solid = nullptr;
    Transform sceneFromDesc;
    ShapeSet set;
    const Mesh* mesh = nullptr;

    Placed(const Solid& from, const Transform& worldFromMesh, const SceneFrame& frame,
           bool asInstance)
        : solid(&from), sceneFromDesc(frame.placed(worldFromMesh.rows())) {
        ready = asInstance ? meshes::instance(from.mesh, worldFromMesh, frame)
                           : meshes::baked(from.mesh, worldFromMesh, frame);
        mesh = ready.shape.get();
        set.add(std::move(ready.shape), ShapeSet::Shadow::Opaque);
        set.finish(true);
    }
    // A corner of triangle n in the scene's space.
    Vec3d corner(std::uint32_t n, std::size_t i) const {
        const MeshGeometry& g = *ready.geometry;
        return ready.sceneFromMesh.point(toDouble(g.points[g.triangles[n][i]]));
    }
    Vec3d onTriangle(Random& random, std::uint32_t n) const {
        const double u = 1 - std::sqrt(random.unit()), v = random.unit() * (1 - u);
        return corner(n, 0) * (1 - u - v) + corner(n, 1) * u + corner(n, 2) * v;
    }
    std::uint32_t someTriangle(Random& random) const {
        return random.below(ready.geometry->triangles.size());
    }
};

// The placements of a solid: as it is, turned and stretched, mirrored, at a far place of the world,
// small in a big scene. Each baked and as an instance. With STRESS=n n times, each time others.
void forEachPlacement(Random& random, const Solid& solid,
                      const std::function<void(const Placed&, const char*)>& fn) {
    const auto both = [&](const Transform& map, const SceneFrame& frame, const char* name) {
        fn(Placed(solid, map, frame, false), name);
        fn(Placed(solid, map, frame, true), name);
    };
    for (int round = 0; round < check::scaled(1); ++round) {
        const Transform plain, turned = random.affine(8, 1);
        const Transform mirror = random.affine(2, 1) * Transform::scale({-1, 1, 1});
        const Transform far = Transform::translate({148376, 1234, -223423}) * random.affine(2, 0) *
                              Transform::scale(7);
        both(plain, meshes::frameFor(solid.mesh, plain), "plain");
        both(turned, meshes::frameFor(solid.mesh, turned), "affine");
        both(mirror, meshes::frameFor(solid.mesh, mirror), "affine, maybe mirrored");
        both(far, meshes::frameFor(solid.mesh, far), "far");
        SceneFrame large; // a small thing in a scene of extent [1,2)
        both(Transform::translate(random.inBox(0.7)) * random.affine(2, 0) * Transform::scale(0.01),
             large, "small");
    }
}

std::string shown(const Ray& ray) {
    std::ostringstream out;
    out << std::hexfloat << ray.org.x << ' ' << ray.org.y << ' ' << ray.org.z << " dir "
        << ray.dir.x << ' ' << ray.dir.y << ' ' << ray.dir.z;
    return out.str();
}

// A direction to the side of `n`, often along the surface.
Vec3 leavingTo(Random& random, Vec3 n) {
    for (;;) {
        Vec3d d = random.direction();
        if (random.chance(0.4)) {
            const Vec3d side = toDouble(n);
            d = d - side * dot(d, side);
            if (length(d) < 0.01) continue;
            d = normalize(d) + side * random.logUniform(1e-9, 1e-2);
        }
        const Vec3 rounded = toFloat(d);
        if (dot(toDouble(rounded), toDouble(n)) > 0) return rounded;
    }
}

// The surface of a point that a ray really meets.
bool aimedSurface(const Placed& at, Random& random, Surface& surface, Vec3d towards) {
    Ray ray;
    ray.org = toFloat(at.sceneFromDesc.point(random.direction() * 3.0));
    ray.dir = toFloat(towards) - ray.org;
    if (random.chance(0.5)) ray.dir = normalize(ray.dir);
    const Hit hit = at.set.closest(ray);
    if (!hit.isHit()) return false;
    surface = at.mesh->surface(ray, hit);
    return true;
}

} // namespace

// From inside to anywhere, to vertices, to shared edges and a few floats beside them.
TEST(watertight_from_inside) {
    Random random(41);
    long long rays = 0, leaks = 0, anyLeaks = 0;
    for (const Solid& solid : solids()) {
        forEachPlacement(random, solid, [&](const Placed& at, const char* place) {
            for (int i = 0; i < 6000; ++i) {
                Vec3d from = at.sceneFromDesc.point(inside(random, solid));
                const std::uint32_t n = at.someTriangle(random);
                const std::size_t c = random.below(3);
                Vec3d to;
                switch (random.below(4)) {
                case 0: to = at.corner(n, c); break;
                case 1: to = lerp(at.corner(n, c), at.corner(n, (c + 1) % 3), random.unit()); break;
                case 2: to = at.onTriangle(random, n); break;
                default: to = from + random.direction(); break;
                }
                // In a convex solid also from close to where it aims.
                if (solid.isConvex && random.chance(0.3))
                    from = lerp(at.onTriangle(random, n), from, random.logUniform(1e-3, 1));
                Ray ray;
                ray.org = toFloat(from);
                Vec3 aim = toFloat(to);
                for (std::size_t k = 0; k < 3; ++k)
                    aim[k] = meshes::stepped(aim[k], static_cast<int>(random.below(7)) - 3);
                ray.dir = aim - ray.org;
                if (random.chance(0.5)) ray.dir = normalize(ray.dir);
                if (random.chance(0.05)) ray.dir[random.below(3)] = 0;
                if (!isTraceable(ray)) continue;
                ++rays;
                if (!at.set.closest(ray).isHit() && ++leaks <= 5)
                    CHECK_INFO(false, "seed 41 leak: " << solid.name << ", " << place << ", "
                                                       << shown(ray));
                if (!at.set.occluded(ray)) ++anyLeaks;
            }
        });
    }
    std::printf("%lld rays, %lld leaks, %lld of any-hit\n", rays, leaks, anyLeaks);
    CHECK(rays > 300000);
    CHECK_EQUAL(leaks, 0);
    CHECK_EQUAL(anyLeaks, 0);
}

// From lights outside to points inside: blocked, from 1 to 1e4 extents away.
TEST(watertight_from_outside) {
    Random random(42);
    long long rays = 0, leaks = 0;
    for (const Solid& solid : solids()) {
        forEachPlacement(random, solid, [&](const Placed& at, const char* place) {
            for (int i = 0; i < 2000; ++i) {
                const Vec3d target = at.sceneFromDesc.point(inside(random, solid));
                // Rounded to float the target must still be inside, and so the ray's end, whose
                // direction is rounded to 2^-24 of its length.
                const double furthest = solid.tube > 0 && solid.tube < 0.01 ? 30 : 1e4;
                const Vec3 light = toFloat(random.direction() * random.logUniform(4, furthest));
                const Ray ray{light, toFloat(target) - light, 0, 1, 0};
                const Bounds& box = at.set.boxes[0];
                if (maxAbs(box.size()) < 0.1f && maxAbs(light) > 100) continue;
                ++rays;
                if (!at.set.occluded(ray) && ++leaks <= 5)
                    CHECK_INFO(false, "seed 42 leak: " << solid.name << ", " << place << ", "
                                                       << shown(ray));
            }
        });
    }
    std::printf("%lld rays, %lld leaks\n", rays, leaks);
    CHECK(rays > 90000);
    CHECK_EQUAL(leaks, 0);
}

// Rays that leave a convex mesh by the error bound of their point do not meet it again; those that
// go inside do meet it.
TEST(watertight_reintersection) {
    Random random(43);
    long long out = 0, selfHits = 0, in = 0, leaks = 0;
    for (const Solid& solid : solids()) {
        if (!solid.isConvex) continue;
        for (int round = 0; round < 2; ++round) {
            forEachPlacement(random, solid, [&](const Placed& at, const char* place) {
                for (int i = 0; i < 100; ++i) {
                    Surface s;
                    if (!aimedSurface(at, random, s,
                                      at.onTriangle(random, at.someTriangle(random))))
                        continue;
                    for (int k = 0; k < 50; ++k) {
                        Ray ray;
                        ray.org = s.p + s.ng * s.error;
                        ray.dir = leavingTo(random, s.ng);
                        ++out;
                        if ((k % 4 == 0 ? at.set.closest(ray).isHit() : at.set.occluded(ray)) &&
                            ++selfHits <= 5)
                            CHECK_INFO(false, "seed 43 self hit: " << solid.name << ", " << place
                                                                   << ", " << shown(ray));
                        if (k % 4 != 0) continue;
                        ray.org = s.p - s.ng * s.error;
                        ray.dir = leavingTo(random, -s.ng);
                        ++in;
                        if (!at.set.closest(ray).isHit() && ++leaks <= 5)
                            CHECK_INFO(false, "seed 43 leak: " << solid.name << ", " << place
                                                               << ", " << shown(ray));
                    }
                }
            });
        }
    }
    std::printf("%lld out, %lld self hits, %lld in, %lld leaks\n", out, selfHits, in, leaks);
    CHECK(out > 350000);
    CHECK_EQUAL(selfHits, 0);
    CHECK_EQUAL(leaks, 0);
}

namespace {

struct ShadowCounts {
    long long rays = 0, blocked = 0;
};

// As in render/whitted.cpp: the ray starts at the lamp and ends at the point, moved off its
// surface.
void shadowRay(Random& random, const Surface& s, const Shape& shape, const std::string& name,
               ShadowCounts& counts) {
    // Few from very far: their pads open many boxes, 50 us a ray.
    const Vec3 light =
        toFloat(random.direction() * random.logUniform(1.5, random.chance(0.97) ? 30.0 : 1.5e4));
    const Vec3 d = light - s.p;
    const float distance = length(d);
    if (!(dot(s.ng, d / distance) > 0)) return;
    const Vec3 end = s.p + s.ng * (s.error + 0x1p-20f * distance); // leave() of render/shading.h
    const Ray ray{light, end - light, 0, 1, 0};
    ++counts.rays;
    if (shape.occludes(ray) && ++counts.blocked <= 5)
        CHECK_INFO(false, "blocked: " << name << ", at " << dot(s.ng, d / distance) << " from "
                                      << distance << ", " << shown(ray));
}

} // namespace

TEST(watertight_no_shadow_acne_on_meshes) {
    Random random(44);
    ShadowCounts counts;
    for (const Solid& solid : solids()) {
        if (!solid.isConvex) continue;
        forEachPlacement(random, solid, [&](const Placed& at, const char* place) {
            for (int i = 0; i < 2400; ++i) {
                Surface s;
                if (!aimedSurface(at, random, s, at.onTriangle(random, at.someTriangle(random))))
                    continue;
                for (int k = 0; k < 24; ++k)
                    shadowRay(random, s, *at.mesh, std::string(solid.name) + ' ' + place, counts);
            }
        });
    }
    std::printf("%lld shadow rays, %lld blocked, seed 44\n", counts.rays, counts.blocked);
    CHECK(counts.rays > 1000000);
    CHECK_EQUAL(counts.blocked, 0);
}

TEST(watertight_no_shadow_acne_on_formulas) {
    Random random(45);
    ShadowCounts counts;
    for (const kit::Kind& kind : kit::kinds()) {
        if (!kind.isClosed && !kind.isFlat) continue; // the inside of a tube may well be in shadow
        for (int n = 0; n < check::scaled(60); ++n) {
            const Transform map =
                random.affine(8, 1) * Transform::scale(random.logUniform(0.01, 1));
            const auto shape = kind.make(map);
            for (int i = 0; i < 150; ++i) {
                Ray ray;
                ray.org = toFloat(map.point(random.direction() * 4.0));
                ray.dir = toFloat(map.point(random.inBox(1))) - ray.org;
                Hit hit;
                if (!shape->intersect(ray, hit)) continue;
                const Surface s = shape->surface(ray, hit);
                for (int k = 0; k < 24; ++k) shadowRay(random, s, *shape, kind.name, counts);
            }
        }
    }
    std::printf("%lld shadow rays, %lld blocked, seed 45\n", counts.rays, counts.blocked);
    CHECK(counts.rays > 500000);
    CHECK_EQUAL(counts.blocked, 0);
}
