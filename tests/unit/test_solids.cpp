// Batches of rays against sets of all shapes: every kernel gives the bits of asking ray by ray
// without any tree, whether the rays come from one point, from lamps in turn, or from anywhere.
#include "shape/checkered.h"
#include "shape/mesh.h"
#include "solid_checks.h"

namespace test_solids {

using meshes::Random;
using solid_checks::Rays;
using solid_checks::Score;
using Shadow = ShapeSet::Shadow;

namespace {

struct Ball {
    Vec3d centre;
    double radius;
};

// The same shapes for any number of sets.
class Solids {
public:
    Solids(std::uint64_t seed, const Isa& kernel) : random_(seed) {
        tube_ = meshes::geometryOf(meshes::soup(random_, 60), false);
        tube_.finish(true, kernel);
        room_ = toGeometry(meshes::cube(), {});
        room_.finish(true, kernel);
    }

    // Half of them spheres, a few of those moving, in one place, nested or without size; the rest
    // of all kinds, some seen from one side only.
    void fill(ShapeSet& set, std::size_t count) {
        const auto& kinds = kit::kinds();
        for (std::size_t n = 0; n < count; ++n) {
            const double size = random_.logUniform(1e-3, random_.chance(0.1) ? 1 : 0.1);
            const Transform at = Transform::translate(random_.inBox(0.9));
            const Transform turn = random_.chance(0.5) ? Transform() : random_.affine(3, 0);
            Transform map = at * turn * Transform::scale(size);
            if (random_.chance(0.1)) map = last_; // equal t: the lower number wins
            if (random_.chance(0.1)) map = last_ * Transform::scale(random_.uniform(0.9, 1));
            last_ = map;
            const Transform keys[2] = {map, Transform::translate(random_.inBox(0.1)) * map};
            const MovingTransform place = random_.chance(0.1)
                                              ? MovingTransform(std::span<const Transform>(keys))
                                              : MovingTransform(map);
            const double shadow = random_.unit();
            set.add(shape(place, kinds), shadow < 0.7   ? Shadow::Opaque
                                         : shadow < 0.9 ? Shadow::SeeThrough
                                                        : Shadow::None);
        }
        set.add(mesh(tube_), Shadow::Opaque);
        set.add(std::make_unique<OneSided>(mesh(room_), OneSided::Side::Back), Shadow::None);
        set.add(std::make_unique<OneSided>(mesh(tube_), OneSided::Side::Front), Shadow::Opaque);
    }
    const std::vector<Ball>& balls() const { return balls_; }

private:
    static std::unique_ptr<const Shape> mesh(const MeshGeometry& geometry) {
        return std::make_unique<Mesh>(geometry, std::vector<std::uint32_t>{0},
                                      std::vector<MeshPart>{{0, 0}});
    }

    std::unique_ptr<const Shape> shape(const MovingTransform& place,
                                       const std::vector<kit::Kind>& kinds) {
        if (random_.chance(0.5)) {
            const double radius = random_.chance(0.02) ? 0 : random_.uniform(0.5, 1);
            balls_.push_back({place.at(0).translation(), radius * length(place.at(0).column(0))});
            std::unique_ptr<const Shape> ball = std::make_unique<Sphere>(place, radius, 0u, 0u);
            if (random_.chance(0.1)) ball = std::make_unique<Checkered>(std::move(ball), 1u);
            return solid_checks::sided(random_, std::move(ball), 0.1);
        }
        const kit::Kind* kind = &kinds[random_.below(kinds.size())];
        // Few planes without end, or nothing else would be seen.
        if (kind->name == "infinite plane" && random_.chance(0.9)) kind = &kinds[0];
        return solid_checks::sided(random_, kind->make(place), 0.3);
    }

