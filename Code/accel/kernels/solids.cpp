#include "accel/kernels/solids.h"

#include <algorithm>

namespace {

// Puts W children below every node of a binary tree: the largest is opened first.
template <int W> class Widener {
public:
    Widener(SolidTree& tree, const Bvh& bvh) : tree_(tree), bvh_(bvh), from_(tree.solids) {}

    void run() {
        tree_.solids.clear();
        if (!bvh_.nodes.empty()) addNode({open(0)});
    }

private:
    // A node of the binary tree, or one primitive of a leaf.
    struct Part {
        std::uint32_t index = 0;
        bool isSolid = false;
    };
    using Parts = std::vector<Part>;

    Parts open(std::uint32_t index) const {
        const BvhNode& node = bvh_.nodes[index];
        if (!node.isLeaf()) return {{node.first}, {node.first + 1}};
        Parts parts;
        for (std::uint32_t i = 0; i < node.count; ++i)
            parts.push_back({bvh_.primIds[node.first + i], true});
        return parts;
    }
    const Bounds& boxOf(Part part) const {
        return part.isSolid ? from_[part.index].box : bvh_.nodes[part.index].box;
    }
    std::size_t sizeOpened(Part part) const {
        const BvhNode& node = bvh_.nodes[part.index];
        return node.isLeaf() ? node.count : 2;
    }

    WideRef addNode(Parts parts) {
        for (;;) {
            std::size_t largest = parts.size();
            float area = -1;
            for (std::size_t i = 0; i < parts.size(); ++i) {
                const float size = boxOf(parts[i]).halfArea();
                if (parts[i].isSolid || !(size > area) ||
                    parts.size() - 1 + sizeOpened(parts[i]) > W)
                    continue;
                largest = i;
                area = size;
            }
            if (largest == parts.size()) break;
            const Parts inner = open(parts[largest].index);
            parts[largest] = inner[0];
            parts.insert(parts.end(), inner.begin() + 1, inner.end());
        }
        constexpr std::size_t kLines = sizeof(WideNode<W>) / sizeof(WideTree::Line);
        const std::size_t line = tree_.lines.size();
        tree_.lines.resize(line + kLines);
        WideNode<W> node;
        for (std::size_t i = 0; i < W; ++i) {
            const bool used = i < parts.size();
            const Bounds box = used ? boxOf(parts[i]) : Bounds();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                node.plane[axis][0][i] = box.lo[axis];
                node.plane[axis][1][i] = box.hi[axis];
            }
            node.child[i] = !used              ? wideRef(0, WideKind::None)
                            : parts[i].isSolid ? addSolid(parts[i].index)
                                               : addNode(open(parts[i].index));
        }
        std::copy_n(reinterpret_cast<const WideTree::Line*>(&node), kLines,
                    tree_.lines.begin() + static_cast<std::ptrdiff_t>(line));
        return wideRef(line, WideKind::Node);
    }

    WideRef addSolid(std::uint32_t index) {
        tree_.solids.push_back(from_[index]);
        return wideRef(tree_.solids.size() - 1, WideKind::Leaf);
    }

    SolidTree& tree_;
    const Bvh& bvh_;
    const std::vector<SolidTree::Solid> from_;
};

} // namespace

void SolidTree::build(int nodeWidth, const Bvh& bvh) {
    width = nodeWidth;
    lines.clear();
    for (Sphere& sphere : spheres) {
        const auto& m = sphere.exact.objectFromWorld;
        sphere.turned = m[1] != 0 || m[2] != 0 || m[4] != 0 || m[6] != 0 || m[8] != 0 || m[9] != 0;
    }
    if (nodeWidth == 16)
        Widener<16>(*this, bvh).run();
    else
        Widener<8>(*this, bvh).run();
}

#define SOLID_FUNCTIONS(isa)                                                                       \
    namespace kernels::isa {                                                                       \
    void closestSolids(const SolidTree&, const SolidCalls&, const RaySpan&, std::span<Hit>);       \
    void anySolids(const SolidTree&, const SolidCalls&, const RaySpan&, std::span<std::uint8_t>);  \
    }
SOLID_FUNCTIONS(sse)
SOLID_FUNCTIONS(avx2)
SOLID_FUNCTIONS(avx512)
#undef SOLID_FUNCTIONS

const SolidKernel* solidKernel(const Kernel& kernel) {
#if defined(__x86_64__)
    static constexpr SolidKernel kTable[] = {
        {"avx512", 16, kernels::avx512::closestSolids, kernels::avx512::anySolids},
        {"avx2", 8, kernels::avx2::closestSolids, kernels::avx2::anySolids},
        {"sse", 8, kernels::sse::closestSolids, kernels::sse::anySolids},
    };
    for (const SolidKernel& row : kTable)
        if (std::string_view(row.name) == kernel.name) return &row;
#endif
    return nullptr;
}
