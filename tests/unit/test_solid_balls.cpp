// Trees of balls, whose rays meet them in pairs where they go apart: every kernel gives the bits of
// asking ray by ray without any tree.
#include "shape/sphere.h"
#include "solid_checks.h"

using meshes::Random;
using solid_checks::Rays;
using Shadow = ShapeSet::Shadow;

namespace {

struct Ball {
    Vec3d centre;
    double radius;
};

// Of one scale, which may mirror; some in one place, nested, or without size. Below kFewestBalls of
// the kernels and above.
std::vector<Ball> fillWithBalls(std::uint64_t seed, const Kernel&, ShapeSet& set) {
    Random random(seed);
    const std::size_t counts[] = {40, 63, 64, 100, 700, 3000};
    const double scale = seed % 4 == 3 ? -0.7 : random.logUniform(0.1, 10);
    std::vector<Ball> balls(counts[seed % 6]);
    for (std::size_t i = 0; i < balls.size(); ++i) {
        Ball& ball = balls[i];
        ball = {random.inBox(0.8), random.chance(0.02) ? 0 : random.logUniform(1e-3, 0.15)};
        if (i > 0 && random.chance(0.2)) ball.centre = balls[i - 1].centre;
        if (i > 0 && random.chance(0.2)) ball.radius = balls[i - 1].radius;
        const double shadow = random.unit();
        set.add(
            std::make_unique<Sphere>(Transform::translate(ball.centre) * Transform::scale(scale),
                                     ball.radius / std::fabs(scale), 0u, 0u),
            shadow < 0.7   ? Shadow::Opaque
            : shadow < 0.9 ? Shadow::SeeThrough
                           : Shadow::None);
    }
    return balls;
}

// As mirrored ones: they leave neighbouring points of a few balls; and others from anywhere.
Rays raysThatGoApart(Random& random, const std::vector<Ball>& balls) {
    Rays rays;
    const std::size_t count = 1 + random.below(300);
    const auto someBall = [&]() -> const Ball& { return balls[random.below(balls.size())]; };
    const Ball* ball = &someBall();
    Vec3d up = random.direction();
    for (std::size_t i = 0; i < count; ++i) {
        if (random.chance(0.1)) ball = &someBall(), up = random.direction();
        const Vec3d n = normalize(up + random.direction() * 0.3);
        const Vec3d from = random.chance(0.8) ? ball->centre + n * (ball->radius * (1 + 0x1p-20))
                                              : random.inBox(1.2);
        const Ball& aim = someBall();
        // Past its rim by a few roundings, at its inside, or anywhere.
        const double reach = random.chance(0.3) ? aim.radius * (1 + random.uniform(-1, 1) * 0x1p-20)
                                                : aim.radius * random.unit();
        const Vec3d to = random.chance(0.5) ? aim.centre + random.direction() * reach : from + n;
        Ray ray = kit::rayFrom(from, to - toDouble(toFloat(from)));
        if (random.chance(0.05)) ray.dir[random.below(3)] = 0;
        if (random.chance(0.1)) ray.tMax = static_cast<float>(random.logUniform(0.01, 3));
        if (random.chance(0.1)) ray.tMin = static_cast<float>(random.logUniform(0.001, 1));
        if (random.chance(0.01)) ray.org[random.below(3)] = std::nanf("");
        rays.push(ray);
    }
    return rays;
}

} // namespace

TEST(solids_balls_have_the_bits_of_single_rays) {
    solid_checks::compareSets("balls", 2801, 24, fillWithBalls, raysThatGoApart);
}

// Everything has to be a ball, and of one scale, over all parts that are made apart.
TEST(solid_tree_knows_if_all_are_balls) {
    for (const Kernel& kernel : allKernels()) {
        if (!kernel.supported() || kernel.width == 0) continue;
        for (const std::size_t count : {1u, 100u, 3000u})
            for (const std::size_t other : {count, std::size_t{0}, count - 1})
                for (const Vec3d& scale : {Vec3d{2, 2, 2}, Vec3d{1, 2, 1}}) {
                    Random random(count + other);
                    ShapeSet set;
                    for (std::size_t i = 0; i < count; ++i) {
                        const Transform at = Transform::translate(random.inBox(0.9));
                        set.add(std::make_unique<Sphere>(
                                    i == other ? at * Transform::scale(scale) : at, 0.01, 0u, 0u),
                                Shadow::Opaque);
                    }
                    set.finish(true, kernel);
                    const SolidTree& tree = set.solids();
                    const bool isOne = count == 1 && scale.y == scale.x;
                    const bool wanted = other == count || isOne;
                    CHECK_INFO(tree.balls.size() == (wanted ? count : 0),
                               kernel.name << ' ' << count << ' ' << other);
                    for (std::size_t i = 0; i < tree.balls.size(); ++i) {
                        const SolidTree::Ball& ball = tree.balls[i];
                        CHECK(ball.number == tree.solids[i].number && ball.radius == 0.01 &&
                              ball.box == tree.boxes[i]);
                    }
                }
    }
}
