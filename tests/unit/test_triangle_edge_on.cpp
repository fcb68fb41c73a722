// The canonical hit of triangles that a ray sees edge-on: near the triangle, not where its plane
// is.
#include "accel/triangle.h"
#include "check.h"
#include "shown_triangle.h"
#include "verify/meshes.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace test_triangle_edge_on {

using meshes::Random;

namespace {

// From a point to a triangle.
double distanceToTriangle(Vec3d p, const std::array<Vec3d, 3>& t) {
    const Vec3d n = normalize(cross(t[1] - t[0], t[2] - t[0]));
    double edges = kInfinity;
    bool isOver = true;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d a = t[i], along = t[(i + 1) % 3] - a;
        const double at = dot(p - a, along) / dot(along, along);
        edges = min(edges, length(p - (a + along * max(0.0, min(at, 1.0)))));
        isOver = isOver && dot(cross(along, p - a), n) >= 0;
    }
    return isOver ? std::fabs(dot(p - t[0], n)) : edges;
}

} // namespace

// Whoever meets a triangle meets it near itself, also rays that see it edge-on: they pass it by a
// rounding on its plane's other side, and meet the plane anywhere. Two on purpose are such that a
// shadow ray met the next triangle of the surface that it ends on, before its end.
TEST(triangle_seen_edge_on_is_met_near_itself) {
    Random random(36);
    long long hits = 0, flat = 0, beside = 0;
    double worst = 0;
    for (int i = 0; i < check::scaled(400000); ++i) {
        const double size = random.logUniform(1e-3, 1);
        const Vec3d at = random.inBox(1), across = random.direction();
        const Vec3d inPlane = normalize(cross(across, random.direction()));
        const Vec3d n = cross(inPlane, across); // the triangle's plane has inPlane and across
        std::array<Vec3, 3> t;
        for (Vec3& v : t) {
            const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
            v = toFloat(at + (inPlane * x + across * y) * size);
        }
        double tilt = random.logUniform(1e-5, 0.5);
        const Vec3d back = normalize(inPlane + n * (random.chance(0.5) ? tilt : -tilt));
        const double along = random.chance(0.7) ? random.uniform(0, 1) : random.uniform(-0.1, 1.1);
        Vec3 aim = toFloat(lerp(toDouble(t[0]), toDouble(t[1]), along));
        for (std::size_t k = 0; k < 3; ++k)
            aim[k] = meshes::stepped(aim[k], static_cast<int>(random.below(17)) - 8);
        Vec3 org = toFloat(toDouble(aim) + back * random.logUniform(2 * size, 30));
        Vec3 dir = aim - org;
        if (random.chance(0.3)) { // from beside or inside it to anywhere in the plane
            const auto inThePlane = [&] {
                const double x = random.uniform(-1.5, 1.5), y = random.uniform(-1.5, 1.5);
                return at + (inPlane * x + across * y) * size;
            };
            tilt = 0, org = toFloat(inThePlane());
            dir = toFloat(inThePlane() + n * (size * random.logUniform(1e-9, 1e-5))) - org;
        }
        const RaySetup setup(org, dir, 32);
        const float key = canonicalKey(setup, t[0], t[1], t[2]);
        if (!(key > 0)) continue;
        ++hits;
        flat += tilt < 1 / TrianglePlane::kSteep;
        const double where = 1 / (static_cast<double>(key) * static_cast<double>(setup.dz));
        const Vec3d met = toDouble(org) + toDouble(dir) * where;
        double farthest = 0;
        for (const Vec3 v : t) farthest = max(farthest, length(toDouble(v) - toDouble(org)));
        // Beside the ray by 2^-24 (4 M + 2 b) on both lateral axes, 8.5 units, nearer by 9 units of
        // depth, up to sqrt(3) times as much along the ray, and by one of the key: 20 together. And
        // where the triangle is seen less flat, by 1 / tilt of what it is beside.
        const double steep = min(TrianglePlane::kSteep, 1 / tilt);
        const double off =
            distanceToTriangle(met, {toDouble(t[0]), toDouble(t[1]), toDouble(t[2])});
        const double bound =
            0x1p-24 * farthest * (20 + (tilt < 1 / TrianglePlane::kSteep ? 0 : 8 * steep));
        worst = max(worst, off / bound);
        if (off > bound && ++beside <= 3)
            CHECK_INFO(false, "seed 36 case " << i << " tilt " << tilt << ' ' << off << " beside, "
                                              << shown(t, org, dir));
    }
    std::printf("%lld hits, %lld within 1/32 of edge-on, worst %.2f of the bound, seed 36\n", hits,
                flat, worst);
    CHECK(hits > check::scaled(50000) && flat > check::scaled(20000));
    CHECK_EQUAL(beside, 0);

    // A lamp, where the ray ends, and the neighbour.
    struct Case {
        Vec3 org, dir;
        std::array<Vec3, 3> triangle;
    };
    const Case cases[] = {{{-0x1.c831a6p+3f, -0x1.e87518p+3f, -0x1.55654ep+4f},
                           {0x1.c222b4p+3f, 0x1.dc76d2p+3f, 0x1.4c789ep+4f},
                           {{{-0.1843196f, -0.38110435f, -0.55246985f},
                             {-0.189895421f, -0.372930139f, -0.558187008f},
                             {-0.189806178f, -0.372754931f, -0.558040559f}}}},
                          {{-0x1.5cc21p+0f, -0x1.3414bap+3f, 0x1.3a820ep+2f},
                           {0x1.7e675ep+0f, 0x1.1e0ac8p+3f, -0x1.1aac98p+2f},
                           {{{0.135317311f, -0.689554453f, 0.494046986f},
                             {0.12665838f, -0.686468959f, 0.501110017f},
                             {0.126679882f, -0.686761677f, 0.501188874f}}}}};
    for (const Case& c : cases) {
        const RaySetup setup(c.org, c.dir, 1);
        const auto& [a, b, d] = c.triangle;
        const float key = canonicalKey(setup, a, b, d);
        CHECK_INFO(key > 0 && 1 / (key * setup.dz) > 1, shown(c.triangle, c.org, c.dir) << key);
    }
}

} // namespace test_triangle_edge_on
