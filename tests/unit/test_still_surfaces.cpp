// Surfaces of many hits on shapes with a formula: every kernel gives the bits of asking hit by hit,
// whichever rays of the batch have met which shape.
#include "analytic_kit.h"
#include "check.h"
#include "shape/checkered.h"
#include "shape/cylinder.h"
#include "shape/infinite_plane.h"
#include "verify/hostile_rays.h"

#include <algorithm>
#include <bit>
#include <memory>

namespace test_still_surfaces {

using kit::Random;

namespace {

bool sameBits(Vec3 a, Vec3 b) {
    using Bits = std::uint32_t;
    return std::bit_cast<Bits>(a.x) == std::bit_cast<Bits>(b.x) &&
           std::bit_cast<Bits>(a.y) == std::bit_cast<Bits>(b.y) &&
           std::bit_cast<Bits>(a.z) == std::bit_cast<Bits>(b.z);
}
bool sameBits(const Surface& a, const Surface& b) {
    return sameBits(a.p, b.p) && sameBits(a.ng, b.ng) && sameBits(a.ns, b.ns) &&
           sameBits(Vec3{a.uv.x, a.uv.y, 0}, Vec3{b.uv.x, b.uv.y, 0}) && a.material == b.material &&
           a.object == b.object && a.error == b.error && a.rayError == b.rayError &&
           a.lift == b.lift;
}

using Shapes = std::vector<std::unique_ptr<const Shape>>;

// Rays from one point or from many, outside of the shapes or in them, each at one of them; some
// miss, by `missing` of them, so that those that hit have gaps. Shapes change from ray to ray, or
// rarely, so that registers are full of one, or of many. Returns how many hits were compared.
std::size_t checkShapes(StillShape::Kind kind, const Shapes& shapes,
                        const std::vector<Transform>& maps, Random& random, double missing,
                        double changes) {
    battery::RayList batch;
    std::vector<Hit> hits;
    std::vector<std::uint32_t> which, to;
    std::vector<const Shape*> met;
    std::vector<const StillShape*> toShade;
    const bool fromOnePoint = random.coin();
    const Vec3d eye = maps[0].point(random.inBox(3));
    std::size_t number = 0;
    const bool wantsUv = random.coin();
    for (std::uint32_t i = 0; i < 61; ++i) {
        if (random.chance(changes))
            number = random.below(static_cast<std::uint32_t>(shapes.size()));
        // Now and then along the axis: into poles, tips and middles of ends.
        const bool onAxis = random.chance(0.05);
        const Vec3d from = onAxis         ? maps[number].point({0, 0, random.coin() ? 3.0 : -3.0})
                           : fromOnePoint ? eye
                                          : maps[number].point(random.inBox(3));
        const Vec3d at = maps[number].point(onAxis ? Vec3d{} : random.inBox(1));
        const Ray ray{toFloat(from), toFloat(at - from), 0, kInfinityF, 0};
        batch.push(ray);
        hits.emplace_back();
        if (random.chance(missing) || !shapes[number]->intersect(ray, hits.back())) continue;
        if (random.chance(0.3)) hits.back().u = 0; // off the surface
        const StillShape* const shade = shapes[number]->stillToShade();
        if ((shade->parts >> hits.back().prim & 1) == 0) continue; // a cap without size
        if (shade->kindOf(hits.back().prim) != kind) continue;
        which.push_back(i), to.push_back(i);
        met.push_back(shapes[number].get()), toShade.push_back(shade);
    }
    if (which.empty()) return 0;
    std::reverse(to.begin(), to.end()); // places are not those of the rays
    const RaySpan rays = batch.span();
    for (const Isa& kernel : allIsas()) {
        const StillSurfacesFn lanes = lanesOf(kernel.surfaces).stills;
        if (!kernel.supported() || lanes == nullptr) continue;
        std::vector<SurfaceBlock> out(4);
        const SurfacePlaces places(out.data());
        lanes({kind, rays, hits, which, to, toShade, wantsUv}, places);
        for (std::size_t k = 0; k < which.size(); ++k) {
            Surface alone = met[k]->surfaceFor(rays[which[k]], hits[which[k]], {wantsUv, true});
            if (!wantsUv) alone.uv = {};
            CHECK_INFO(sameBits(places[to[k]].surface(), alone),
                       std::string(kernel.name) + ", hit " + std::to_string(k) + " of " +
                           std::to_string(which.size()) + ", ray " + std::to_string(which[k]));
        }
    }
    return which.size();
}

// make(map, radius, number)
template <class MakeFn> void checkKind(Random& random, MakeFn&& make) {
    std::size_t compared = 0, caps = 0;
    bool hasCaps = false;
    for (int i = 0; i < check::scaled(300); ++i) {
        Shapes shapes;
        std::vector<Transform> maps;
        for (std::uint32_t k = 0; k < 5; ++k) {
            const Transform map =
                i % 3 == 0 ? Transform::translate(random.inBox(5)) : kit::randomMap(random);
            const double radius = i % 5 == 0 ? random.logUniform(1e-6, 1e3) : 1;
            shapes.push_back(make(map, radius, k));
            maps.push_back(map * Transform::scale({radius, radius, i % 2 == 0 ? radius : 1}));
        }
        const double missing = i % 2 == 0 ? 0.1 : 0, changes = i % 4 == 0 ? 0.05 : 0.9;
        const StillShape& some = *shapes[0]->stillToShade();
        compared += checkShapes(some.kind, shapes, maps, random, missing, changes);
        hasCaps |= some.caps != 0;
        caps += checkShapes(StillShape::Kind::Cap, shapes, maps, random, missing, changes);
    }
    CHECK(compared > 1000);
    CHECK_INFO(!hasCaps || caps > 1000, caps);
}

} // namespace

TEST(sphere_surfaces_are_those_of_single_hits) {
    Random random(3301);
    checkKind(random, [](const Transform& map, double radius, std::uint32_t k) {
        return std::make_unique<const Sphere>(map, radius, 7 + k, 9 + k);
    });
}

TEST(cylinder_surfaces_are_those_of_single_hits) {
    Random random(3304);
    checkKind(random, [](const Transform& map, double radius, std::uint32_t k) {
        return std::make_unique<const Cylinder>(map, radius, k % 2 == 0, 7 + k, 9 + k);
    });
}

TEST(cone_surfaces_are_those_of_single_hits) {
    Random random(3306);
    checkKind(random, [&](const Transform& map, double radius, std::uint32_t k) {
        // Up to the tip and around it, where points go down the side.
        const double top = k % 3 == 0 ? 0 : random.uniform(0, 2);
        return std::make_unique<const Cone>(map, radius, top * radius, k % 2 == 0, 7 + k, 9 + k);
    });
}

TEST(cube_surfaces_are_those_of_single_hits) {
    Random random(3307);
    checkKind(random, [](const Transform& map, double, std::uint32_t k) {
        return std::make_unique<const Cube>(map, 7 + k, 9 + k);
    });
}

TEST(disk_and_corner_surfaces_are_those_of_single_hits) {
    Random random(3308);
    checkKind(random, [](const Transform& map, double radius, std::uint32_t k) {
        return std::make_unique<const Disk>(map, radius, 7 + k, 9 + k);
    });
    checkKind(random, [&](const Transform& map, double radius, std::uint32_t k) {
        Plane::Corners corners = kit::kQuad;
        for (Vec3d& corner : corners) corner = corner * radius + Vec3d{0, 0, random.unit()};
        // In their plane, and not always a parallelogram.
        const double along = random.coin() ? 1 : random.uniform(0.6, 1.6);
        const double aside = along == 1 ? 0 : random.uniform(-0.2, 0.3);
        corners[3] =
            corners[0] + (corners[2] - corners[1]) * along + (corners[1] - corners[0]) * aside;
        return std::make_unique<const Plane>(map, corners, 7 + k, 9 + k);
    });
}

TEST(plane_surfaces_are_those_of_single_hits) {
    Random random(3305);
    checkKind(random, [&](const Transform& map, double, std::uint32_t k) {
        // Some far off, where the error grows with the coordinates.
        const Transform moved = map * Transform::translate({0, 0, k == 0 ? 0 : random.unit() * 50});
        std::unique_ptr<const Shape> shape =
            std::make_unique<const InfinitePlane>(moved, 7 + k, 9 + k);
        if (k % 2 == 0) shape = std::make_unique<const Checkered>(std::move(shape), 20 + k);
        return shape;
    });
}

// They are asked one by one: their maps change, or have no inverse.
TEST(still_surfaces_of_moving_and_flat_shapes_are_not_for_lanes) {
    Random random(3302);
    for (int i = 0; i < check::scaled(20); ++i) {
        const Transform keys[] = {kit::randomMap(random), kit::randomMap(random)};
        const MovingTransform moving{std::span(keys)};
        CHECK(Sphere(moving, 1, 2, 3).stillToShade() == nullptr);
        CHECK(Cylinder(moving, 1, false, 2, 3).stillToShade() == nullptr);
        CHECK(InfinitePlane(moving, 2, 3).stillToShade() == nullptr);
        CHECK(Cone(moving, 1, 0, true, 2, 3).stillToShade() == nullptr);
        CHECK(Cube(moving, 2, 3).stillToShade() == nullptr);
        const Transform flat = kit::randomMap(random) * Transform::scale({1, 1, 0});
        CHECK(Sphere(flat, 1, 2, 3).stillToShade() == nullptr);
        CHECK(Cylinder(flat, 1, false, 2, 3).stillToShade() == nullptr);
        CHECK(InfinitePlane(flat, 2, 3).stillToShade() == nullptr);
        CHECK(Cube(flat, 2, 3).stillToShade() == nullptr);
        CHECK(Sphere(keys[0], 1, 2, 3).stillToShade() != nullptr);
        CHECK(Cylinder(keys[0], 1, true, 2, 3).stillToShade() != nullptr);
        CHECK(InfinitePlane(keys[0], 2, 3).stillToShade() != nullptr);
        CHECK(Cone(keys[0], 1, 0, true, 2, 3).stillToShade() != nullptr);
        CHECK(Cube(keys[0], 2, 3).stillToShade() != nullptr);
    }
}

} // namespace test_still_surfaces
