// Solids that move in any way, and spheres that are seen from one side: batches have the bits of
// asking every shape for every ray, at the keys and between them, where keys turn far or hardly,
// grow, mirror, flatten, or differ by a translation only.
#include "shape/sphere.h"
#include "solid_checks.h"

namespace test_solid_moving {

using meshes::Random;
using solid_checks::Rays;
using Shadow = ShapeSet::Shadow;

namespace {

struct Body {
    MovingTransform place;
    Vec3d at(Random& random, float time) const {
        // Of all kinds the surface is within this; some of it is on each.
        Vec3d p = random.chance(0.5) ? random.direction() * random.uniform(0.5, 1.1)
                                     : Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), 1};
        if (random.chance(0.2)) p.z = random.chance(0.5) ? 0 : -p.z;
        return place.at(static_cast<double>(time)).point(p);
    }
};

// From one key to the next.
Transform next(Random& random, const Transform& key, const Transform& first) {
    const Transform away = Transform::translate(random.inBox(0.2));
    switch (random.below(10)) {
    case 0: return away * key; // the linear part stays to the last bit
    case 1: return key;
    case 2: return away * key * Transform::scale(random.uniform(0.5, 2));
    case 3: return key * Transform::scale({1, random.uniform(0.5, 2), -1}); // through flat
    case 4: return key * Transform::rotate(random.direction(), random.logUniform(1e-9, 1e-3));
    case 5: return key * Transform::rotate(random.direction(), random.chance(0.5) ? kPi : 3.1);
    case 6: return random.chance(0.2) ? key * Transform::scale({1, 0, 1}) : key; // has no inverse
    case 7: return first * random.affine(3, 0);
    default: return away * key * Transform::rotate(random.direction(), random.uniform(-2, 2));
    }
}

MovingTransform movement(Random& random) {
    const double size = random.logUniform(random.chance(0.1) ? 1e-6 : 0.05, 0.5);
    Transform map = Transform::scale(random.chance(0.2) ? -size : size);
    if (random.chance(0.6)) map = random.affine(random.chance(0.5) ? 1 : 4, 0) * map;
    map = Transform::translate(random.inBox(random.chance(0.1) ? 1000 : 0.9)) * map;
    if (random.chance(0.03)) map = Transform::scale(1e5) * map;
    std::vector<Transform> keys{map};
    const std::size_t count = random.chance(0.5) ? 2 : 2 + random.below(5);
    while (keys.size() < count) keys.push_back(next(random, keys.back(), map));
    // Growing along the axes is inverted in its own way.
    if (random.chance(0.2))
        keys = {Transform::translate(map.translation()) * Transform::scale({size, size, 2 * size}),
                Transform::scale({2 * size, size, random.chance(0.2) ? -size : size})};
    return MovingTransform(std::span<const Transform>(keys));
}

std::unique_ptr<const Shape> someShape(Random& random, const MovingTransform& place) {
    if (random.chance(0.2))
        return std::make_unique<Sphere>(place, random.chance(0.02) ? 0 : random.uniform(0.5, 1), 0u,
                                        0u);
    const auto& kinds = kit::kinds();
    const kit::Kind* kind = &kinds[0];
    do kind = &kinds[random.below(kinds.size())];
    while (kind->name == "infinite plane");
    return kind->make(place);
}

std::vector<Body> addMoving(std::uint64_t seed, const Isa&, ShapeSet& set) {
    Random random(seed);
    std::vector<Body> bodies;
    const std::size_t count = 1 + seed * 7 % 30;
    for (std::size_t n = 0; n < count; ++n) {
        MovingTransform place = movement(random);
        if (random.chance(0.1) && !bodies.empty()) place = bodies.back().place; // ties
        set.add(solid_checks::sided(random, someShape(random, place), 0.4),
                random.chance(0.9) ? Shadow::Opaque : Shadow::None);
        bodies.push_back({place});
    }
    return bodies;
}

