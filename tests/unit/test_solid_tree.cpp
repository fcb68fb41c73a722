// The tree over solids: the same for any number of threads, whole, and walked by single rays with
// the answers of looking at every box.
#include "accel/kernels/wide_walk.h"
#include "check.h"
#include "unit/hostile_boxes.h"
#include "verify/meshes.h"

#include <algorithm>

namespace test_solid_tree {

using meshes::Random;

namespace {

// Boxes of all sizes; every tenth is where the one before is.
std::vector<Bounds> someBoxes(Random& random, std::size_t count) {
    std::vector<Bounds> boxes;
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0 && random.chance(0.1)) {
            boxes.push_back(boxes.back());
            continue;
        }
        const Vec3 lo = toFloat(random.inBox(0.9));
        const double size = random.logUniform(1e-3, 0.2);
        boxes.push_back({lo, lo + toFloat(random.inBox(1) * size + Vec3d{size, size, size})});
    }
    return boxes;
}

// Of three kinds, two of which have lists of their own: number and list tell the same.
SolidTree::Described describe(std::uint32_t i) {
    SolidTree::Described out{i, i % 5 != 0, {}};
    static const StillShape still{};
    if (i % 3 == 1) {
        out.form.tube = StillTube{.shape = &still, .caps = false, .radius = 1.0 + i};
        out.form.hull = {.centre = {}, .axis = {0, 0, 1}, .radius = 1};
    }
    if (i % 3 == 2) {
        out.form.facets = Facets{.triangles = {}, .extent = static_cast<float>(i)};
        out.form.facets->triangles.resize(1 + i % Facets::kMost);
    }
    return out;
}

SolidTree treeOf(const std::vector<Bounds>& boxes, int width, int threads) {
    SolidTree tree;
    tree.extent = kSceneExtent;
    tree.build(
        width, boxes, [](std::uint32_t i, std::uint32_t) { return describe(i); }, threads);
    return tree;
}

template <int W> bool sameNodes(const SolidTree& a, const SolidTree& b) {
    if (a.lines.size() != b.lines.size()) return false;
    constexpr std::size_t kLines = sizeof(WideNode<W>) / sizeof(WideTree::Line);
    for (std::size_t line = 0; line < a.lines.size(); line += kLines) {
        const WideNode<W>& x = a.node<W>(wideRef(line, WideKind::Node));
        const WideNode<W>& y = b.node<W>(wideRef(line, WideKind::Node));
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (std::size_t side = 0; side < 2; ++side)
                if (!std::equal(x.plane[axis][side], x.plane[axis][side] + W, y.plane[axis][side]))
                    return false;
        if (!std::equal(x.child, x.child + W, y.child)) return false;
    }
    return true;
}

} // namespace

// 20000 are five parts of the tree and twenty of the solids.
TEST(solid_tree_is_the_same_for_any_threads) {
    Random random(71);
    for (const std::size_t count : {1u, 2u, 300u, 20000u}) {
        const std::vector<Bounds> boxes = someBoxes(random, count);
        Bounds all;
        for (const Bounds& box : boxes) all.extend(box);
        for (const int width : {8, 16}) {
            const SolidTree one = treeOf(boxes, width, 1);
            CHECK_INFO(one.around == all, count << " solids, width " << width);
            std::vector<int> found(count);
            bool isRight = one.solids.size() == count && one.boxes.size() == count;
            for (std::size_t i = 0; isRight && i < count; ++i) {
                const SolidTree::Solid& s = one.solids[i];
                ++found[s.number];
                isRight = one.boxes[i] == boxes[s.number] && s.hides == (s.number % 5 != 0);
                if (s.kind == SolidTree::Kind::Tube)
                    isRight = isRight && one.tubes[s.part].exact.radius == 1.0 + s.number;
                if (s.kind == SolidTree::Kind::Facets)
                    isRight = isRight &&
                              one.facets[s.part].extent == static_cast<float>(s.number) &&
                              one.facets[s.part].count == 1 + s.number % Facets::kMost;
            }
            CHECK_INFO(isRight, count << " solids, width " << width);
            CHECK(std::all_of(found.begin(), found.end(), [](int times) { return times == 1; }));
            CHECK_INFO(one.sah >= 1, one.sah);
            for (const int threads : {2, 5}) {
                const SolidTree some = treeOf(boxes, width, threads);
                const bool same =
                    some.sah == one.sah && some.around == one.around &&
                    (width == 16 ? sameNodes<16>(some, one) : sameNodes<8>(some, one)) &&
                    std::equal(some.solids.begin(), some.solids.end(), one.solids.begin(),
                               [](const auto& a, const auto& b) {
                                   return a.number == b.number && a.part == b.part;
                               });
                CHECK_INFO(same, count << " solids, width " << width << ", threads " << threads);
            }
        }
    }
}

