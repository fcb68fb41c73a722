// What kernels know of tubes and of meshes of a few triangles: batches have the bits of asking
// every shape, where filters might leave out too much or be too certain.
#include "shape/cone.h"
#include "shape/cube.h"
#include "shape/cylinder.h"
#include "shape/mesh.h"
#include "shape/sphere.h"
#include "solid_checks.h"

#include <algorithm>

namespace test_solid_forms {

using meshes::Random;
using solid_checks::Rays;
using solid_checks::sided;
using Shadow = ShapeSet::Shadow;

namespace {

struct Tube {
    Transform map;
    double radius;
    Vec3d at(double angle, double z, double scale = 1) const {
        return map.point({std::cos(angle) * radius * scale, std::sin(angle) * radius * scale, z});
    }
};

// Straight ones, stretched ones, needles of 1e-4 to disks of 1e4 times their length, and some
// without size; open and closed, as cylinders and as cones.
std::vector<Tube> addTubes(std::uint64_t seed, const Isa&, ShapeSet& set) {
    Random random(seed);
    const std::size_t count = 1 + seed * 7 % 40;
    std::vector<Tube> tubes;
    for (std::size_t n = 0; n < count; ++n) {
        const double size = random.logUniform(1e-6, 0.5);
        const Transform turn = random.affine(random.chance(0.7) ? 1 : 4, 0);
        const double radius = random.chance(0.02)  ? 0
                              : random.chance(0.2) ? random.logUniform(1e-4, 1e4)
                                                   : random.uniform(0.05, 1.5);
        const Transform map = Transform::translate(random.inBox(random.chance(0.1) ? 20 : 0.9)) *
                              turn * Transform::scale(size);
        tubes.push_back({map, radius});
        const bool caps = random.chance(0.4);
        std::unique_ptr<const Shape> shape;
        if (random.chance(0.7))
            shape = std::make_unique<Cylinder>(map, radius, caps, 0u, 0u);
        else
            shape =
                std::make_unique<Cone>(map, radius, radius * random.uniform(0, 1), caps, 0u, 0u);
        shape = sided(random, std::move(shape), 0.3);
        set.add(std::move(shape), random.chance(0.9) ? Shadow::Opaque : Shadow::None);
    }
    return tubes;
}

// Rays through the middle, along the side and a few roundings off it, past the rims, nearly along
// the axis; from lamps, from the inside, from the surface and to where they end on it.
Rays tubeRays(Random& random, const std::vector<Tube>& tubes) {
    Rays rays;
    const Vec3d lamp = random.direction() * random.uniform(0.5, 4);
    const bool fromLamp = random.chance(0.5);
    for (int i = 0; i < 200; ++i) {
        const Tube& tube = tubes[random.below(tubes.size())];
        const double rounding = 1 + random.uniform(-1, 1) * 0x1p-21;
        const auto place = [&] {
            const double angle = random.uniform(0, 6.3);
            switch (random.below(5)) {
            case 0: return tube.at(angle, random.uniform(-1, 1));
            case 1: return tube.at(angle, random.uniform(-1, 1), rounding);
            case 2: return tube.at(angle, rounding, random.chance(0.5) ? 1 : 0.5);
            case 3: return tube.at(angle, random.uniform(-1.2, 1.2), random.uniform(0, 0.999));
            default: return tube.at(angle, -rounding, rounding);
            }
        };
        const Vec3d from = fromLamp ? lamp : random.chance(0.2) ? random.inBox(2) : place();
        const Vec3d to = place();
        Ray ray = solid_checks::rayBetween(random, from, to, fromLamp);
        if (random.chance(0.05))
            ray.dir = toFloat(tube.map.vector({0, 0, 1}) +
                              random.direction() * random.logUniform(1e-12, 1e-6));
        rays.push(ray);
    }
    return rays;
}

// Chains as of wire models, which fill the tree with thin diagonal boxes: straight tubes, most seen
// from outside only and open, with balls and now and then a cube where they end; many twice.
std::vector<Tube> addChains(std::uint64_t seed, const Isa&, ShapeSet& set) {
    Random random(seed);
    const std::size_t count = 100 + seed * 7 % 200;
    std::vector<Tube> tubes;
    for (std::size_t n = 0; n < count; ++n) {
        const double size = random.logUniform(0.02, 0.4), radius = random.uniform(0.05, 0.4);
        const Transform turn = random.affine(1, 0);
        const Transform map =
            Transform::translate(random.inBox(0.9)) * turn * Transform::scale(size);
        tubes.push_back({map, radius});
        for (std::size_t copies = random.chance(0.2) ? 2 : 1; copies > 0; --copies) {
            auto tube = std::make_unique<Cylinder>(map, radius, random.chance(0.1), 0u, 0u);
            set.add(sided(random, std::move(tube), 0.7),
                    random.chance(0.9) ? Shadow::Opaque : Shadow::None);
        }
        const Vec3d end = map.point({0, 0, 1});
        if (random.chance(0.9))
            set.add(std::make_unique<Sphere>(Transform::translate(end), radius * size, 0u, 0u),
                    Shadow::Opaque);
        else
            set.add(std::make_unique<Cube>(
                        Transform::translate(end) * Transform::scale(radius * size), 0u, 0u),
                    Shadow::Opaque);
    }
    return tubes;
}

// Small meshes of one to five triangles: those of five are no facets.
struct Pieces {
    std::vector<std::unique_ptr<MeshGeometry>> geometries;
    std::vector<std::array<Vec3, 3>> triangles;

