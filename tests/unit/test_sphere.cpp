#include "analytic_checks.h"

using kit::Random;

TEST(sphere_keeps_the_rules_of_shapes) { kit::checkShape("sphere", 101); }

namespace {

// Exact rays and spheres in extended precision: the oracle of T13.
struct Oracle {
    bool hit = false;
    long double t = 0; // nearest root above 0
    long double nx = 0, ny = 0, nz = 0;
    long double discriminant = 0; // of unit radius: (r^2 - l^2) / r^2
};

Oracle oracle(const Ray& ray, Vec3d centre, double radius) {
    using L = long double;
    const L r = radius;
    const L ox = L(ray.org.x) - centre.x, oy = L(ray.org.y) - centre.y,
            oz = L(ray.org.z) - centre.z;
    const L dx = ray.dir.x, dy = ray.dir.y, dz = ray.dir.z;
    const L dd = dx * dx + dy * dy + dz * dz;
    const L middle = -(ox * dx + oy * dy + oz * dz) / dd;
    const L lx = ox + middle * dx, ly = oy + middle * dy, lz = oz + middle * dz;
    const L l = std::sqrt(lx * lx + ly * ly + lz * lz);
    Oracle found;
    found.discriminant = (r - l) * (r + l) / (r * r);
    if (found.discriminant < 0) return found;
    const L half = r * std::sqrt(found.discriminant / dd);
    found.t = middle - half > 0 ? middle - half : middle + half;
    found.hit = found.t > 0;
    found.nx = (ox + found.t * dx) / r;
    found.ny = (oy + found.t * dy) / r;
    found.nz = (oz + found.t * dz) / r;
    return found;
}

} // namespace

TEST(sphere_precision_against_extended_precision) {
    Random random(102);
    double worstT = 0, worstNormal = 0;
    int wrong = 0, silhouettes = 0;
    for (int i = 0; i < 400000; ++i) {
        const double distance = random.logUniform(1e-3, 1e3);
        // Also close to the surface, inside and outside.
        const double ratio =
            i % 8 == 0 ? 1 + random.signedLogUniform(1e-6, 1e-1) : random.logUniform(1e-6, 1e6);
        const double radius = distance * ratio;
        const Vec3d org = random.inBox(i % 2 == 0 ? 0.0 : random.logUniform(1e-3, 10));
        const Vec3d toCentre = random.direction();
        const Vec3d centre = org + toCentre * distance;
        const Sphere sphere(Transform::translate(centre), radius, 0, 0);
        // Somewhere on the sphere's disk as seen from the ray's origin; one in four at its rim.
        const Vec3d side = normalize(cross(toCentre, random.direction()));
        const bool atRim = i % 4 == 3;
        const double place = atRim ? 1 + random.signedLogUniform(1e-7, 1e-3) : random.unit();
        const double sine = min(1.0, ratio) * place;
        if (sine > 1) continue;
        Vec3d dir = toCentre * std::sqrt(1 - sine * sine) + side * sine;
        if (ratio > 1) dir = random.direction();
        const Ray ray = kit::rayFrom(org, dir);
        const Oracle expected = oracle(ray, centre, radius);
        Hit hit;
        const bool isHit = sphere.intersect(ray, hit);
        if (atRim) ++silhouettes;
        if (isHit != expected.hit) {
            ++wrong;
            continue;
        }
        if (!isHit) continue;
        const double scale = 0x1p-23 * max(static_cast<double>(expected.t), distance);
        const double error =
            static_cast<double>(std::fabs(static_cast<long double>(hit.t) - expected.t));
        worstT = max(worstT, error / scale);
        // Nearer to the silhouette the normal's condition is beyond double for far spheres.
        if (expected.discriminant < 1e-6L) continue;
        const Vec3d ng = toDouble(sphere.surface(ray, hit).ng);
        const Vec3d n{static_cast<double>(expected.nx), static_cast<double>(expected.ny),
                      static_cast<double>(expected.nz)};
        worstNormal = max(worstNormal, length(ng - n));
    }
    std::printf("sphere: worst t %.3f ulp, worst normal %.2g, wrong %d of %d at the silhouette\n",
                worstT, worstNormal, wrong, silhouettes);
    CHECK_INFO(worstT <= 4, worstT);
    CHECK_INFO(worstNormal <= 1e-6, worstNormal);
    CHECK_INFO(wrong == 0, wrong); // T13 allows 1e-6 of them
}

