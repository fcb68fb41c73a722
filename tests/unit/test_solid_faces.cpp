// Cubes, disks and planes by corners in registers, still or moving: batches have the bits of asking
// every shape, along faces and edges, from the inside, and where shapes are flat, huge or far away.
#include "solid_checks.h"

namespace test_solid_faces {

using meshes::Random;
using solid_checks::Rays;
using Shadow = ShapeSet::Shadow;

namespace {

// Points of a shape's edge, of its inside, and near it.
struct Face {
    Transform map;
    double radius; // of a disk
    enum class Of { Cube, Disk, Corners } of;
    Plane::Corners corners{};

    Vec3d place(Random& random) const {
        const double rounding = 1 + random.uniform(-1, 1) * 0x1p-21;
        const auto coordinate = [&] {
            switch (random.below(5)) {
            case 0: return 1.0;
            case 1: return -1.0;
            case 2: return random.chance(0.5) ? rounding : -rounding;
            case 3: return random.uniform(-1.1, 1.1);
            default: return random.uniform(-0.9, 0.9);
            }
        };
        if (of == Of::Cube) return map.point({coordinate(), coordinate(), coordinate()});
        if (of == Of::Disk) {
            const double angle = random.uniform(0, kTwoPi);
            const double around = radius * (random.chance(0.3)   ? 1.0
                                            : random.chance(0.3) ? rounding
                                                                 : random.uniform(0, 1.1));
            return map.point({around * std::cos(angle), around * std::sin(angle), 0});
        }
        const std::size_t i = random.below(4);
        const double u = random.chance(0.5) ? 0 : random.uniform(-0.05, 1), v = random.unit();
        const Vec3d middle = (corners[0] + corners[2]) * 0.5;
        return map.point(lerp(lerp(corners[i], corners[(i + 1) % 4], v), middle, u));
    }
};

// Convex; now and then a triangle, or all on a line.
Plane::Corners someCorners(Random& random) {
    Plane::Corners corners = kit::kQuad;
    const Vec3d a = random.direction(), b = cross(a, random.direction());
    if (random.chance(0.7)) {
        const double length = random.uniform(0.1, 1), width = random.uniform(0.1, 1);
        corners = {a * -length, b * -width, a * random.uniform(0.1, 2), b * random.uniform(0.1, 2)};
    }
    if (random.chance(0.1)) corners[1] = corners[0];
    if (random.chance(0.05)) corners = {a, a * 0.5, a * -1.0, a * 0.2};
    return corners;
}

// Two to four keys; lanes follow most of such movements.
MovingTransform moving(Random& random, const Transform& map) {
    std::vector<Transform> keys{map};
    const std::size_t more = 1 + random.below(3);
    for (std::size_t i = 0; i < more; ++i)
        keys.push_back(Transform::translate(random.inBox(0.1)) * map);
    if (random.chance(0.1)) keys.back() = keys.back() * Transform::scale(1.1);
    return MovingTransform(std::span<const Transform>(keys));
}

// Moved and scaled only, turned, sheared, mirrored, flattened; some twice in one place, some seen
// from one side.
std::vector<Face> addFaces(std::uint64_t seed, const Isa&, ShapeSet& set) {
    Random random(seed);
    const std::size_t count = 1 + seed * 7 % 40;
    std::vector<Face> faces;
    Transform last;
    for (std::size_t n = 0; n < count; ++n) {
        const double size = random.logUniform(1e-6, 0.5);
        const Vec3d factors = {size, size * random.logUniform(1e-3, 1), -size};
        const Transform turn =
            random.chance(0.4)
                ? Transform::scale(random.chance(0.5) ? factors : -factors)
                : random.affine(random.chance(0.5) ? 1 : 4, 0) * Transform::scale(size);
        const double away = random.chance(0.1) ? 1000 : random.chance(0.3) ? 0 : 0.9;
        Transform map = Transform::translate(random.inBox(away)) * turn;
        if (random.chance(0.05)) map = map * Transform::scale({1, 1, 0});
        if (random.chance(0.05)) map = Transform::scale(1e5) * map;
        if (random.chance(0.15)) map = last; // ties
        last = map;
        const double radius = random.chance(0.02) ? 0 : random.logUniform(1e-3, 2);
        const MovingTransform place =
            random.chance(0.3) ? moving(random, map) : MovingTransform(map);
        Face face{map, radius, static_cast<Face::Of>(random.below(3)), someCorners(random)};
        std::unique_ptr<const Shape> shape;
        if (face.of == Face::Of::Cube)
            shape = std::make_unique<Cube>(place, 0u, 0u);
        else if (face.of == Face::Of::Disk)
            shape = std::make_unique<Disk>(place, radius, 0u, 0u);
        else
            shape = std::make_unique<Plane>(place, face.corners, 0u, 0u);
        shape = solid_checks::sided(random, std::move(shape), 0.3);
        set.add(std::move(shape), random.chance(0.9) ? Shadow::Opaque : Shadow::None);
        faces.push_back(face);
    }
    return faces;
}

// From lamps, eyes, the inside, the faces themselves; within faces and along edges; to where they
// end on a face, or a rounding off it.
Rays faceRays(Random& random, const std::vector<Face>& faces) {
    Rays rays;
    const Vec3d lamp = random.direction() * random.uniform(0.5, 4);
    const bool fromLamp = random.chance(0.5);
    for (int i = 0; i < 200; ++i) {
        const Face& face = faces[random.below(faces.size())];
        const Vec3d from = fromLamp             ? lamp
                           : random.chance(0.2) ? random.inBox(2)
                                                : face.place(random);
        const Vec3d to = face.place(random);
        Ray ray = solid_checks::rayBetween(random, from, to, fromLamp);
        if (random.chance(0.1)) // along an axis of the shape, or nearly
            ray.dir = toFloat(face.map.vector({random.chance(0.5) ? 1.0 : 0.0, 0, 1}) +
                              random.direction() *
                                  (random.chance(0.5) ? 0 : random.logUniform(1e-12, 1e-6)));
        if (random.chance(0.1)) {
            ray.dir[random.below(3)] = random.chance(0.5) ? 0.0f : -0.0f;
            if (random.chance(0.5)) ray.dir[random.below(3)] = 0;
        }
        const float times[] = {0, 1, static_cast<float>(random.unit()), 0.5f};
        ray.time = times[random.below(4)];
        rays.push(ray);
    }
    return rays;
}

} // namespace

TEST(solid_faces_have_the_bits_of_single_rays) {
    solid_checks::compareSets("faces", 2401, 100, addFaces, faceRays);
}

// The rims of faces belong to them: from straight above, and a rounding off.
TEST(solid_faces_have_their_rims) {
    const Plane::Corners square = {Vec3d{-1, -1, 0}, Vec3d{1, -1, 0}, Vec3d{1, 1, 0},
                                   Vec3d{-1, 1, 0}};
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported()) continue;
        ShapeSet set;
        set.add(std::make_unique<Disk>(Transform(), 1, 0u, 0u), Shadow::Opaque);
        set.add(std::make_unique<Plane>(Transform::translate({4, 0, 0}), square, 0u, 0u),
                Shadow::Opaque);
        set.finish(true, kernel);
        for (const float x :
             {-1.0f, 1.0f, nextUp(1.0f), -nextUp(1.0f), 3.0f, nextDown(3.0f), 5.0f, nextUp(5.0f)}) {
            Rays rays;
            for (int i = 0; i < 20; ++i) rays.push({{x, 0, 2}, {0, 0, -1}});
            std::vector<Hit> hits;
            std::vector<std::uint8_t> hidden;
            set.closest(rays.span(), hits);
            set.occluded(rays.span(), hidden);
            const bool met = std::fabs(x) <= 1 || (x >= 3 && x <= 5);
            for (std::size_t i = 0; i < 20; ++i)
                CHECK_INFO(hits[i].isHit() == met && hidden[i] == met, kernel.name << ' ' << x);
        }
    }
}