    Pieces(std::uint64_t seed, const Isa& kernel, ShapeSet& set) {
        Random random(seed);
        const std::size_t count = 1 + seed * 5 % 24;
        for (std::size_t n = 0; n < count; ++n) {
            std::vector<std::array<Vec3, 3>> piece;
            if (random.chance(0.5)) {
                piece = quad(random);
            } else {
                piece = meshes::soup(random, 1 + random.below(5));
            }
            if (random.chance(0.1)) piece.push_back(piece[0]); // a tie
            triangles.insert(triangles.end(), piece.begin(), piece.end());
            auto geometry = std::make_unique<MeshGeometry>(meshes::geometryOf(piece, false));
            geometry->finish(true, kernel);
            std::unique_ptr<const Shape> mesh =
                std::make_unique<Mesh>(*geometry, std::vector<std::uint32_t>{0},
                                       std::vector<MeshPart>{{0, static_cast<std::uint32_t>(n)}});
            mesh = sided(random, std::move(mesh), 0.5);
            set.add(std::move(mesh), random.chance(0.8) ? Shadow::Opaque : Shadow::None);
            geometries.push_back(std::move(geometry));
        }
    }

private:
    // Two triangles that share a side; many lie in planes of an axis, as floors do.
    static std::vector<std::array<Vec3, 3>> quad(Random& random) {
        const Vec3d at = random.inBox(0.5);
        Vec3d a = random.direction() * random.logUniform(1e-3, 2), b = cross(a, random.direction());
        if (random.chance(0.5)) a = {a.x, 0, 0}, b = {0, a.x, 0};
        const Vec3 p = toFloat(at), q = toFloat(at + a), r = toFloat(at + a + b),
                   s = toFloat(at + b);
        return {{p, q, r}, {p, r, s}};
    }
};

// Through and to insides, sides, corners and a few roundings off them; also within the plane.
Rays pieceRays(Random& random, const Pieces& pieces) {
    Rays rays;
    const auto& triangles = pieces.triangles;
    const Vec3d lamp = random.direction() * random.uniform(0.1, 4);
    const bool fromLamp = random.chance(0.5);
    const auto place = [&] {
        const auto& v = triangles[random.below(triangles.size())];
        double a = random.unit(), b = random.unit() * (1 - a);
        if (random.chance(0.4)) b = 1 - a;                         // on a side
        if (random.chance(0.2)) a = random.chance(0.5), b = 1 - a; // at a corner
        const Vec3d p = toDouble(v[0]) * (1 - a - b) + toDouble(v[1]) * a + toDouble(v[2]) * b;
        return random.chance(0.3) ? p + random.direction() * 0x1p-23 : p;
    };
    for (int i = 0; i < 200; ++i) {
        const Vec3d from = fromLamp ? lamp : random.chance(0.3) ? place() : random.inBox(2);
        Ray ray = kit::rayFrom(from, place() - toDouble(toFloat(from)));
        if (fromLamp || random.chance(0.3))
            ray.tMax = static_cast<float>(1 + random.uniform(-2, 1) * 0x1p-22);
        if (random.chance(0.05)) ray.dir[random.below(3)] = 0;
        if (random.chance(0.1)) ray.tMin = static_cast<float>(random.logUniform(0.01, 1));
        rays.push(ray);
    }
    return rays;
}

} // namespace

TEST(solid_tubes_have_the_bits_of_single_rays) {
    solid_checks::compareSets("tubes", 2201, 60, addTubes, tubeRays);
}

// Rays that go apart wait with solids of many kinds and are met by others' registers.
TEST(solid_chains_have_the_bits_of_single_rays) {
    solid_checks::compareSets("chains", 3301, 24, addChains, tubeRays);
}

TEST(solid_facets_have_the_bits_of_single_rays) {
    const auto fill = [](std::uint64_t seed, const Isa& kernel, ShapeSet& set) {
        return Pieces(seed, kernel, set);
    };
    solid_checks::compareSets("facets", 2301, 60, fill, pieceRays);
}

// A floor is no batch of its own where a kernel takes it as facets.
TEST(solid_facets_are_no_batches) {
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported()) continue;
        for (const std::size_t count : {std::size_t{1}, Facets::kMost, Facets::kMost + 1}) {
            Random random(5);
            std::vector<std::array<Vec3, 3>> fan;
            for (std::size_t i = 0; i < count; ++i) {
                const auto x = static_cast<float>(i);
                fan.push_back({Vec3{0, 0, 0}, Vec3{x, 1, 0}, Vec3{x + 1, 1, 0}});
            }
            MeshGeometry geometry = meshes::geometryOf(fan, false);
            geometry.finish(true, kernel);
            ShapeSet set;
            set.add(std::make_unique<Mesh>(geometry, std::vector<std::uint32_t>{0},
                                           std::vector<MeshPart>{{0, 0}}),
                    Shadow::Opaque);
            set.finish(true, kernel);
            CHECK_INFO(set.batched.size() == (kernel.triangles != nullptr && count > Facets::kMost),
                       kernel.name << ' ' << count);
        }
    }
}

} // namespace test_solid_forms
