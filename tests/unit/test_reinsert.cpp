// Moving subtrees of a binary tree: from one that is as bad as can be to a good one with the same
// leaves, the same for any number of threads.
#include "accel/kernels/build/collapse.h"
#include "accel/kernels/build/write_tree.h"
#include "accel/kernels/wide_tree.h"
#include "check.h"
#include "verify/meshes.h"

#include <algorithm>
#include <cstring>

namespace test_reinsert {

using kernels::build::BinaryNode;
using meshes::Random;

namespace {

using Tree = std::vector<BinaryNode>;

void fit(Tree& tree) {
    for (std::size_t i = tree.size(); i-- > 0;) {
        BinaryNode& n = tree[i];
        if (i == 1 || n.isLeaf()) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            n.lo[axis] = std::min(tree[n.left].lo[axis], tree[n.left + 1].lo[axis]);
            n.negHi[axis] = std::min(tree[n.left].negHi[axis], tree[n.left + 1].negHi[axis]);
        }
    }
}

BinaryNode leaf(std::uint32_t number, Vec3 centre, float size) {
    return {{centre.x - size, centre.y - size, centre.z - size},
            0,
            {-centre.x - size, -centre.y - size, -centre.z - size},
            number};
}

// Leaves in no order below a tree with as few levels as possible.
Tree shuffled(std::uint32_t leaves, float size, std::uint32_t seed = 41) {
    Random random(seed);
    Tree tree(2);
    std::vector<std::uint32_t> ends{0};
    for (std::size_t at = 0; ends.size() - at < leaves; ++at) {
        const auto left = static_cast<std::uint32_t>(tree.size());
        tree[ends[at]].left = left;
        tree.resize(left + 2);
        ends.push_back(left), ends.push_back(left + 1);
    }
    for (std::uint32_t i = 0; i < leaves; ++i)
        tree[ends[ends.size() - leaves + i]] = leaf(i, toFloat(random.inBox(1)), size);
    fit(tree);
    return tree;
}

// One leaf after the other: as deep as a tree may be, with the largest leaves at its end.
Tree chain(std::size_t levels) {
    Random random(42);
    Tree tree(2);
    std::uint32_t at = 0, number = 0;
    for (std::size_t level = 1; level < levels; ++level) {
        const auto left = static_cast<std::uint32_t>(tree.size());
        tree[at].left = left;
        tree.resize(left + 2);
        tree[left] = leaf(number++, toFloat(random.inBox(1)), 0.001f * static_cast<float>(level));
        at = left + 1;
    }
    tree[at] = leaf(number, {}, 0.001f);
    fit(tree);
    return tree;
}

double innerArea(const Tree& tree) {
    double sum = 0;
    for (std::size_t i = 0; i < tree.size(); ++i)
        if (i != 1 && !tree[i].isLeaf()) sum += static_cast<double>(halfAreaOf(tree[i]));
    return sum / static_cast<double>(halfAreaOf(tree[0]));
}

// What is wrong with a tree made of another one, in words; "" if nothing.
std::string faultOf(const Tree& tree, const Tree& from) {
    if (tree.size() != from.size()) return "size";
    std::vector<std::size_t> depth(tree.size());
    std::vector<int> leaves(tree.size());
    std::vector<const BinaryNode*> wanted(tree.size());
    for (std::size_t i = 0; i < from.size(); ++i)
        if (i != 1 && from[i].isLeaf()) wanted[from[i].leaf] = &from[i];
    Tree fitted = tree;
    fit(fitted);
    depth[0] = 1;
    for (std::size_t i = 0; i < tree.size(); ++i) {
        const BinaryNode& n = tree[i];
        if (i == 1) continue;
        if (depth[i] == 0) return "a node before its parent, or without";
        if (depth[i] > kMaxTreeDepth) return "depth";
        if (n.lo != fitted[i].lo || n.negHi != fitted[i].negHi) return "box";
        if (n.isLeaf()) {
            if (++leaves[n.leaf] > 1) return "a leaf twice";
            const BinaryNode* const leaf = wanted[n.leaf];
            if (!leaf || leaf->lo != n.lo || leaf->negHi != n.negHi) return "box of a leaf";
        } else {
            depth[n.left] = depth[n.left + 1] = depth[i] + 1;
        }
    }
    return "";
}

} // namespace

