// The shapes of a scene: their order, what is merged and what is shared, and that nothing depends
// on how many threads prepare them.
#include "scene/make_shapes.h"

#include "base/text.h"
#include "check.h"
#include "scene/scene.h"

#include <random>
#include <string>

namespace test_make_shapes {

namespace {

// A wavy sheet of 2 (side - 1)^2 triangles, one of which has no area.
MeshDesc sheet(const std::string& name, std::uint32_t side) {
    MeshDesc mesh;
    mesh.name = name;
    for (std::uint32_t i = 0; i < side * side; ++i) {
        const double x = i / side, y = i % side;
        mesh.points.push_back(
            {x / side, y / side, 0.1 * exact::sin(0.7 * x) * exact::cos(0.4 * y)});
    }
    for (std::uint32_t i = 0; i + side < side * side; ++i) {
        if (i % side == side - 1) continue;
        mesh.triangles.push_back({i, i + 1, i + side + 1});
        mesh.triangles.push_back({i, i + side + 1, i + side});
    }
    mesh.triangles.push_back({0, 1, 1});
    return mesh;
}
ObjectDesc object(ObjectDesc::Kind kind, double x, Handle material) {
    ObjectDesc out;
    out.kind = kind;
    out.worldFromObject = {{1, 0, 0, x, 0, 1, 0, 0.3 * x, 0, 0, 1, 0}};
    out.materials = {material};
    return out;
}
ObjectDesc meshObject(Handle mesh, double x, Handle material) {
    ObjectDesc out = object(ObjectDesc::Kind::Mesh, x, material);
    out.mesh = mesh;
    return out;
}
// Meshes 0 and 1 are used twice, 2 is large, 3 moves; material 1 is see-through.
SceneDesc mixed(int spheres) {
    SceneDesc desc;
    desc.cameras.resize(1);
    desc.materials.resize(2);
    desc.materials[1].opacity = 0.5;
    desc.meshes = {sheet("a", 20), sheet("b", 30), sheet("large", 200), sheet("moving", 9)};
    for (int i = 0; i < spheres; ++i) {
        ObjectDesc sphere = object(ObjectDesc::Kind::Sphere, 0.001 * i, i % 2);
        sphere.radius = 0.01;
        desc.objects.push_back(sphere);
        if (i == 1)
            for (const Handle mesh : {0, 1, 0, 2, 1})
                desc.objects.push_back(meshObject(mesh, -1.0 - mesh, mesh % 2));
    }
    desc.objects.push_back(meshObject(3, 5, 0));
    desc.objects.back().worldFromObject.push_back(kIdentityRows);
    return desc;
}
Stats statsOf(const Scene& scene) {
    Stats stats;
    scene.describe(stats);
    return stats;
}
RenderSettings settingsOf(const SceneDesc& desc, int threads, std::uint64_t copied) {
    RenderSettings settings;
    settings.picture = desc.settings;
    settings.threads = threads;
    settings.copiedTriangles = copied;
    return settings;
}

} // namespace

TEST(make_shapes_order_and_counts) {
    const SceneDesc desc = mixed(3);
    // 3 spheres, instances in the order of their objects (4 that share and one that moves), then
    // what is merged.
    const Scene shared(desc, {"t", ""}, settingsOf(desc, 1, 0));
    const auto& shapes = shared.shapes();
    CHECK_INFO(shapes.shapes.size() == 3 + 5 + 1, shapes.shapes.size());
    using Shadow = ShapeSet::Shadow;
    constexpr Shadow kOpaque = Shadow::Opaque, kThrough = Shadow::SeeThrough;
    CHECK((shapes.shadows == std::vector<Shadow>{kOpaque, kThrough, kOpaque, kOpaque, kThrough,
                                                 kOpaque, kThrough, kOpaque, kOpaque}));
    CHECK(shared.moves());
    // Each mesh has one triangle without area, which counts once.
    CHECK_INFO(statsOf(shared).degeneratePrimitives == 4, statsOf(shared).degeneratePrimitives);

    // With room for the copies: one mesh of opaque ones, one of see-through ones.
    const Scene copied(desc, {"t", ""}, settingsOf(desc, 1, 1 << 18));
    CHECK_INFO(copied.shapes().shapes.size() == 3 + 1 + 2, copied.shapes().shapes.size());
    CHECK_INFO(statsOf(copied).degeneratePrimitives == 4, statsOf(copied).degeneratePrimitives);

    RenderSettings still = settingsOf(desc, 1, 1 << 18);
    still.switches.motionBlur = false;
    const Scene stopped(desc, {"t", ""}, still);
    CHECK(!stopped.moves());
    CHECK_INFO(stopped.shapes().shapes.size() == 3 + 2, stopped.shapes().shapes.size());
}

// A description that is handed over is the same scene, and its large parts are gone.
TEST(make_shapes_let_go_of_the_description) {
    const SceneDesc desc = mixed(300);
    for (const std::uint64_t copied : {0u, 1u << 18}) {
        const RenderSettings settings = settingsOf(desc, 2, copied);
        const Scene kept(desc, {"t", ""}, settings);
        SceneDesc spent = desc;
        const Scene handed(std::move(spent), {"t", ""}, settings);
        // What is left of it may be asked for: NOLINTNEXTLINE(bugprone-use-after-move)
        CHECK(spent.objects.capacity() == 0 && spent.meshes.capacity() == 0);
        CHECK(kept.shapes().boxes == handed.shapes().boxes &&
              kept.shapes().shadows == handed.shapes().shadows);
        CHECK_EQUAL(statsOf(kept).accel.sah, statsOf(handed).accel.sah);
        CHECK(kept.moves() == handed.moves() &&
              kept.pathLights().size() == handed.pathLights().size());
        for (std::size_t i = 0; i < kept.features().size(); ++i)
            CHECK(kept.features()[i].needed == handed.features()[i].needed);
    }
}

TEST(make_shapes_do_not_depend_on_threads) {
    const SceneDesc desc = mixed(9000); // spheres in three jobs
    for (const std::uint64_t copied : {0u, 1u << 18})
        for (const Isa* kernel : {&oneLane(), &bestIsa()}) {
            RenderSettings settings = settingsOf(desc, 1, copied);
            settings.isa = kernel;
            const Scene one(desc, {"t", ""}, settings);
            for (const int threads : {2, 5}) {
                settings.threads = threads;
                const Scene some(desc, {"t", ""}, settings);
                const std::string what =
                    cat(threads, " threads, ", kernel->name, ", copied ", copied);
                const Stats a = statsOf(one), b = statsOf(some);
                CHECK_INFO(a.accel.nodes == b.accel.nodes && a.accel.leaves == b.accel.leaves &&
                               a.accel.sah == b.accel.sah && a.accel.bytes == b.accel.bytes &&
                               a.accel.triangles == b.accel.triangles &&
                               a.degeneratePrimitives == b.degeneratePrimitives,
                           what);
                CHECK_INFO(one.shapes().boxes == some.shapes().boxes &&
                               one.shapes().shadows == some.shapes().shadows,
                           what);
                std::mt19937 random(5);
                const auto upTo = [&](float most) {
                    return std::uniform_real_distribution<float>(-most, most)(random);
                };
                int hits = 0;
                for (int i = 0; i < 2000; ++i) {
                    const Bounds& box = one.shapes().boxes[random() % one.shapes().boxes.size()];
                    const Vec3 from{upTo(1), upTo(1), 2};
                    const Ray ray{from, box.centre() - from};
                    const Hit x = one.shapes().closest(ray), y = some.shapes().closest(ray);
                    hits += x.isHit() ? 1 : 0;
                    CHECK_INFO(x == y, what << ", ray " << i);
                }
                CHECK_INFO(hits > 1000, hits << " of 2000 rays, " << what);
            }
        }
}

} // namespace test_make_shapes
