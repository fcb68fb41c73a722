// The stacks of transparent media against the rule written out.
#include "scene/medium_tree.h"

#include "check.h"
#include "verify/meshes.h"

#include <algorithm>

namespace test_medium_tree {

namespace {

constexpr std::uint32_t kAir = MediumTree::kOutside, kGlass = 1, kWater = 2, kIce = 3;

// A list, the last one entered on top.
struct Reference {
    std::vector<std::uint32_t> inside;
    void enter(std::uint32_t m) { inside.push_back(m); }
    void leave(std::uint32_t m) {
        const auto at = std::find(inside.rbegin(), inside.rend(), m);
        if (at != inside.rend())
            inside.erase(std::next(at).base());
        else if (!inside.empty())
            inside.pop_back(); // never entered: the top goes
    }
};

// From the top down.
std::vector<std::uint32_t> contents(MediumTree tree, MediumTree::Inside inside) {
    std::vector<std::uint32_t> out;
    for (; inside != MediumTree::kNothing; inside = tree.leave(inside, tree.top(inside)))
        out.insert(out.begin(), tree.top(inside));
    return out;
}

} // namespace

TEST(medium_tree) {
    MediumTree tree;
    auto s = MediumTree::kNothing;
    CHECK_EQUAL(tree.top(s), kAir);
    CHECK_EQUAL(tree.leave(s, kGlass), s); // the ray started inside: no change
    CHECK_EQUAL(tree.top(tree.leave(tree.enter(tree.enter(s, kGlass), kWater), kIce)), kGlass);
    s = tree.enter(tree.enter(tree.enter(s, kGlass), kWater), kIce); // nested
    CHECK_EQUAL(tree.top(s), kIce);
    s = tree.leave(s, kWater); // the outer ends first: overlapping solids
    CHECK_EQUAL(tree.top(s), kIce);
    s = tree.leave(s, kIce);
    CHECK_EQUAL(tree.top(s), kGlass);
    s = tree.leave(tree.enter(s, kGlass), kGlass); // twice the same: counted
    CHECK_EQUAL(tree.top(s), kGlass);
    CHECK_EQUAL(tree.leave(s, kGlass), MediumTree::kNothing);
    // The innermost entry goes: 1 2 1 - 1 = 1 2.
    s = tree.leave(tree.enter(tree.enter(s, kWater), kGlass), kGlass);
    CHECK_EQUAL(tree.top(s), kWater);
    // As deep as one likes.
    s = MediumTree::kNothing;
    for (std::uint32_t i = 0; i < 1000; ++i) s = tree.enter(s, i);
    for (std::uint32_t i = 1000; i-- > 0; s = tree.leave(s, i)) CHECK_EQUAL(tree.top(s), i);
    CHECK_EQUAL(s, MediumTree::kNothing);
}

// Rays that are inside of the same share it: coming and going adds nothing.
TEST(medium_tree_stays_small) {
    MediumTree tree;
    for (int i = 0; i < 1000; ++i) {
        auto s = tree.enter(tree.enter(MediumTree::kNothing, kGlass), kWater);
        s = tree.leave(s, kGlass); // glass first: water alone
        CHECK_EQUAL(tree.leave(s, kWater), MediumTree::kNothing);
    }
    // Glass and water take turns at the root, and each turn may add what is above it.
    CHECK(tree.size() <= 3001);
    const std::size_t before = tree.size();
    for (int i = 0; i < 1000; ++i) {
        const auto s = tree.enter(tree.enter(MediumTree::kNothing, kIce), kWater);
        CHECK_EQUAL(tree.leave(tree.leave(s, kWater), kIce), MediumTree::kNothing);
    }
    CHECK_EQUAL(tree.size(), before + 2);
}

// Several rays in one tree, each with a list of its own.
TEST(medium_tree_at_random) {
    meshes::Random random(121);
    for (int n = 0; n < 100; ++n) {
        MediumTree tree;
        std::vector<MediumTree::Inside> rays(5, MediumTree::kNothing);
        std::vector<Reference> references(rays.size());
        for (int i = 0; i < 400; ++i) {
            const std::uint32_t m = random.below(5), ray = random.below(rays.size());
            if (random.chance(0.55))
                rays[ray] = tree.enter(rays[ray], m), references[ray].enter(m);
            else
                rays[ray] = tree.leave(rays[ray], m), references[ray].leave(m);
            if (i % 20 == 0)
                for (std::size_t r = 0; r < rays.size(); ++r)
                    CHECK_INFO(contents(tree, rays[r]) == references[r].inside,
                               "seed 121 round " << n << " step " << i);
        }
    }
}

} // namespace test_medium_tree
