// The tree over boxes: structure for friendly and hostile inputs.
#include "accel/bvh.h"
#include "check.h"
#include "unit/bvh_kit.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>

namespace test_bvh {

using bvh_kit::boxAt;
using bvh_kit::Boxes;
using bvh_kit::hostile;
using bvh_kit::Named;
using bvh_kit::randomBoxes;
using meshes::Random;

namespace {

constexpr std::uint32_t kAnyLeaf = std::numeric_limits<std::uint32_t>::max();

struct TreeSize {
    int depth = 0;
    std::uint32_t largestLeaf = 0;
};

// Checks what holds for every tree, and returns its size.
TreeSize checkTree(const Bvh& bvh, const Boxes& boxes, const char* name) {
    TreeSize out;
    if (boxes.empty()) {
        CHECK(bvh.nodes.empty() && bvh.primIds.empty());
        return out;
    }
    std::vector<int> seen(boxes.size(), 0), reached(bvh.nodes.size(), 0);
    std::size_t wrongBoxes = 0;
    const std::function<void(std::uint32_t, int)> visit = [&](std::uint32_t at, int depth) {
        const BvhNode& node = bvh.nodes[at];
        ++reached[at];
        out.depth = std::max(out.depth, depth);
        Bounds inside;
        if (node.isLeaf()) {
            out.largestLeaf = std::max(out.largestLeaf, node.count);
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                ++seen[bvh.primIds[i]];
                inside.extend(boxes[bvh.primIds[i]]);
            }
        } else {
            for (const std::uint32_t child : {node.first, node.first + 1}) {
                visit(child, depth + 1);
                inside.extend(bvh.nodes[child].box);
            }
        }
        if (!(inside == node.box)) ++wrongBoxes; // the smallest box, so it contains what is inside
    };
    visit(0, 0);
    CHECK_INFO(wrongBoxes == 0, name << ": " << wrongBoxes << " boxes");
    CHECK_INFO(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }), name);
    CHECK_INFO(std::all_of(reached.begin(), reached.end(), [](int n) { return n == 1; }), name);
    CHECK_INFO(out.depth <= kMaxBvhDepth, name << ": depth " << out.depth);
    CHECK_EQUAL(bvh.nodes.size(), 2 * leafCount(bvh) - 1);
    return out;
}

} // namespace

TEST(bvh_structure) {
    Random random(1);
    for (const std::size_t count : {3u, 9u, 100u, 3000u}) {
        const Boxes boxes = randomBoxes(random, count);
        checkTree(buildBvh(boxes), boxes, "random");
    }
    for (const Named& input : hostile()) {
        const Bvh bvh = buildBvh(input.boxes);
        const TreeSize size = checkTree(bvh, input.boxes, input.name);
        CHECK_INFO(size.largestLeaf <= kUsualLeaf, input.name << ": leaf of " << size.largestLeaf);
        // Where a subtree that costs more than the list of its primitives may become one.
        const Bvh lists = buildBvh(input.boxes, 1, kAnyLeaf);
        checkTree(lists, input.boxes, input.name);
        CHECK_INFO(sahCost(lists) <= static_cast<double>(input.boxes.size()) * (1 + 1e-9) + 1,
                   input.name << ": cost " << sahCost(lists));
        std::printf("%-22s %6zu boxes: depth %d, largest leaf %u, cost %.1f\n", input.name,
                    input.boxes.size(), size.depth, size.largestLeaf, sahCost(bvh));
    }
}

// Above 2 * 4096 boxes there are several subtrees.
TEST(bvh_is_the_same_for_any_threads) {
    Random random(2);
    std::vector<Named> inputs = hostile();
    inputs.push_back({"random", randomBoxes(random, 30000)});
    for (const Named& input : inputs) {
        const Bvh a = buildBvh(input.boxes, 1, kAnyLeaf);
        for (const int threads : {1, 2, 3, 4, 8}) {
            const Bvh b = buildBvh(input.boxes, threads, kAnyLeaf);
            const auto sameBits = [](const BvhNode& x, const BvhNode& y) {
                // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): -0 is not 0
                return std::memcmp(&x, &y, sizeof x) == 0;
            };
            const bool same = std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(),
                                         b.nodes.end(), sameBits);
            CHECK_INFO(same && a.primIds == b.primIds, input.name << ", threads " << threads);
        }
    }
}

// Boxes that overlap nearly whole: no tree is better than lists of them.
TEST(bvh_in_vain_is_a_list) {
    Random random(5);
    Boxes boxes;
    for (int i = 0; i < 9000; ++i) {
        const Vec3d p = random.inBox(0.001);
        boxes.push_back({toFloat(p - Vec3d{1, 1, 1}), toFloat(p + Vec3d{1, 1, 1})});
    }
    const Bvh bvh = buildBvh(boxes, 1, kAnyLeaf);
    CHECK_INFO(bvh.nodes.size() < 32, bvh.nodes.size()); // 7 measured; else some 5000
    checkTree(bvh, boxes, "in vain");
}

// Long boxes, if few, have a tree of their own beside that of the short ones.
TEST(bvh_few_long_boxes_are_apart) {
    Random random(6);
    for (const std::uint32_t longOnes : {1u, 60u, 200u}) {
        Boxes boxes;
        for (int i = 0; i < 6000; ++i) boxes.push_back(boxAt(random.direction(), 0.005));
        for (std::uint32_t i = 0; i < longOnes; ++i) {
            Vec3 p = toFloat(random.inBox(0.5)), q = p;
            q[random.below(3)] += 0.5f;
            boxes.insert(boxes.begin() + random.below(6000), {p, q});
        }
        const Bvh bvh = buildBvh(boxes);
        checkTree(bvh, boxes, "long among short");
        std::vector<std::uint32_t> open{bvh.nodes[0].first + 1}, found;
        while (!open.empty()) {
            const BvhNode& node = bvh.nodes[open.back()];
            open.pop_back();
            if (!node.isLeaf()) open.insert(open.end(), {node.first, node.first + 1});
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
                found.push_back(bvh.primIds[i]);
        }
        const auto isLong = [&](std::uint32_t i) {
            return maxAbs(boxes[i].hi - boxes[i].lo) > 0.4f;
        };
        const bool areApart =
            found.size() == longOnes && std::all_of(found.begin(), found.end(), isLong);
        CHECK_INFO(areApart == (longOnes < 100), longOnes << " long ones");
    }
}

// Separate triangles of a sphere: a good tree needs about 2 log2(n) steps for a ray; one that sorts
// nothing would need n.
TEST(bvh_is_worth_it) {
    Random random(3);
    Boxes boxes;
    for (int i = 0; i < 20000; ++i) boxes.push_back(boxAt(random.direction(), 0.005));
    const Bvh bvh = buildBvh(boxes);
    CHECK_INFO(sahCost(bvh) < 60, sahCost(bvh)); // 32 measured
    CHECK_NEAR(sahCost({}), 0, 0);
    CHECK_EQUAL(leafCount({}), 0u);
}

} // namespace test_bvh
