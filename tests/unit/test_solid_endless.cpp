// Planes without end, still and moving, some seen from one side: batches have the bits of asking
// every shape for every ray, among other solids or alone, and hardly any ray asks the shape itself.
#include "shape/checkered.h"
#include "solid_checks.h"

namespace test_solid_endless {

using meshes::Random;
using solid_checks::Rays;
using Shadow = ShapeSet::Shadow;

namespace {

MovingTransform placeOf(Random& random) {
    const double size = random.logUniform(1e-3, 1e3);
    Transform map = Transform::scale({size, -size, size});
    if (random.chance(0.8)) map = random.affine(random.chance(0.5) ? 1 : 4, 0) * map;
    map = Transform::translate(random.inBox(random.chance(0.1) ? 1000 : 0.9)) * map;
    std::vector<Transform> keys{map};
    const std::uint32_t kind = random.below(4);
    for (std::size_t more = 1 + random.below(3); kind != 0 && more > 0; --more) {
        const Transform away = Transform::translate(random.inBox(0.4));
        keys.push_back(
            kind == 1 ? away * map
                      : away * map * Transform::rotate(random.direction(), random.uniform(-1, 1)));
        if (kind == 3) keys.back() = keys.back() * Transform::scale(random.uniform(0.5, 2));
    }
    return MovingTransform(std::span<const Transform>(keys));
}

std::vector<MovingTransform> addPlanes(std::uint64_t seed, const Isa&, ShapeSet& set) {
    Random random(seed);
    std::vector<MovingTransform> places;
    const std::size_t count = 1 + seed % 5, balls = seed % 3 == 0 ? 0 : 1 + seed % 30;
    for (std::size_t n = 0; n < count + balls; ++n) {
        MovingTransform place = placeOf(random);
        if (!places.empty() && random.chance(0.1)) place = places.back(); // ties
        std::unique_ptr<const Shape> shape;
        if (n < count) {
            places.push_back(place);
            shape = std::make_unique<InfinitePlane>(place, 0u, 0u);
            if (random.chance(0.2)) shape = std::make_unique<Checkered>(std::move(shape), 1u);
        } else {
            const Transform at = Transform::translate(random.inBox(0.9));
            shape = std::make_unique<Sphere>(at, random.uniform(0.01, 0.2), 0u, 0u);
        }
        shape = solid_checks::sided(random, std::move(shape), 0.5);
        if (random.chance(0.05)) shape = solid_checks::sided(random, std::move(shape), 1);
        const double shadow = random.unit();
        set.add(std::move(shape), shadow < 0.8   ? Shadow::Opaque
                                  : shadow < 0.9 ? Shadow::SeeThrough
                                                 : Shadow::None);
    }
    return places;
}

// To points of the planes at the rays' times, beyond them and short of them, along them, and
// nearly.
Rays planeRays(Random& random, const std::vector<MovingTransform>& places) {
    Rays rays;
    const Vec3d eye = random.direction() * random.uniform(0.1, 4);
    const bool fromEye = random.chance(0.5);
    for (int i = 0; i < 200; ++i) {
        const float times[] = {0, 1, 0.5f, std::nanf("")};
        const float time = random.chance(0.15) ? times[random.below(std::size(times))]
                                               : static_cast<float>(random.unit());
        const auto place = [&] {
            const Transform map = places[random.below(places.size())].at(static_cast<double>(time));
            return map.point({random.uniform(-1, 1), random.uniform(-1, 1),
                              random.chance(0.3) ? 0 : random.logUniform(1e-9, 1)});
        };
        Ray ray = solid_checks::rayBetween(random, fromEye ? eye : place(), place(), fromEye);
        if (random.chance(0.05)) ray.dir[random.below(3)] = random.chance(0.5) ? 0.0f : -0.0f;
        if (random.chance(0.01)) ray.dir = {};
        if (random.chance(0.01)) ray.org[random.below(3)] = std::nanf("");
        ray.time = time;
        rays.push(ray);
    }
    return rays;
}

} // namespace

TEST(solid_endless_planes_have_the_bits_of_single_rays) {
    solid_checks::compareSets("endless", 4701, 100, addPlanes, planeRays);
}

// What maps to numbers whose squares overflow, or vanish, meets nothing in lanes either.
TEST(solid_endless_planes_of_extreme_scales_have_the_bits_of_single_rays) {
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported() || kernel.triangles == nullptr) continue;
        Random random(3403);
        solid_checks::Score score;
        for (const double scale : {0x1p-520, 0x1p-400, 0x1p400, 0x1p520}) {
            ShapeSet batches, single;
            for (ShapeSet* const set : {&batches, &single})
                set->add(std::make_unique<InfinitePlane>(Transform::scale(scale), 0u, 0u),
                         Shadow::Opaque);
            batches.finish(true, kernel);
            single.finish(false);
            Rays rays;
            for (int k = 0; k < 64; ++k)
                rays.push({toFloat(random.inBox(3)), toFloat(random.inBox(1)), 0, kInfinityF, 0});
            solid_checks::compare(kernel.name, 0, batches, single, rays, score);
        }
        CHECK(score.hits > 30 && score.hits < score.rays - 30);
        CHECK(score.wrongHits == 0 && score.wrongHidden == 0);
    }
}

TEST(solid_endless_planes_are_met_in_lanes) {
    constexpr int kRays = 400;
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported() || kernel.triangles == nullptr) continue;
        Random random(4702);
        int asked = 0, met = 0;
        for (int i = 0; i < 30; ++i) {
            const MovingTransform place = placeOf(random);
            std::unique_ptr<const Shape> plane = std::make_unique<InfinitePlane>(place, 0u, 0u);
            plane = solid_checks::sided(random, std::move(plane), 0.5);
            const SolidForm form = plane->solidForm();
            SolidTree tree;
            tree.addEndless(0, true, form);
            tree.extent = kSceneExtent;
            Rays rays;
            for (int k = 0; k < kRays; ++k)
                rays.push(kit::rayFrom(random.inBox(1), random.direction()));
            const SolidCalls calls{&asked,
                                   [](const void* count, const Ray&, std::uint32_t, float, Hit&) {
                                       ++*static_cast<int*>(const_cast<void*>(count));
                                       return false;
                                   },
                                   nullptr};
            std::vector<Hit> hits(kRays);
            closestSolids(*kernel.solids, tree, calls, rays.span(), hits);
            for (const Hit& hit : hits) met += hit.isHit();
        }
        CHECK_INFO(met > 1000 && asked < met / 20,
                   kernel.name << ": " << met << " met, asked " << asked);
    }
}

} // namespace test_solid_endless
