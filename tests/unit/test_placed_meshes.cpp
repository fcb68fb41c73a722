// PlacedMeshes: batches of rays among instances have, with every kernel, the bits of single rays
// that are tested against every triangle; and the trees leave out most triangles.
#include "check.h"
#include "scene/shape_set.h"
#include "shape/mesh_instance.h"
#include "shape/one_sided.h"
#include "shape/sphere.h"
#include "verify/hostile_rays.h"

#include <functional>

namespace test_placed_meshes {

using battery::RayList;
using meshes::Random;

namespace {

MeshDesc descOf(const std::vector<std::array<Vec3, 3>>& triangles, double scale) {
    MeshDesc mesh;
    for (const auto& triangle : triangles) {
        const auto n = static_cast<std::uint32_t>(mesh.points.size());
        for (const Vec3 p : triangle) mesh.points.push_back(toDouble(p) * scale);
        mesh.triangles.push_back({n, n + 1, n + 2});
    }
    return mesh;
}

MeshDesc meshOf(Random& random, std::uint32_t kind) {
    if (kind == 0) return meshes::icosphere(3);
    if (kind == 1) return meshes::torus(0.02, 48, 8);
    return descOf(meshes::soup(random, 400), 0.01); // huge ones are 100
}

struct Place {
    std::size_t mesh;
    std::vector<Transform> keys;
    int sides; // 1, 2: front or back only
    ShapeSet::Shadow shadow;
};

// Turned, stretched, mirrored; some flat or tiny, some moving, some one inside the other.
std::vector<Place> somePlaces(Random& random, std::size_t meshCount) {
    std::vector<Place> out;
    for (int n = 0; n < 14; ++n) {
        const double size = random.chance(0.1) ? 1e-8 : random.logUniform(0.03, 0.4);
        const auto key = [&] {
            Transform map = Transform::scale(size) * random.affine(2, 0);
            if (random.chance(0.05)) map = map * Transform::scale({1, 1, 0});
            return Transform::translate(random.inBox(0.3)) * map;
        };
        Place place{random.below(meshCount), {key()}, 0, ShapeSet::Shadow::Opaque};
        if (random.chance(0.3)) place.keys.push_back(key());
        if (random.chance(0.2)) // the common movement
            place.keys = {place.keys[0], Transform::translate(random.inBox(0.2)) * place.keys[0]};
        if (random.chance(0.3)) place.sides = 1 + static_cast<int>(random.below(2));
        if (random.chance(0.2)) place.shadow = ShapeSet::Shadow::SeeThrough;
        out.push_back(std::move(place));
    }
    return out;
}

// The scene with the trees of a kernel; without: every triangle of every shape is tested.
struct World {
    std::vector<std::unique_ptr<MeshGeometry>> geometries;
    ShapeSet set;

    World(const std::vector<MeshDesc>& descs, const std::vector<Place>& places, const Isa& kernel,
          bool withTrees) {
        for (const MeshDesc& desc : descs) {
            auto& geometry =
                geometries.emplace_back(std::make_unique<MeshGeometry>(toSharedGeometry(desc)));
            geometry->dropDegenerate();
            geometry->finish(withTrees, kernel);
        }
        set.add(std::make_unique<Sphere>(MovingTransform(Transform::translate({0.4, 0.1, 0.2})),
                                         0.2, 7, 0),
                ShapeSet::Shadow::Opaque);
        for (std::size_t i = 0; i < places.size(); ++i) {
            const Place& place = places[i];
            const MovingTransform motion{std::span<const Transform>(place.keys)};
            std::unique_ptr<const Shape> shape = std::make_unique<MeshInstance>(
                *geometries[place.mesh], motion, std::vector<std::uint32_t>{7},
                static_cast<std::uint32_t>(i + 1));
            if (place.sides != 0)
                shape = std::make_unique<OneSided>(std::move(shape), place.sides == 1
                                                                         ? OneSided::Side::Front
                                                                         : OneSided::Side::Back);
            set.add(std::move(shape), place.shadow);
        }
        set.finish(withTrees, kernel);
    }
};

// From a point for all and from anywhere, at corners and past them; some start on what they met.
RayList someRays(Random& random, const World& world, std::size_t count) {
    RayList batch;
    const Vec3 eye = toFloat(random.direction());
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t number = 1 + random.below(world.set.shapes.size() - 1);
        const Bounds& box = world.set.boxes[number];
        const auto inside = [&] {
            Vec3 p;
            for (std::size_t axis = 0; axis < 3; ++axis)
                p[axis] =
                    static_cast<float>(lerp(static_cast<double>(box.lo[axis]),
                                            static_cast<double>(box.hi[axis]), random.unit()));
            return p;
        };
        Ray ray;
        ray.time = static_cast<float>(random.unit());
        ray.org =
            random.chance(0.4) ? eye : toFloat(random.direction() * random.logUniform(0.3, 3));
        ray.dir = inside() - ray.org;
        if (random.chance(0.3)) {
            Hit hit;
            if (world.set.shapes[number]->intersect(ray, hit)) {
                ray.org = world.set.shapes[number]->surface(ray, hit).p;
                ray.dir = toFloat(random.direction());
            }
        }
        if (random.chance(0.05)) ray.dir[random.below(3)] = 0;
        if (random.chance(0.2)) ray.tMin = static_cast<float>(random.uniform(0, 1));
        if (random.chance(0.3)) ray.tMax = static_cast<float>(random.uniform(0.5, 1.5));
        if (random.chance(0.01)) ray.tMax = ray.tMin;
        if (random.chance(0.01)) ray.dir = {};
        if (random.chance(0.01)) ray.org.x = std::numeric_limits<float>::quiet_NaN();
        batch.push(ray);
    }
    return batch;
}

struct Tally {
    long long rays = 0, found = 0, shadows = 0;