// 5000 boxes of a hundredth of the space each: their order alone makes the cost. Measured: 0.034.
TEST(reinsert_makes_good_trees_of_bad_ones) {
    const Tree bad = shuffled(5000, 0.01f);
    Tree good = bad;
    ThreadPool one(1);
    CHECK(kernels::build::reinsert(good, kCountlessRays, one));
    CHECK_EQUAL(faultOf(good, bad), std::string());
    const double part = innerArea(good) / innerArea(bad);
    std::printf("%g of the area\n", part);
    CHECK_INFO(part < 0.2, part);
    for (const int threads : {2, 5}) {
        ThreadPool pool(threads);
        Tree again = bad;
        kernels::build::reinsert(again, kCountlessRays, pool);
        CHECK_INFO(std::memcmp(again.data(), good.data(), good.size() * sizeof(BinaryNode)) == 0,
                   threads);
    }
}

TEST(reinsert_does_what_the_rays_pay_for) {
    const Tree bad = shuffled(5000, 0.01f);
    ThreadPool pool(1);
    double before = innerArea(bad);
    for (const double rays : {1e8, 1e10, kCountlessRays}) {
        Tree tree = bad;
        CHECK(kernels::build::reinsert(tree, rays, pool));
        CHECK_EQUAL(faultOf(tree, bad), std::string());
        CHECK_INFO(innerArea(tree) <= before, rays << ": " << innerArea(tree));
        before = innerArea(tree);
    }
    for (const double rays : {0.0, 1000.0}) {
        Tree tree = bad;
        CHECK(!kernels::build::reinsert(tree, rays, pool));
        CHECK(std::memcmp(tree.data(), bad.data(), bad.size() * sizeof(BinaryNode)) == 0);
    }
}

// Trees that leave nothing to do, or are too deep already.
TEST(reinsert_leaves_odd_trees_whole) {
    ThreadPool pool(2);
    std::vector<Tree> trees{chain(kMaxTreeDepth), shuffled(300, 0), shuffled(300, 2)};
    for (std::uint32_t leaves = 1; leaves < 20; ++leaves) trees.push_back(shuffled(leaves, 0.1f));
    Tree points = shuffled(300, 0);
    for (BinaryNode& n : points) n.lo = n.negHi = {0, 0, 0};
    trees.push_back(points);
    // One in the other: the least area has a chain, deeper than allowed.
    Tree nested = shuffled(300, 0);
    for (BinaryNode& n : nested)
        if (n.isLeaf()) n = leaf(n.leaf, {}, 1.0f + static_cast<float>(n.leaf * 37 % 300));
    fit(nested);
    trees.push_back(nested);
    // Boxes alike: moves that lead below each other.
    for (std::uint32_t seed = 0; seed < 400; ++seed) {
        Random random(seed);
        Tree alike = shuffled(40, 0);
        for (BinaryNode& n : alike) {
            const auto whole = [&] { return static_cast<float>(random.below(3)); };
            if (n.isLeaf()) n = leaf(n.leaf, {whole(), whole(), whole()}, 0.5f * (1 + whole()));
        }
        fit(alike);
        trees.push_back(alike);
    }
    for (std::size_t i = 0; i < trees.size(); ++i) {
        Tree tree = trees[i];
        kernels::build::reinsert(tree, kCountlessRays, pool);
        CHECK_INFO(faultOf(tree, trees[i]).empty(), i << ": " << faultOf(tree, trees[i]));
    }
}

} // namespace test_reinsert