// Trees over boxes that builders are afraid of, those of far more than a scene's extent among them:
// each box is in one leaf, in the boxes of all nodes above it, of which there are not too many.
TEST(solid_tree_of_hostile_boxes) {
    for (const hostile_boxes::Named& input : hostile_boxes::all()) {
        SolidTree tree;
        for (std::uint32_t i = 0; i < input.boxes.size(); ++i)
            tree.add(input.boxes[i], i, true, {});
        tree.build(8, 2);
        CHECK_EQUAL(tree.lines.empty(), input.boxes.empty());
        if (input.boxes.empty()) continue;
        std::vector<int> found(input.boxes.size());
        std::size_t deepest = 0, wrong = 0;
        struct Open {
            WideRef ref;
            Bounds around;
            std::size_t depth;
        };
        std::vector<Open> open{{wideRef(0, WideKind::Node), tree.around, 1}};
        while (!open.empty()) {
            const auto [ref, around, depth] = open.back();
            open.pop_back();
            if (SolidTree::isLeaf(ref)) {
                const std::uint32_t number = tree.solids[ref >> 2].number;
                ++found[number];
                wrong += !(around == input.boxes[number]);
                continue;
            }
            deepest = std::max(deepest, depth);
            const WideNode<8>& node = tree.node<8>(ref);
            Bounds inside;
            for (std::size_t i = 0; i < 8; ++i) {
                if (kindOf(node.child[i]) == WideKind::None) continue;
                inside.extend(node.box(i));
                open.push_back({node.child[i], node.box(i), depth + 1});
            }
            wrong += !(inside == around); // the smallest box
        }
        CHECK_INFO(wrong == 0, input.name << ": " << wrong << " boxes");
        CHECK_INFO(std::all_of(found.begin(), found.end(), [](int n) { return n == 1; }),
                   input.name);
        CHECK_INFO(deepest <= kMaxTreeDepth, input.name << ": depth " << deepest);
        std::printf("%-22s %6zu boxes: depth %zu, cost %.1f\n", input.name, input.boxes.size(),
                    deepest, tree.sah);
    }
}

// 40.1 measured.
TEST(solid_tree_is_a_good_one) {
    Random random(74);
    const SolidTree tree = treeOf(someBoxes(random, 20000), 16, 1);
    CHECK_INFO(tree.sah < 40.5, tree.sah);
}

// No plane separates boxes with one centre: they are halved, however many they are.
TEST(solid_tree_where_many_boxes_have_one_centre) {
    for (const std::uint32_t apart : {1u, 3u, 1u << 20}) { // every third one; none but the first
        std::vector<Bounds> boxes;
        for (std::uint32_t i = 0; i < 700; ++i) {
            const float x = i % apart == 0 ? static_cast<float>(i) : 0;
            boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
        }
        const SolidTree tree = treeOf(boxes, 16, 1);
        std::vector<int> found(boxes.size());
        std::vector<std::pair<WideRef, Bounds>> open{
            {wideRef(0, WideKind::Node), {{-1e9f, -1e9f, -1e9f}, {1e9f, 1e9f, 1e9f}}}};
        while (!open.empty()) {
            const auto [ref, around] = open.back();
            open.pop_back();
            if (SolidTree::isLeaf(ref)) {
                ++found[tree.solids[ref >> 2].number];
                CHECK(around.contains(tree.boxes[ref >> 2]));
            }
            if (kindOf(ref) != WideKind::Node) continue;
            const WideNode<16>& node = tree.node<16>(ref);
            for (std::size_t i = 0; i < 16; ++i) {
                if (kindOf(node.child[i]) == WideKind::None) continue;
                CHECK_INFO(around.contains(node.box(i)), apart);
                open.emplace_back(node.child[i], node.box(i));
            }
        }
        CHECK_INFO(std::all_of(found.begin(), found.end(), [](int times) { return times == 1; }),
                   apart);
    }
}

TEST(solid_tree_walk_enters_what_the_ray_enters) {
    Random random(72);
    long long entered = 0, wrong = 0;
    for (const std::size_t count : {1u, 40u, 5000u})
        for (const int width : {8, 16}) {
            const std::vector<Bounds> boxes = someBoxes(random, count);
            const SolidTree tree = treeOf(boxes, width, 2);
            for (int i = 0; i < check::scaled(200); ++i) {
                const Vec3 org = toFloat(random.inBox(2));
                const RaySetup ray(org, toFloat(random.inBox(1)) - org, kSceneExtent);
                float zCut =
                    random.chance(0.5) ? kInfinityF : static_cast<float>(random.uniform(0.1, 3));
                std::vector<std::uint32_t> expected, found;
                for (std::uint32_t k = 0; k < count; ++k) {
                    float z = 0;
                    if (ray.enters(boxes[k], zCut, z)) expected.push_back(k);
                }
                const bool stopped = traverse(tree, ray, zCut, [&](std::uint32_t number, float&) {
                    found.push_back(number);
                    return false;
                });
                std::sort(found.begin(), found.end());
                entered += static_cast<long long>(found.size());
                wrong += stopped || found != expected;
                // True stops at once and is handed on; a lower cut leaves out what is behind it.
                int calls = 0;
                const bool ended = traverse(tree, ray, zCut, [&](std::uint32_t, float&) {
                    ++calls;
                    return true;
                });
                wrong += ended == expected.empty() || calls != (expected.empty() ? 0 : 1);
                calls = 0;
                traverse(tree, ray, zCut, [&](std::uint32_t, float& cut) {
                    cut = -kInfinityF;
                    ++calls;
                    return false;
                });
                wrong += calls != (expected.empty() ? 0 : 1);
            }
        }
    CHECK(entered > 1000);
    CHECK_EQUAL(wrong, 0);
}

} // namespace test_solid_tree
