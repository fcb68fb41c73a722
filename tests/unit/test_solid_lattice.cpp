// Shapes of all kinds at whole numbers, turned by right angles, and rays between whole numbers:
// rays run within faces, along edges and sides, touch balls and tubes, start on what they ask, meet
// several shapes at once, and zeros have both signs. Batches have the bits of asking every shape.
#include "solid_checks.h"

namespace test_solid_lattice {

using meshes::Random;
using solid_checks::Rays;
using Shadow = ShapeSet::Shadow;

namespace {

struct Lattice {
    std::uint32_t half; // coordinates are up to this far from 0
    std::vector<std::unique_ptr<MeshGeometry>> geometries;

    Lattice(std::uint64_t seed, const Isa& kernel, ShapeSet& set)
        : half(1 + static_cast<std::uint32_t>(seed % 4)) {
        Random random(seed);
        const std::size_t count = 1 + seed * 5 % 32;
        Transform last;
        for (std::size_t n = 0; n < count; ++n) {
            const std::uint32_t kind = random.below(kit::kinds().size() + 2);
            const double size = 1 + random.below(2);
            Transform map = Transform::translate(toDouble(meshes::latticePoint(random, half))) *
                            meshes::quarterTurn(random) * Transform::scale(size);
            if (random.chance(0.15)) map = last; // ties
            last = map;
            std::unique_ptr<const Shape> shape =
                kind < kit::kinds().size() ? placed(random, kit::kinds()[kind], map)
                                           : piece(random, kernel, static_cast<std::uint32_t>(n));
            shape = solid_checks::sided(random, std::move(shape), 0.3);
            set.add(std::move(shape), random.chance(0.9) ? Shadow::Opaque : Shadow::SeeThrough);
        }
    }

private:
    // Some move by whole numbers.
    static std::unique_ptr<const Shape> placed(Random& random, const kit::Kind& kind,
                                               const Transform& map) {
        if (!random.chance(0.2)) return kind.make(MovingTransform(map));
        const Vec3d away = toDouble(meshes::latticePoint(random, 2));
        const std::vector<Transform> keys{map, Transform::translate(away) * map};
        return kind.make(MovingTransform(std::span<const Transform>(keys)));
    }
    std::unique_ptr<const Shape> piece(Random& random, const Isa& kernel, std::uint32_t object) {
        const auto triangles = meshes::latticeSoup(random, 1 + random.below(5), half);
        auto geometry = std::make_unique<MeshGeometry>(meshes::geometryOf(triangles, false));
        geometry->finish(true, kernel);
        geometries.push_back(std::move(geometry));
        return std::make_unique<Mesh>(*geometries.back(), std::vector<std::uint32_t>{0},
                                      std::vector<MeshPart>{{0, object}});
    }
};

Rays latticeRays(Random& random, const Lattice& lattice) {
    Rays rays = battery::raysOnLattice(random, 2 * lattice.half, 200);
    for (float& time : rays.time) time = static_cast<float>(random.below(5)) * 0.25f;
    return rays;
}

} // namespace

TEST(solid_shapes_of_whole_numbers_have_the_bits_of_single_rays) {
    const auto fill = [](std::uint64_t seed, const Isa& kernel, ShapeSet& set) {
        return Lattice(seed, kernel, set);
    };
    solid_checks::compareSets("lattice", 5101, 60, fill, latticeRays);
}

} // namespace test_solid_lattice
