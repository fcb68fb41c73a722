// The tree of an instance is there to leave out triangles: all but those that a ray meets.
#include "shape/instance_filter.h"

#include "check.h"
#include "verify/meshes.h"

namespace test_instance_filter {

using meshes::Random;

// The tree is there to leave out triangles: of all but tiny and flat instances nearly all.
TEST(instance_tree_leaves_out_triangles) {
    const MeshDesc mesh = meshes::icosphere(4);
    MeshGeometry shared = toSharedGeometry(mesh);
    shared.finish(true);
    Random random(63);
    for (int n = 0; n < 20; ++n) {
        const Transform map = Transform::scale(0.3) * random.affine(2, 0.5);
        const InstanceFilter filter(shared, map);
        std::size_t tested = 0;
        constexpr std::size_t kRays = 100;
        for (std::size_t i = 0; i < kRays; ++i) {
            Ray ray;
            ray.org = toFloat(random.direction() * 3.0);
            ray.dir = toFloat(map.point(random.inBox(0.5))) - ray.org;
            const auto treeRay = filter.treeRay(ray, kSceneExtent);
            CHECK(treeRay.has_value());
            treeRay->traverse(shared, kInfinityF, [&](std::uint32_t triangle, float&) {
                const auto& c = shared.triangles[triangle];
                tested +=
                    treeRay->mayMeet(shared.points[c[0]], shared.points[c[1]], shared.points[c[2]]);
                return false;
            });
        }
        // Two of 5120 are met, 2.04 to 2.2 tested.
        CHECK_INFO(tested < kRays * 5 / 2, "seed 63, map " << n << ": " << tested);
    }
    // What is flat, or vanishes beside the scene, has no ray in the tree.
    const Ray ray{{0, 0, 3}, {0.1f, 0.2f, -1}};
    for (const Transform& map : {Transform::scale({1, 1, 0}), Transform::scale(1e-9)})
        CHECK(!InstanceFilter(shared, map).treeRay(ray, kSceneExtent));
}

} // namespace test_instance_filter
