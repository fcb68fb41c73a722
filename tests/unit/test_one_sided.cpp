// One-sided shapes against an independent rule: of all crossings of the bare shape, the nearest one
// whose side is the visible one.
#include "analytic_kit.h"
#include "check.h"
#include "shape/mesh.h"
#include "shape/one_sided.h"
#include "verify/meshes.h"

#include <algorithm>

namespace test_one_sided {

using kit::Random;

namespace {

using Make = std::function<std::unique_ptr<const Shape>()>;

void checkSides(const char* name, const Make& make, std::uint64_t seed) {
    const auto bare = make();
    const OneSided front(make(), OneSided::Side::Front), back(make(), OneSided::Side::Back);
    Random random(seed);
    int fronts = 0, backs = 0;
    for (int i = 0; i < check::scaled(20000); ++i) {
        Ray ray;
        ray.org = toFloat(random.inBox(3));
        ray.dir = toFloat(random.direction());
        std::vector<Hit> all;
        bare->collect(ray, all);
        std::sort(all.begin(), all.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
        const auto expected = [&](bool wantFront) -> const Hit* {
            for (const Hit& hit : all)
                if ((dot(bare->surface(ray, hit).ng, ray.dir) <= 0) == wantFront) return &hit;
            return nullptr;
        };
        for (const bool wantFront : {true, false}) {
            const Hit* const wanted = expected(wantFront);
            Hit got;
            const bool hits = (wantFront ? front : back).intersect(ray, got);
            CHECK_INFO(hits == (wanted != nullptr), name << " ray " << i);
            if (hits && wanted)
                CHECK_INFO(got.t == wanted->t,
                           name << " ray " << i << " t " << got.t << " and " << wanted->t);
            if (hits) ++(wantFront ? fronts : backs);
        }
        // Shadows fall from both sides.
        CHECK(front.occludes(ray) == bare->occludes(ray));
    }
    CHECK_INFO(fronts > 500 && backs > 500, name << ' ' << fronts << ' ' << backs);
}

} // namespace

TEST(one_sided_sphere) {
    const Transform place = Transform::translate({0.2, 0, 0.1}) * Transform::scale({1, 2, 0.5});
    checkSides(
        "sphere", [&] { return std::make_unique<Sphere>(place, 1.0, 0u, 0u); }, 801);
}

TEST(one_sided_open_cone_shows_its_inside_through_its_outside) {
    const auto make = [] { return std::make_unique<Cone>(Transform(), 1.0, 0.5, false, 0u, 0u); };
    checkSides("cone", make, 802);
    const OneSided inside(make(), OneSided::Side::Back);
    Hit hit;
    CHECK(inside.intersect({{0, -3, 0}, {0, 1, 0}}, hit));
    CHECK_NEAR(hit.t, 3.75, 1e-6); // the wall behind the axis, at radius 0.75
}

TEST(one_sided_mirrored_cube) {
    checkSides(
        "cube",
        [] {
            return std::make_unique<Cube>(Transform::scale({-1, 0.5, 0.75}), 0u, 0u);
        },
        803);
}

// A hit that is farther than the one at hand is none, and one at hand is kept.
TEST(one_sided_keeps_nearer_hits) {
    const OneSided back(std::make_unique<Sphere>(Transform(), 1.0, 0u, 0u), OneSided::Side::Back);
    const Ray ray{{-3, 0, 0}, {1, 0, 0}};
    Hit hit;
    hit.t = 3.5f; // between the two walls of the sphere
    hit.shape = 7;
    CHECK(!back.intersect(ray, hit));
    CHECK(hit.t == 3.5f && hit.shape == 7);
    hit.t = 5;
    CHECK(back.intersect(ray, hit));
    CHECK(hit.t == 4 && hit.shape == 7);
}

} // namespace test_one_sided