TEST(sphere_tells_two_hits_with_one_t_apart) {
    // Seen from 10^7 radii away entry and exit have the same float t, and yet their own normals.
    const Sphere sphere(Transform::translate({10, 0, 0}), 1e-6, 0, 0);
    const Ray ray{{0, 0, 0}, {1, 0, 0}};
    std::vector<Hit> hits;
    sphere.collect(ray, hits);
    CHECK_EQUAL(hits.size(), std::size_t(2));
    if (hits.size() != 2) return;
    CHECK(std::fabs(hits[1].t - hits[0].t) <= 2e-6f);
    CHECK_NEAR(sphere.surface(ray, hits[0]).ng.x, -1, 1e-6);
    CHECK_NEAR(sphere.surface(ray, hits[1]).ng.x, 1, 1e-6);
}

TEST(sphere_uv) {
    const Sphere sphere(Transform(), 2, 0, 0);
    const auto uvAt = [&](Vec3d target) {
        const Ray ray = kit::rayThrough(target * 3.0, target);
        Hit hit;
        CHECK(sphere.intersect(ray, hit));
        return sphere.surface(ray, hit).uv;
    };
    CHECK_NEAR(uvAt({1, 0, 0}).x, 0.5, 1e-7);
    CHECK_NEAR(uvAt({1, 0, 0}).y, 0.5, 1e-7);
    CHECK_NEAR(uvAt({0, 1, 0}).x, 0.75, 1e-7);
    CHECK_NEAR(uvAt({0, -1, 0}).x, 0.25, 1e-7);
    CHECK_NEAR(uvAt({0, 0, 1}).y, 1, 1e-7);
    CHECK_NEAR(uvAt({0, 0, -1}).y, 0, 1e-7);
    CHECK_NEAR(uvAt({1, 0, 1}).y, 0.75, 1e-7);
    // The derivatives at the pole keep a direction.
    const Ray down{{0, 0, 9}, {0, 0, -1}};
    Hit hit;
    CHECK(sphere.intersect(down, hit));
    const SurfaceDerivatives d = sphere.derivatives(down, hit);
    CHECK(d.dpdu.y > 0 && d.dpdu.y < 1e-4f && d.dpdv.x < 0);
}

TEST(sphere_edge_cases) {
    const Sphere unit(Transform(), 1, 0, 0);
    Hit hit;
    CHECK(!unit.intersect({{2, 0, 0}, {1, 0, 0}}, hit));     // behind
    CHECK(unit.intersect({{0, 0, 0}, {0, 0, 1e-30f}}, hit)); // from the centre, any length
    CHECK_EQUAL(hit.t, 1e30f);
    hit = {};
    CHECK(!unit.intersect({{-2, 1.0000001f, 0}, {1, 0, 0}}, hit)); // an ulp beside
    CHECK(unit.intersect({{-2, 0.99999994f, 0}, {1, 0, 0}}, hit)); // an ulp inside
    hit = {};
    CHECK(unit.intersect({{1, 0, 0}, {-1, 0, 0}}, hit)); // from the surface itself, t = 0 is none
    CHECK_EQUAL(hit.t, 2.0f);
    hit = {};
    CHECK(!unit.intersect({{1, 0, 0}, {1, 0, 0}}, hit));
    for (const double radius : {0.0, -1.0, std::nan("")}) {
        const Sphere none(Transform(), radius, 0, 0);
        CHECK(!none.intersect({{-2, 0, 0}, {1, 0, 0}}, hit));
    }
}
