// Spheres in one piece each: which ones are, and that every kernel finds the bits of asking hit by
// hit.
#include "accel/kernels/still_balls.h"
#include "accel/kernels/surface_lanes.h"
#include "analytic_kit.h"
#include "check.h"

#include <bit>
#include <memory>

namespace test_still_balls {

using kit::Random;

namespace {

std::array<std::uint32_t, 3> bitsOf(Vec3 v) {
    return {std::bit_cast<std::uint32_t>(v.x), std::bit_cast<std::uint32_t>(v.y),
            std::bit_cast<std::uint32_t>(v.z)};
}

bool takes(const Sphere& sphere) {
    StillBalls balls;
    balls.resize(1);
    return balls.take(0, *sphere.stillToShade());
}

} // namespace

TEST(balls_are_spheres_that_are_placed_and_scaled_alike) {
    const Transform half = Transform::scale(0.5);
    CHECK(takes(Sphere(Transform::translate({1, -2, 3}), 1, 0, 0)));
    CHECK(takes(Sphere(Transform::translate({1, -2, 3}) * half, 1, 0, 0)));
    CHECK(!takes(Sphere(Transform::scale({1, 1, 2}), 1, 0, 0)));
    CHECK(!takes(Sphere(Transform::rotate({0, 0, 1}, 1), 1, 0, 0)));
    CHECK(!takes(Sphere(Transform::scale({1, -1, 1}), 1, 0, 0)));
    CHECK(!takes(Sphere(Transform::translate({1, -2, 3}) * Transform::scale(-1), 1, 0, 0)));
    for (const double zero : {0.0, -0.0}) // a zero of the map may have a say there
        CHECK(!takes(Sphere(Transform::translate({1, zero, 3}), 1, 0, 0)));

    StillBalls balls;
    balls.resize(3);
    CHECK(balls.isEmpty());
    CHECK(balls.take(1, *Sphere(Transform::translate({1, 2, 3}), 4, 5, 6).stillToShade()));
    const Transform alike = Transform::translate({1, 2, 3});
    CHECK(takes(Sphere(alike * half, 1, 0, 0))); // but not beside one of another scale:
    CHECK(!balls.take(0, *Sphere(alike * half, 1, 0, 0).stillToShade()));
    CHECK(!balls.take(0, *Cube(Transform(), 0, 0).stillToShade()));
    CHECK(!balls.isEmpty() && balls.has(1) && !balls.has(0) && !balls.has(2));
    CHECK(balls[1].centre == (Vec3d{1, 2, 3}) && balls[1].radius == 4);
    CHECK(balls[1].material == 5 && balls[1].object == 6);
}

TEST(ball_surfaces_are_those_of_single_hits) {
    Random random(3311);
    std::size_t compared = 0;
    for (int i = 0; i < check::scaled(200); ++i) {
        const Transform scale = Transform::scale(i % 2 == 0 ? 1 : random.logUniform(1e-3, 1e3));
        std::vector<std::unique_ptr<const Sphere>> spheres;
        StillBalls balls;
        balls.resize(5);
        for (std::uint32_t k = 0; k < 5; ++k) {
            Vec3d place = random.inBox(5);
            if (random.chance(0.3)) place[random.below(3)] = random.coin() ? 0.0 : -0.0;
            spheres.push_back(std::make_unique<const Sphere>(
                Transform::translate(place) * scale, random.logUniform(1e-3, 1), 7 + k, 9 + k));
            balls.take(k, *spheres.back()->stillToShade());
        }
        std::vector<Vec3> org, dir;
        std::vector<float> tMin, tMax, time;
        std::vector<Hit> hits;
        std::vector<std::uint32_t> which, to;
        for (std::uint32_t k = 0; k < 61; ++k) {
            const std::uint32_t number = random.below(5);
            const Transform& map = spheres[number]->stillToShade()->worldFromObject;
            Vec3d from = map.point(random.inBox(3));
            const Vec3d at = map.translation();
            // Along an axis: then numbers are 0, with either sign.
            if (random.chance(0.3)) from[random.below(3)] = at[random.below(3)];
            org.push_back(toFloat(from)), dir.push_back(toFloat(at - from));
            if (random.chance(0.2)) dir.back()[random.below(3)] = random.coin() ? 0.0f : -0.0f;
            tMin.push_back(0), tMax.push_back(kInfinityF), time.push_back(0);
            hits.emplace_back();
            if (balls.isEmpty() || !balls.has(number)) continue;
            const Ray ray{org.back(), dir.back(), 0, kInfinityF, 0};
            if (!spheres[number]->intersect(ray, hits.back())) continue;
            hits.back().shape = number;
            which.push_back(k), to.push_back(60 - k);
        }
        if (which.empty()) continue;
        const RaySpan rays{org, dir, tMin, tMax, time};
        for (const Isa& kernel : allIsas()) {
            const BallSurfacesFn lanes = lanesOf(kernel.surfaces).balls;
            if (!kernel.supported() || lanes == nullptr) continue;
            std::vector<SurfaceBlock> out(4);
            const SurfacePlaces places(out.data());
            lanes({rays, hits, which, to, balls}, places);
            for (std::size_t k = 0; k < which.size(); ++k) {
                const Hit& hit = hits[which[k]];
                const Surface alone =
                    spheres[hit.shape]->surfaceFor(rays[which[k]], hit, {false, true});
                const Surface found = places[to[k]].surface();
                CHECK_INFO(bitsOf(found.p) == bitsOf(alone.p) &&
                               bitsOf(found.ng) == bitsOf(alone.ng) && found.error == alone.error &&
                               found.material == alone.material && found.object == alone.object,
                           std::string(kernel.name) + ", set " + std::to_string(i) + ", ray " +
                               std::to_string(which[k]));
                ++compared;
            }
        }
    }
    CHECK(compared > 1000);
}

} // namespace test_still_balls