std::vector<Body> addSidedSpheres(std::uint64_t seed, const Isa&, ShapeSet& set) {
    Random random(seed);
    std::vector<Body> bodies;
    const std::size_t count = 1 + seed * 7 % 40;
    for (std::size_t n = 0; n < count; ++n) {
        const double size = random.logUniform(random.chance(0.1) ? 1e-6 : 0.05, 0.5);
        const Transform turn = random.chance(0.5) ? Transform() : random.affine(30, 0);
        const Transform map = Transform::translate(random.inBox(random.chance(0.1) ? 1000 : 0.9)) *
                              turn * Transform::scale(size);
        const Transform keys[2] = {map, Transform::translate(random.inBox(0.1)) * map};
        const MovingTransform place = random.chance(0.3)
                                          ? MovingTransform(std::span<const Transform>(keys))
                                          : MovingTransform(map);
        std::unique_ptr<const Shape> ball = std::make_unique<Sphere>(place, 1, 0u, 0u);
        ball = solid_checks::sided(random, std::move(ball), 0.9);
        set.add(std::move(ball), random.chance(0.9) ? Shadow::Opaque : Shadow::None);
        bodies.push_back({place});
    }
    return bodies;
}

// From lamps, eyes, the shapes themselves; at the keys' times, in between, and at none.
Rays movingRays(Random& random, const std::vector<Body>& bodies) {
    Rays rays;
    const Vec3d lamp = random.direction() * random.uniform(0.5, 4);
    const bool fromLamp = random.chance(0.5), oneTime = random.chance(0.2);
    const auto some = static_cast<float>(random.unit());
    for (int i = 0; i < 200; ++i) {
        const float times[] = {0, 1, 0.5f, 0x1p-30f, std::nanf(""), 2};
        const float time = oneTime               ? some
                           : random.chance(0.15) ? times[random.below(std::size(times))]
                                                 : static_cast<float>(random.unit());
        const auto place = [&] { return bodies[random.below(bodies.size())].at(random, time); };
        const Vec3d from = fromLamp ? lamp : random.chance(0.2) ? random.inBox(2) : place();
        Ray ray = solid_checks::rayBetween(random, from, place(), fromLamp);
        if (random.chance(0.05)) ray.dir[random.below(3)] = random.chance(0.5) ? 0.0f : -0.0f;
        ray.time = time;
        rays.push(ray);
    }
    return rays;
}

} // namespace

TEST(solids_that_turn_have_the_bits_of_single_rays) {
    solid_checks::compareSets("moving", 4501, 60, addMoving, movingRays);
}

TEST(solid_spheres_of_one_side_have_the_bits_of_single_rays) {
    solid_checks::compareSets("sides", 4601, 40, addSidedSpheres, movingRays);
}

// A ray that touches a sphere sees its front, so that the rim belongs to that side: to where its
// normal is at right angles to the ray, whatever the two roots say.
TEST(solid_spheres_of_one_side_have_their_rims) {
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported()) continue;
        for (const OneSided::Side side : {OneSided::Side::Front, OneSided::Side::Back}) {
            ShapeSet set;
            set.add(
                std::make_unique<OneSided>(std::make_unique<Sphere>(Transform(), 1, 0u, 0u), side),
                Shadow::Opaque);
            set.finish(true, kernel);
            Rays rays;
            for (int i = 0; i < 20; ++i) rays.push({{1, -2, 0}, {0, 1, 0}});
            rays.push({{0.5f, -2, 0}, {0, 1, 0}});
            std::vector<Hit> hits;
            set.closest(rays.span(), hits);
            for (std::size_t i = 0; i < 20; ++i)
                CHECK_INFO(hits[i].isHit() == (side == OneSided::Side::Front), kernel.name);
            const bool isNear = hits[20].t < 2;
            CHECK_INFO(hits[20].isHit() && isNear == (side == OneSided::Side::Front), kernel.name);
        }
    }
}

} // namespace test_solid_moving
