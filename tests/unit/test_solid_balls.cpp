// Trees of balls, whose rays meet them in pairs where they go apart: every kernel gives the bits of
// asking ray by ray without any tree.
#include "shape/cube.h"
#include "shape/cylinder.h"
#include "shape/mesh.h"
#include "shape/sphere.h"
#include "solid_checks.h"

namespace test_solid_balls {

using meshes::Random;
using solid_checks::Rays;
using solid_checks::sided;
using Shadow = ShapeSet::Shadow;

namespace {

struct Ball {
    Vec3d centre;
    double radius;
};

// Of one scale, which may mirror; some in one place, nested, or without size. Below kFewestBalls of
// the kernels and above.
std::vector<Ball> fillWithBalls(std::uint64_t seed, const Isa&, ShapeSet& set) {
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

// And some solids that are none, or of another scale.
struct MostlyBalls {
    std::vector<Ball> balls;
    MeshGeometry floor;
    MostlyBalls(std::uint64_t seed, const Isa& kernel, ShapeSet& set)
        : balls(fillWithBalls(seed, kernel, set)),
          floor(meshes::geometryOf({{{{-1, -1, -0.8f}, {1, -1, -0.8f}, {1, 1, -0.8f}}},
                                    {{{-1, -1, -0.8f}, {1, 1, -0.8f}, {-1, 1, -0.8f}}}},
                                   false)) {
        Random random(seed);
        floor.finish(true, kernel);
        set.add(std::make_unique<Mesh>(floor, std::vector<std::uint32_t>{0},
                                       std::vector<MeshPart>{{0, 0}}),
                Shadow::Opaque);
        const std::size_t others = random.below(balls.size() / 4);
        for (std::size_t i = 0; i < others; ++i) {
            const double size = random.logUniform(1e-3, 0.15);
            const Transform map = Transform::translate(random.inBox(0.8)) * random.affine(1, 0) *
                                  Transform::scale(size);
            std::unique_ptr<const Shape> shape;
            switch (random.below(3)) {
            case 0: shape = std::make_unique<Cube>(map, 0u, 0u); break;
            case 1: shape = std::make_unique<Cylinder>(map, 1.0, false, 0u, 0u); break;
            default: shape = std::make_unique<Sphere>(map, 1.0, 0u, 0u); break;
            }
            // No tubes in every other: these make all solids wait in pairs.
            if (seed % 2 == 0 && dynamic_cast<const Cylinder*>(shape.get()) != nullptr) continue;
            set.add(sided(random, std::move(shape), 0.1), Shadow::Opaque);
        }
    }
};

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
        if (random.chance(0.02)) // from afar, so that t is rounded coarsely
            ray.org = toFloat(from - toDouble(ray.dir) * random.logUniform(10, 1e6));
        if (random.chance(0.01)) ray.org[random.below(3)] = std::nanf("");
        rays.push(ray);
    }
    return rays;
}

template <int W> std::vector<WideKind> kindsOfLeaves(const SolidTree& tree) {
    std::vector<WideKind> kinds(tree.solids.size(), WideKind::None);
    for (std::size_t n = 0; n < tree.nodes(); ++n)
        for (const WideRef child :
             tree.node<W>(wideRef(n * sizeof(WideNode<W>) / sizeof(WideTree::Line), WideKind::Node))
                 .child)
            if (SolidTree::isLeaf(child)) kinds[child >> 2] = kindOf(child);
    return kinds;
}

// The first `others` shapes are of another scale, by which they may be balls.
void checkBalls(const SolidTree& tree, std::size_t count, std::size_t others, bool areBalls,
                const Isa& kernel) {
    const std::size_t balls = others == count && areBalls ? count : count - others;
    const bool isSure = balls == count || balls > count / 10 * 9, isNot = balls < count / 3 * 2;
    CHECK_INFO((tree.balls.size() == count && !isNot) || (tree.balls.empty() && !isSure),
               kernel.name << ' ' << count << ' ' << others << ": " << tree.balls.size());
    const std::vector<WideKind> kinds =
        tree.width == 16 ? kindsOfLeaves<16>(tree) : kindsOfLeaves<8>(tree);
    std::size_t inOrder = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const bool isOther = tree.solids[i].number < others && !(areBalls && others == count);
        inOrder += kinds[i] == SolidTree::kInOrder;
        if (tree.balls.empty()) continue;
        const SolidTree::Ball& ball = tree.balls[i];
        CHECK_INFO(kinds[i] == SolidTree::kInOrder || !isOther,
                   kernel.name << ' ' << count << ' ' << others << ' ' << i);
        if (kinds[i] == WideKind::Leaf)
            CHECK(tree.ballNumbers[i] == tree.solids[i].number && ball.radius == 0.01 &&
                  ball.offset.x == tree.solids[i].shape->objectFromWorld()[3]);
    }
    // Some balls in the beginning of a part may not be known.
    CHECK_INFO(tree.balls.empty()
                   ? inOrder == 0
                   : inOrder >= count - balls && inOrder <= count - balls + count / 20,
               kernel.name << ' ' << count << ' ' << others << ": " << inOrder);
}

} // namespace

TEST(solids_balls_have_the_bits_of_single_rays) {
    solid_checks::compareSets("balls", 2801, 24, fillWithBalls, raysThatGoApart);
}

TEST(solids_mostly_balls_have_the_bits_of_single_rays) {
    solid_checks::compareSets(
        "mostly balls", 2841, 24,
        [](std::uint64_t seed, const Isa& kernel, ShapeSet& set) {
            return std::make_unique<MostlyBalls>(seed, kernel, set);
        },
        [](Random& random, const std::unique_ptr<MostlyBalls>& of) {
            return raysThatGoApart(random, of->balls);
        });
}

// Most have to be balls, and of one scale, over all parts that are made apart; what isn't is known.
TEST(solid_tree_knows_if_most_are_balls) {
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported() || kernel.triangles == nullptr) continue;
        for (const std::size_t count : {1u, 100u, 3000u})
            for (const std::size_t others :
                 {std::size_t{0}, count / 100, count / 5, count / 2, count})
                for (const Vec3d& scale : {Vec3d{2, 2, 2}, Vec3d{1, 2, 1}}) {
                    Random random(count + others);
                    ShapeSet set;
                    for (std::size_t i = 0; i < count; ++i) {
                        const Transform at = Transform::translate(random.inBox(0.9));
                        set.add(std::make_unique<Sphere>(
                                    i < others ? at * Transform::scale(scale) : at, 0.01, 0u, 0u),
                                Shadow::Opaque);
                    }
                    set.finish(true, kernel);
                    checkBalls(set.solids(), count, others, scale.x == scale.y, kernel);
                }
    }
}

} // namespace test_solid_balls
