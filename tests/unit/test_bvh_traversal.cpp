// Traversal of the tree over boxes loses nothing, and goes from front to back.
#include "accel/bvh.h"
#include "check.h"
#include "unit/bvh_kit.h"

#include <utility>

namespace test_bvh_traversal {

using bvh_kit::boxAt;
using bvh_kit::Boxes;
using bvh_kit::hostile;
using bvh_kit::Named;
using bvh_kit::randomBoxes;
using meshes::Random;

namespace {

Vec3 someDirection(Random& random) {
    Vec3 d = toFloat(random.direction());
    if (random.chance(0.2)) d[random.below(3)] = 0;
    if (random.chance(0.1)) d[random.below(3)] = random.chance(0.5) ? 0.0f : -0.0f;
    return maxAbs(d) > 0 ? d : Vec3{1, 0, 0};
}

} // namespace

// Boxes as primitives, hit where the ray enters them: the nearest of the tree is the nearest of
// all, ties by number, though leaves that start behind the best are skipped.
TEST(bvh_traversal_finds_the_nearest) {
    std::size_t rays = 0, wrong = 0;
    std::vector<Named> inputs = hostile();
    Random random(4);
    inputs.push_back({"random", randomBoxes(random, 2000)});
    for (Named& input : inputs) {
        Boxes& boxes = input.boxes;
        if (boxes.empty()) continue;
        if (boxes.size() > 600) { // for the brute force
            for (std::size_t i = boxes.size() - 1; i > 0; --i)
                std::swap(boxes[i], boxes[random.below(i + 1)]);
            boxes.resize(600);
        }
        const Bvh bvh = buildBvh(boxes);
        const double extent = maxAbs(merge(bvh.nodes[0].box, {}).hi);
        for (int i = 0; i < 2000; ++i) {
            const Bounds& aim = boxes[random.below(boxes.size())];
            const Vec3 org =
                toFloat(toDouble(aim.centre()) +
                        random.inBox(max(1e-3, static_cast<double>(maxAbs(aim.size())) * 4)));
            Vec3 dir = someDirection(random);
            if (random.chance(0.5) && maxAbs(aim.centre() - org) > 0) dir = aim.centre() - org;
            const Ray ray{org, dir};
            if (!isTraceable(ray)) continue;
            const RaySetup setup(org, dir, static_cast<float>(extent));
            const auto nearest = [&](auto&& forEach) {
                float best = kInfinityF;
                std::uint32_t prim = 0xffffffffu;
                forEach([&](std::uint32_t id, float& zCut) {
                    float z = 0;
                    if (!setup.enters(boxes[id], kInfinityF, z)) return false;
                    if (z < best || (z == best && id < prim)) {
                        best = z, prim = id;
                        zCut = min(zCut, best); // exact: entry depths are monotone
                    }
                    return false;
                });
                return std::pair(best, prim);
            };
            const auto fromTree =
                nearest([&](auto&& leaf) { traverse(bvh, setup, kInfinityF, leaf); });
            const auto fromAll = nearest([&](auto&& leaf) {
                float unused = kInfinityF;
                for (std::uint32_t id = 0; id < boxes.size(); ++id) leaf(id, unused);
            });
            ++rays;
            if (fromTree != fromAll) ++wrong;
            // And without a cut: everything that can be entered is called exactly once.
            if (i % 4 == 0) {
                std::vector<int> calls(boxes.size(), 0);
                traverse(bvh, setup, kInfinityF, [&](std::uint32_t id, float&) {
                    ++calls[id];
                    return false;
                });
                float z = 0;
                for (std::size_t id = 0; id < boxes.size(); ++id) {
                    if (calls[id] > 1) ++wrong;
                    if (calls[id] == 0 && setup.enters(boxes[id], kInfinityF, z)) ++wrong;
                }
            }
        }
    }
    std::printf("%zu rays, seed 4\n", rays);
    CHECK(rays > 20000);
    CHECK_EQUAL(wrong, 0u);
}

// Boxes of a grid with gaps wider than the pads: each leaf's box is left before the next is
// entered, so leaves come in the order of their entry. (Overlapping nodes have no such order.) true
// stops.
TEST(bvh_traversal_is_front_to_back) {
    Random random(5);
    Boxes boxes;
    for (int x = -5; x <= 5; ++x)
        for (int y = -5; y <= 5; ++y)
            for (int z = -5; z <= 5; ++z)
                boxes.push_back(boxAt(Vec3d{x * 1.0, y * 1.0, z * 1.0} * 0.1, 0.04));
    const Bvh bvh = buildBvh(boxes);
    std::vector<std::uint32_t> leafOf(boxes.size());
    for (std::uint32_t n = 0; n < bvh.nodes.size(); ++n)
        for (std::uint32_t i = 0; i < bvh.nodes[n].count; ++i)
            leafOf[bvh.primIds[bvh.nodes[n].first + i]] = n;
    std::size_t disorder = 0, calls = 0, afterStop = 0, behindCut = 0;
    for (int i = 0; i < 10000; ++i) {
        const Vec3 org = toFloat(random.inBox(1)), dir = someDirection(random);
        const RaySetup setup(org, dir, 1);
        const auto entry = [&](std::uint32_t id) {
            float z = -1;
            setup.enters(bvh.nodes[leafOf[id]].box, kInfinityF, z);
            return z;
        };
        float last = 0;
        traverse(bvh, setup, kInfinityF, [&](std::uint32_t id, float&) {
            ++calls;
            if (entry(id) < last) ++disorder;
            last = entry(id);
            return false;
        });
        int after = 0;
        traverse(bvh, setup, kInfinityF, [&](std::uint32_t, float&) { return ++after == 1; });
        if (after > 1) ++afterStop;
        // Leaves behind the cut are not called, also when it comes down on the way.
        float cut = static_cast<float>(random.uniform(0, 1));
        traverse(bvh, setup, cut, [&](std::uint32_t id, float& zCut) {
            if (entry(id) > cut) ++behindCut;
            if (random.chance(0.2)) cut = zCut = min(zCut, entry(id) + 0.1f);
            return false;
        });
    }
    std::printf("%zu calls, seed 5\n", calls);
    CHECK(calls > 20000);
    CHECK_EQUAL(disorder, 0u);
    CHECK_EQUAL(afterStop, 0u);
    CHECK_EQUAL(behindCut, 0u);
}

} // namespace test_bvh_traversal
