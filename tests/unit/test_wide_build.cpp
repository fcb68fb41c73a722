// The builder of wide trees: the same bytes for any number of threads and any instruction set, and
// trees that kernels can rely on, over meshes that are friendly and those that are not.
#include "accel/kernels/build/build.h"
#include "accel/kernels/build/visit_order.h"
#include "base/text.h"
#include "check.h"
#include "verify/hostile_trees.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>

namespace test_wide_build {

using meshes::Random;

namespace {

struct Input {
    std::string name;
    RawVector<Vec3> points;
    RawVector<std::array<std::uint32_t, 3>> triangles;
};

Input inputOf(const std::string& name, const MeshDesc& mesh) {
    Input in{name, {}, mesh.triangles};
    for (const Vec3d p : mesh.points) in.points.push_back(toFloat(p));
    return in;
}

Input inputOf(const std::string& name, const std::vector<std::array<Vec3, 3>>& triangles) {
    MeshGeometry g = meshes::geometryOf(triangles, false);
    return {name, std::move(g.points), std::move(g.triangles)};
}

// Long thin boxes in all directions, whose own bounding boxes overlap wherever they lie.
Input wires() {
    Random random(33);
    MeshDesc mesh;
    for (int i = 0; i < 700; ++i) {
        const Vec3d centre = random.inBox(1), along = random.direction();
        const Vec3d across = normalize(cross(along, random.direction()));
        const Vec3d sides[] = {along * 0.3, across * 0.003, cross(along, across) * 0.003};
        const MeshDesc cube = meshes::cube();
        const auto first = static_cast<std::uint32_t>(mesh.points.size());
        for (const Vec3d p : cube.points)
            mesh.points.push_back(centre + sides[0] * p.x + sides[1] * p.y + sides[2] * p.z);
        for (const auto& t : cube.triangles)
            mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return inputOf("wires", mesh);
}

// Above 2 * 4096 triangles there are several subtrees, above 16384 several jobs for a range.
std::vector<Input> inputs() {
    Random random(31);
    std::vector<Input> out;
    out.push_back(inputOf("one triangle", meshes::soup(random, 1)));
    out.push_back(inputOf("cube", meshes::cube()));
    out.push_back(inputOf("fan", meshes::doubleFan(3000)));
    out.push_back(inputOf("sphere", meshes::uvSphere(200, 100)));
    out.push_back(inputOf("torus", meshes::torus(0.3, 200, 90))); // 36000
    out.push_back(inputOf("soup", meshes::soup(random, 20000)));
    for (const auto& set : battery::hostileTrees())
        out.push_back(inputOf(set.name, set.make(random, 9000)));
    // Corners that are one and the same point of the list, and all triangles over few points.
    Input few{"few points", {}, {}};
    for (int i = 0; i < 12; ++i) few.points.push_back(toFloat(random.inBox(1)));
    for (int i = 0; i < 9000; ++i)
        few.triangles.push_back({random.below(12), random.below(12), random.below(12)});
    out.push_back(few);
    out.push_back(wires());
    return out;
}

bool sameBytes(const WideTree& a, const WideTree& b) {
    return a.width == b.width && a.root == b.root && a.stackSize == b.stackSize &&
           a.nodes == b.nodes && a.leaves == b.leaves &&
           std::bit_cast<std::uint64_t>(a.sah) == std::bit_cast<std::uint64_t>(b.sah) &&
           std::bit_cast<std::uint32_t>(a.leavesPerRay) ==
               std::bit_cast<std::uint32_t>(b.leavesPerRay) &&
           a.triangleIds == b.triangleIds && a.lines.size() == b.lines.size() &&
           std::memcmp(a.base(), b.base(), a.lines.size() * sizeof(WideTree::Line)) == 0;
}

// What is wrong with a tree, in words; "" if nothing.
template <int W> class Inspection {
public:
    Inspection(const WideTree& tree, const Input& in) : tree_(tree), in_(in) {
        seen_.resize(in.triangles.size());
        Bounds all;
        for (const auto& t : in.triangles)
            for (const std::uint32_t corner : t) all.extend(in.points[corner]);
        visit(tree.root, all, 1);
        if (std::count(seen_.begin(), seen_.end(), 1) != std::ptrdiff_t(seen_.size()))
            wrong("a triangle is missing or there twice");
        if (nodes_ != tree.nodes || leaves_ != tree.leaves) wrong("numbers of nodes or leaves");
        if (std::uint64_t{tree.stackSize} < std::uint64_t{depth_} * (W - 1) + 1) wrong("stack");
        if (depth_ > 96) wrong("depth");
        // Half areas in float, of which the builder's are not these bits.
        const double rootArea = static_cast<double>(halfArea(all));
        const double perRay = rootArea > 0 ? leafArea_ / rootArea : 0;
        if (!(std::fabs(static_cast<double>(tree.leavesPerRay) - perRay) <= 1e-5 * perRay))
            wrong("leaves per ray");
    }
    std::string text() const { return text_; }

private:
    void wrong(const char* what) {
        if (text_.find(what) == std::string::npos) text_ += text_.empty() ? what : cat(", ", what);
    }

    static float halfArea(const Bounds& box) {
        const Vec3 d = box.size();
        return d.x * d.y + d.y * d.z + d.z * d.x;
    }

    // Returns what rays that enter the box meet; see build/visit_order.h.
    kernels::build::Prospect visit(WideRef ref, const Bounds& within, std::uint32_t depth) {
        if (byteOffset(ref) >= tree_.lines.size() * sizeof(WideTree::Line)) {
            wrong("reference to nowhere");
            return {};
        }
        if (kindOf(ref) == WideKind::Leaf) {
            const auto& leaf = tree_.at<WideLeaf<W>>(ref);
            visitLeaf(leaf, within);
            return kernels::build::prospectOfLeaf(leaf.cover * kernels::build::kCoverUnit,
                                                  halfArea(within));
        }
        ++nodes_, depth_ = std::max(depth_, depth);
        const auto& node = tree_.at<WideNode<W>>(ref);
        kernels::build::Prospect whole{0, 1};
        float before = 0;
        bool ended = false;
        for (std::size_t i = 0; i < W; ++i) {
            const Bounds box = node.box(i);
            if (box.isEmpty()) {
                ended = true;
                if (kindOf(node.child[i]) != WideKind::Leaf ||
                    tree_.at<WideLeaf<W>>(node.child[i]).count != 0)
                    wrong("what an empty slot refers to");
                continue;
            }
            if (ended) wrong("an empty slot before a child");
            if (!within.contains(box.lo) || !within.contains(box.hi)) wrong("box of a child");
            const auto child = visit(node.child[i], box, depth + 1);
            const float area = halfArea(box);
            const float worth = kernels::build::coverOf(child.triangles, area) / child.steps;
            // Sums and quotients of a few hundred, in another order than the builder's.
            if (worth < before * 0.9999f) wrong("order of children");
            before = worth;
            whole.triangles += child.triangles;
            whole.steps += child.steps * (area < halfArea(within) ? area / halfArea(within) : 1.0f);
        }
        return whole;
    }

    void visitLeaf(const WideLeaf<W>& leaf, const Bounds& within) {
        ++leaves_;
        leafArea_ += static_cast<double>(halfArea(within));
        if (leaf.count == 0 || leaf.count > W) return wrong("size of a leaf");
        float sides = 0; // half areas of the triangles' boxes
        for (std::size_t i = 0; i < leaf.count; ++i) {
            const std::uint32_t id = tree_.triangleIds[leaf.first + i];
            if (id >= seen_.size()) return wrong("number of a triangle");
            ++seen_[id];
            Bounds box;
            for (std::size_t k = 0; k < 3; ++k) {
                const Vec3 p = in_.points[in_.triangles[id][k]];
                const std::size_t at = leaf.corner[k][i];
                if (at >= W ||
                    !(Vec3{leaf.point[0][at], leaf.point[1][at], leaf.point[2][at]} == p))
                    wrong("corner of a triangle");
                box.extend(p);
            }
            if (!within.contains(box.lo) || !within.contains(box.hi)) wrong("box of a leaf");
            sides += halfArea(box);
        }
        const float cover = kernels::build::coverOf(0.5f * sides, halfArea(within));
        if (std::fabs(static_cast<float>(leaf.cover) - cover * 255) > 1.001f) wrong("cover");
    }

    const WideTree& tree_;
    const Input& in_;
    std::vector<int> seen_;
    std::uint64_t nodes_ = 0, leaves_ = 0;
    double leafArea_ = 0;
    std::uint32_t depth_ = 0;
    std::string text_;
};

} // namespace

TEST(wide_build_same_for_any_threads) {
    for (const Input& in : inputs())
        for (const int width : {8, 16}) {
            const WideTree one = buildWide(width, in.points, in.triangles, 1);
            for (const int threads : {2, 3, 4, 8})
                CHECK_INFO(sameBytes(buildWide(width, in.points, in.triangles, threads), one),
                           in.name << ", width " << width << ", threads " << threads);
        }
}

TEST(wide_build_trees_hold_everything) {
    for (const Input& in : inputs()) {
        const WideTree narrow = buildWide(8, in.points, in.triangles);
        const WideTree wide = buildWide(16, in.points, in.triangles);
        CHECK_INFO(Inspection<8>(narrow, in).text().empty(),
                   in.name << ", width 8: " << Inspection<8>(narrow, in).text());
        CHECK_INFO(Inspection<16>(wide, in).text().empty(),
                   in.name << ", width 16: " << Inspection<16>(wide, in).text());
    }
    CHECK(buildWide(16, {}, {}, 4).isEmpty());
}

// A mesh whose triangles share their points: the leaves take what they have room for, about 11 of
// 16, and there is a node for about ten of them.
TEST(wide_build_leaves_are_full) {
    const Input in = inputOf("sphere", meshes::uvSphere(200, 100));
    const WideTree tree = buildWide(16, in.points, in.triangles);
    const double triangles = static_cast<double>(in.triangles.size());
    CHECK_INFO(triangles / static_cast<double>(tree.leaves) > 9, tree.leaves);
    CHECK_INFO(static_cast<double>(tree.leaves) / static_cast<double>(tree.nodes) > 7, tree.nodes);
    CHECK_INFO(static_cast<double>(tree.bytes()) / triangles < 40, tree.bytes());
}

} // namespace test_wide_build