    void print(std::uint64_t seed) const {
        std::printf("%lld rays, %lld hits, %lld shadows, seed %d\n", rays, found, shadows,
                    static_cast<int>(seed));
    }
};

// `where`: what the failing case says of itself.
void compareKernels(const std::vector<MeshDesc>& descs, const std::vector<Place>& places,
                    const World& plain, const RayList& batch, const std::string& where,
                    Tally& tally) {
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported()) continue;
        const World fast(descs, places, kernel, true);
        std::vector<Hit> hits;
        std::vector<std::uint8_t> hidden;
        fast.set.closest(batch.span(), hits);
        fast.set.occluded(batch.span(), hidden);
        for (std::size_t i = 0; i < hits.size(); ++i) {
            const Ray ray = batch.span()[i];
            const Hit hit = plain.set.closest(ray);
            const bool isHidden = plain.set.occluded(ray);
            CHECK_INFO(battery::haveSameBits(hits[i], hit) && (hidden[i] != 0) == isHidden,
                       kernel.name << ", " << where << ", ray " << i << ": t " << hits[i].t
                                   << " of " << hits[i].shape << " instead of " << hit.t << " of "
                                   << hit.shape << ", hidden " << int(hidden[i]));
            CHECK(fast.set.closest(ray) == hit && fast.set.occluded(ray) == isHidden);
            std::vector<Hit> through, throughPlain;
            fast.set.seeThroughHits(ray, through);
            plain.set.seeThroughHits(ray, throughPlain);
            CHECK(through == throughPlain);
            ++tally.rays;
            tally.found += hit.isHit();
            tally.shadows += isHidden;
        }
    }
}

} // namespace

TEST(placed_meshes_have_the_bits_of_single_rays) {
    constexpr std::uint64_t kSeed = 71;
    Random random(kSeed);
    Tally tally;
    for (int n = 0; n < check::scaled(6); ++n) {
        std::vector<MeshDesc> descs;
        for (std::uint32_t kind = 0; kind < 3; ++kind) descs.push_back(meshOf(random, kind));
        const std::vector<Place> places = somePlaces(random, descs.size());
        const World plain(descs, places, oneLane(), false);
        compareKernels(descs, places, plain, someRays(random, plain, 300),
                       "seed 71, scene " + std::to_string(n), tally);
    }
    tally.print(kSeed);
    CHECK(tally.found * 4 > tally.rays && tally.shadows * 4 > tally.rays);
}