// On a unit cube all can be told beforehand: rays on a face's plane, along an edge, and what they
// hit where two cubes share a face.
TEST(solid_cubes_on_their_faces) {
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported()) continue;
        ShapeSet set;
        set.add(std::make_unique<Cube>(Transform::translate({2, 0, 0}), 0u, 0u), Shadow::Opaque);
        set.add(std::make_unique<Cube>(Transform(), 0u, 0u), Shadow::Opaque);
        set.finish(true, kernel);
        const struct {
            Ray ray;
            std::uint32_t shape, part;
            float t;
        } cases[] = {
            {{{-3, 1, 1}, {1, 0, 0}}, 1, 0, 2},     // along an edge
            {{{-3, 1, 0}, {1, 0, -0.0f}}, 1, 0, 2}, // in a face
            {{{-3, nextUp(1.0f), 0}, {1, 0, 0}}, Hit::kNoShape, 0, kInfinityF},
            {{{1, 0, 5}, {0, 0, -1}}, 0, 5, 4},   // down the shared face: the lower number
            {{{0, 0, 0}, {1, 0, 0}}, 0, 0, 1},    // from the inside to the shared face
            {{{0, 0, 0}, {0, -1, 0}}, 1, 2, 1},   // from the inside
            {{{-2, -2, -2}, {1, 1, 1}}, 1, 0, 1}, // into a corner: the first axis
            {{{-2, -2, 0}, {1, 1, 0}}, 1, 0, 1},  // into an edge
            {{{0, 0, 0}, {0, 1, 1}}, 1, 3, 1},    // out of one
        };
        for (const auto& wanted : cases) {
            Rays rays; // alone in a register, and filling it
            for (int i = 0; i < 20; ++i) rays.push(wanted.ray);
            std::vector<Hit> hits;
            set.closest(rays.span(), hits);
            for (const Hit& hit : hits)
                CHECK_INFO(hit.shape == wanted.shape && hit.t == wanted.t &&
                               hit.prim == wanted.part,
                           kernel.name << ": shape " << hit.shape << " part " << hit.prim << " at "
                                       << hit.t << ", not " << wanted.shape << ' ' << wanted.part
                                       << ' ' << wanted.t);
        }
    }
}

} // namespace test_solid_faces