    Random random_;
    MeshGeometry tube_, room_;
    Transform last_;
    std::vector<Ball> balls_;
};

Vec3d besides(Random& random, Vec3d way) { return normalize(cross(way, random.direction())); }

// A ray from `from` that touches a ball, or misses or meets it by a few roundings.
Ray tangent(Random& random, Vec3d from, const Ball& ball) {
    const Vec3d way = ball.centre - from;
    const double far = length(way), sine = min(ball.radius / far, 0.999);
    const double off = random.uniform(-1, 1) * 0x1p-22;
    const Vec3d rim = ball.centre - way * (sine * sine) +
                      besides(random, way) * (ball.radius * std::sqrt(1 - sine * sine) * (1 + off));
    return kit::rayFrom(from, rim - toDouble(toFloat(from)));
}

Rays someRays(Random& random, const std::vector<Ball>& balls) {
    Rays rays;
    const auto target = [&] {
        const Ball& ball = balls[random.below(balls.size())];
        return ball.centre + random.direction() * (ball.radius * random.uniform(0, 1.2));
    };
    const std::size_t count = 1 + random.below(400);
    const std::uint32_t kind = random.below(4);
    const Vec3d eye = random.direction() * random.logUniform(0.01, 8), aim = target();
    Vec3d lamps[20];
    for (Vec3d& lamp : lamps) lamp = random.direction() * random.uniform(0.2, 5);
    const std::size_t lampCount = random.chance(0.2) ? 20 : 1 + random.below(4);
    for (std::size_t i = 0; i < count; ++i) {
        Ray ray;
        switch (kind) {
        case 0: // a camera's
            ray = kit::rayThrough(eye, aim + random.direction() * random.uniform(0, 0.3));
            break;
        case 1: { // of lamps in turn, to where they end
            const Vec3d lamp = lamps[i % lampCount];
            ray = kit::rayFrom(lamp, target() - toDouble(toFloat(lamp)));
            ray.tMax = 1;
            break;
        }
        case 2: // from one point all over, also from inside
            ray = kit::rayFrom(aim, random.direction() * random.logUniform(0.1, 10));
            break;
        default: ray = kit::rayThrough(random.chance(0.3) ? eye : target(), target());
        }
        if (random.chance(0.2))
            ray = tangent(random, toDouble(ray.org), balls[random.below(balls.size())]);
        if (random.chance(0.05)) ray.dir[random.below(3)] = 0;
        if (random.chance(0.1)) ray.tMax = static_cast<float>(random.logUniform(0.01, 3));
        if (random.chance(0.1)) ray.tMin = static_cast<float>(random.logUniform(0.001, 1));
        if (random.chance(0.01)) ray.dir = {};
        if (random.chance(0.01)) ray.org[random.below(3)] = std::nanf("");
        if (random.chance(0.01)) ray.dir[random.below(3)] = kInfinityF;
        ray.time = static_cast<float>(random.unit());
        rays.push(ray);
    }
    return rays;
}

} // namespace

TEST(solids_batches_have_the_bits_of_single_rays) {
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported()) continue;
        Score score;
        for (std::uint64_t seed = 1501; seed < 1501 + check::scaled(20u); ++seed) {
            Random random(seed);
            // From a handful, which needs no tree, to a few levels of the widest nodes.
            const std::size_t counts[] = {1, 3, 15, 16, 40, 300};
            const std::size_t count = counts[seed % 6];
            Solids first(seed, kernel), second(seed, kernel);
            ShapeSet batches, single;
            first.fill(batches, count);
            second.fill(single, count);
            batches.finish(true, kernel);
            single.finish(false); // every shape is asked
            std::vector<Ball> balls = first.balls();
            if (balls.empty()) balls.push_back({{}, 0.5});
            for (int i = 0; i < 8; ++i)
                solid_checks::compare(kernel.name, seed, batches, single, someRays(random, balls),
                                      score);
        }
        solid_checks::checkScore("solids", kernel, score);
        CHECK_INFO(score.seen.size() > 150, kernel.name);
    }
}

// Of shapes that meet a ray at the same t the lowest number is seen, in whatever order the tree has
// them; and a ray that starts where another one hit does not see that hit again.
TEST(solids_ties_and_ranges) {
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported()) continue;
        ShapeSet set;
        for (int i = 0; i < 40; ++i)
            set.add(
                std::make_unique<Sphere>(Transform::translate({0.01 * (i / 4), 0, 0}), 0.5, 0u, 0u),
                i % 4 == 1 ? Shadow::Opaque : Shadow::None);
        set.finish(true, kernel);
        Rays rays;
        for (int i = 0; i < 20; ++i) rays.push({{-2, 0, 0}, {1, 0, 0}});
        std::vector<Hit> hits;
        std::vector<std::uint8_t> hidden;
        set.closest(rays.span(), hits);
        for (const Hit& hit : hits) CHECK(hit.shape == 0 && hit.t == 1.5f);
        // (tMin, tMax] for hits, (tMin, tMax) for shadows.
        for (std::size_t i = 0; i < 20; ++i) rays.tMax[i] = i % 2 ? 1.5f : nextDown(1.5f);
        set.closest(rays.span(), hits);
        set.occluded(rays.span(), hidden);
        for (std::size_t i = 0; i < 20; ++i) CHECK(hits[i].isHit() == (i % 2 == 1) && !hidden[i]);
        for (std::size_t i = 0; i < 20; ++i) rays.tMax[i] = i % 2 ? nextUp(1.5f) : 9.0f;
        set.occluded(rays.span(), hidden);
        for (std::size_t i = 0; i < 20; ++i) CHECK(hidden[i] == 1);
        // Past the first walls: the far one of the spheres about 0.
        for (std::size_t i = 0; i < 20; ++i) rays.tMin[i] = 2, rays.tMax[i] = kInfinityF;
        set.closest(rays.span(), hits);
        for (const Hit& hit : hits) CHECK(hit.shape == 0 && hit.t == 2.5f);
    }
}

} // namespace test_solids