// Triangles and places of whole numbers, and rays between these: within planes, along edges, from
// and to corners of several meshes.
TEST(placed_meshes_of_whole_numbers_have_the_bits_of_single_rays) {
    constexpr std::uint64_t kSeed = 73;
    Random random(kSeed);
    Tally tally;
    for (int n = 0; n < check::scaled(12); ++n) {
        const std::uint32_t half = 1 + random.below(4);
        std::vector<MeshDesc> descs;
        for (int m = 0; m < 2; ++m) {
            const std::size_t sizes[] = {4, 40, 200};
            descs.push_back(
                descOf(meshes::latticeSoup(random, 1 + random.below(sizes[n % 3]), half), 1));
        }
        std::vector<Place> places;
        for (std::size_t i = 1 + random.below(12); i > 0; --i) {
            const auto moved = [&](const Transform& map) {
                return Transform::translate(toDouble(meshes::latticePoint(random, half))) * map;
            };
            const Transform map =
                moved(meshes::quarterTurn(random) * Transform::scale(1 + random.below(2)));
            Place place{random.below(descs.size()), {map}, 0, ShapeSet::Shadow::Opaque};
            if (random.chance(0.2)) place.keys.push_back(moved(map));
            if (random.chance(0.3)) place.sides = 1 + static_cast<int>(random.below(2));
            if (random.chance(0.2)) place.shadow = ShapeSet::Shadow::SeeThrough;
            places.push_back(std::move(place));
        }
        const World plain(descs, places, oneLane(), false);
        RayList batch = battery::raysOnLattice(random, 2 * half, 600);
        for (float& time : batch.time) time = static_cast<float>(random.below(5)) * 0.25f;
        compareKernels(descs, places, plain, batch, "seed 73, scene " + std::to_string(n), tally);
    }
    tally.print(kSeed);
    CHECK(tally.found * 4 > tally.rays && tally.shadows * 4 > tally.rays);
}

// A kernel asks about few triangles that are not met, also where some triangle of the mesh is as
// long as all of it.
TEST(placed_meshes_leave_out_triangles) {
    const Isa& kernel = bestIsa();
    const PlacedKernel* const placed = kernel.placed;
    if (placed == nullptr) return;
    MeshDesc mesh = meshes::icosphere(4);
    const auto n = static_cast<std::uint32_t>(mesh.points.size());
    for (const Vec3d p : {Vec3d{-1, 0, -1}, Vec3d{1, 0, -1}, Vec3d{0, 0.01, -1}})
        mesh.points.push_back(p);
    mesh.triangles.push_back({n, n + 1, n + 2});
    MeshGeometry geometry = toSharedGeometry(mesh);
    geometry.finish(true, kernel);
    Random random(72);

    class Counter final : public PlacedQuery {
    public:
        Counter(const MeshInstance& instance, const RaySpan& rays) : at_(instance), rays_(rays) {}
        std::size_t tests = 0;
        float limit(std::uint32_t) const override { return kInfinityF; }
        void start(std::uint32_t slot, std::uint32_t ray) override { ray_[slot] = ray; }
        bool enter(std::uint32_t slot, std::uint32_t, float, TreeVisit& visit) override {
            visit = visits_[slot].emplace(at_, rays_[ray_[slot]]).inTree(1e30f);
            return true;
        }
        float test(std::uint32_t, std::uint32_t, const Vec3d&, const Vec3d&,
                   const Vec3d&) override {
            ++tests;
            return 0x1p99f;
        }
        float leave(std::uint32_t) override { return 1e30f; }

    private:
        const MeshInstance& at_;
        const RaySpan& rays_;
        std::array<std::uint32_t, PlacedKernel::kSlots> ray_{};
        std::array<std::optional<MeshInstance::Visit>, PlacedKernel::kSlots> visits_;
    };

    for (int trial = 0; trial < 10; ++trial) {
        const Transform map = Transform::scale(0.3) * random.affine(2, 0.5);
        const MeshInstance instance(geometry, MovingTransform(map), {7}, 5);
        PlacedTree tree;
        tree.boxes.add(instance.bounds(), 0, true, {});
        tree.boxes.extent = kSceneExtent;
        tree.boxes.build(kernel.nodeWidth());
        tree.whole = instance.bounds();
        tree.boxStack = stackSize(tree.boxes), tree.meshStack = geometry.wide.stackSize;
        RayList batch;
        std::vector<std::uint32_t> order;
        for (std::uint32_t i = 0; i < 200; ++i) {
            Ray ray;
            ray.org = toFloat(random.direction() * 3.0);
            ray.dir = toFloat(map.point(random.inBox(0.5))) - ray.org;
            batch.push(ray);
            order.push_back(i);
        }
        const RaySpan span = batch.span();
        Counter counter(instance, span);
        placed->closest(tree, counter, span, order);
        // Two of 5120 are met, and now and then the long one.
        CHECK_INFO(counter.tests >= 2 * order.size() && counter.tests < order.size() * 5 / 2,
                   "seed 72, map " << trial << ": " << counter.tests);
    }
}

} // namespace test_placed_meshes
