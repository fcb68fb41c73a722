// The walk of one ray through a tree over boxes loses nothing, and goes from front to back.
#include "accel/kernels/wide_walk.h"
#include "check.h"
#include "unit/hostile_boxes.h"

#include <utility>

namespace test_wide_walk {

using hostile_boxes::boxAt;
using hostile_boxes::Boxes;
using hostile_boxes::Named;
using hostile_boxes::randomBoxes;
using meshes::Random;

namespace {

Vec3 someDirection(Random& random) {
    Vec3 d = toFloat(random.direction());
    if (random.chance(0.2)) d[random.below(3)] = 0;
    if (random.chance(0.1)) d[random.below(3)] = random.chance(0.5) ? 0.0f : -0.0f;
    return maxAbs(d) > 0 ? d : Vec3{1, 0, 0};
}

SolidTree treeOf(const Boxes& boxes, int width) {
    SolidTree tree;
    for (std::uint32_t i = 0; i < boxes.size(); ++i) tree.add(boxes[i], i, true, {});
    tree.build(width);
    return tree;
}

} // namespace

// Boxes as primitives, hit where the ray enters them: the nearest of the tree is the nearest of
// all, ties by number, though leaves that start behind the best are skipped.
TEST(wide_walk_finds_the_nearest) {
    std::size_t rays = 0, wrong = 0;
    std::vector<Named> inputs = hostile_boxes::all();
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
        const SolidTree trees[] = {treeOf(boxes, 8), treeOf(boxes, 16)};
        const double extent = max(maxAbs(trees[0].around.lo), maxAbs(trees[0].around.hi));
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
            const SolidTree& tree = trees[i % 2];
            const auto fromTree = nearest([&](auto&& leaf) {
                float zCut = kInfinityF;
                traverse(tree, setup, zCut, leaf);
            });
            const auto fromAll = nearest([&](auto&& leaf) {
                float unused = kInfinityF;
                for (std::uint32_t id = 0; id < boxes.size(); ++id) leaf(id, unused);
            });
            ++rays;
            if (fromTree != fromAll) ++wrong;
            // And without a cut: everything that can be entered is called exactly once.
            if (i % 4 < 2) {
                std::vector<int> calls(boxes.size(), 0);
                float noCut = kInfinityF;
                traverse(tree, setup, noCut, [&](std::uint32_t id, float&) {
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

// Boxes of a grid with gaps wider than the pads: each is left before the next is entered, so they
// come in the order of their entry. (Overlapping nodes have no such order.) True stops.
TEST(wide_walk_is_front_to_back) {
    Random random(5);
    Boxes boxes;
    for (int x = -5; x <= 5; ++x)
        for (int y = -5; y <= 5; ++y)
            for (int z = -5; z <= 5; ++z)
                boxes.push_back(boxAt(Vec3d{x * 1.0, y * 1.0, z * 1.0} * 0.1, 0.04));
    const SolidTree trees[] = {treeOf(boxes, 8), treeOf(boxes, 16)};
    std::size_t disorder = 0, calls = 0, afterStop = 0, behindCut = 0;
    for (int i = 0; i < 10000; ++i) {
        const SolidTree& tree = trees[i % 2];
        const Vec3 org = toFloat(random.inBox(1)), dir = someDirection(random);
        const RaySetup setup(org, dir, 1);
        const auto entry = [&](std::uint32_t id) {
            float z = -1;
            setup.enters(boxes[id], kInfinityF, z);
            return z;
        };
        float last = 0, noCut = kInfinityF;
        traverse(tree, setup, noCut, [&](std::uint32_t id, float&) {
            ++calls;
            if (entry(id) < last) ++disorder;
            last = entry(id);
            return false;
        });
        int after = 0;
        traverse(tree, setup, noCut, [&](std::uint32_t, float&) { return ++after == 1; });
        if (after > 1) ++afterStop;
        // What is behind the cut is not called, also when it comes down on the way.
        float cut = static_cast<float>(random.uniform(0, 1)), atStart = cut;
        traverse(tree, setup, atStart, [&](std::uint32_t id, float& zCut) {
            if (entry(id) > cut) ++behindCut;
            if (random.chance(0.2)) cut = zCut = min(zCut, entry(id) + 0.1f);
            return false;
        });
    }
    std::printf("%zu calls, seed 5\n", calls);
    CHECK(calls > 15000);
    CHECK_EQUAL(disorder, 0u);
    CHECK_EQUAL(afterStop, 0u);
    CHECK_EQUAL(behindCut, 0u);
}

} // namespace test_wide_walk
