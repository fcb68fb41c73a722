// The wide tree over solids, the table of its kernels, and the batches that go to them by origin.
#include "accel/kernels/solids.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace {

// Puts W children below every node of a binary tree: the largest is opened first.
template <int W> class Widener {
public:
    Widener(SolidTree& tree, const Bvh& bvh)
        : tree_(tree), bvh_(bvh), solids_(std::move(tree.solids)), boxes_(std::move(tree.boxes)) {}

    void run() {
        tree_.solids.clear(), tree_.boxes.clear();
        if (!bvh_.nodes.empty()) addNode(open({0}));
    }

private:
    // A node of the binary tree, or some primitives of a leaf in a row.
    struct Part {
        std::uint32_t first = 0; // node, or place in primIds
        std::uint32_t count = 0; // primitives; 0: a node
        bool isSolid() const { return count == 1; }
    };
    using Parts = std::vector<Part>;

    // A leaf of more than W primitives falls into W pieces.
    Parts open(Part part) const {
        if (part.count == 0) {
            const BvhNode& node = bvh_.nodes[part.first];
            if (!node.isLeaf()) return {{node.first}, {node.first + 1}};
            part = {node.first, node.count};
        }
        Parts parts;
        const std::uint32_t pieces = std::min<std::uint32_t>(part.count, W);
        for (std::uint32_t i = 0, at = 0; i < pieces; ++i) {
            const std::uint32_t end = (i + 1) * part.count / pieces;
            parts.push_back({part.first + at, end - at});
            at = end;
        }
        return parts;
    }
    std::size_t sizeOpened(Part part) const {
        if (part.count == 0) {
            const BvhNode& node = bvh_.nodes[part.first];
            if (!node.isLeaf()) return 2;
            part.count = node.count;
        }
        return std::min<std::size_t>(part.count, W);
    }
    std::uint32_t solidOf(Part part) const { return bvh_.primIds[part.first]; }
    Bounds boxOf(Part part) const {
        if (part.count == 0) return bvh_.nodes[part.first].box;
        Bounds box;
        for (std::uint32_t i = 0; i < part.count; ++i)
            box.extend(boxes_[bvh_.primIds[part.first + i]]);
        return box;
    }

    WideRef addNode(Parts parts) {
        for (;;) {
            std::size_t largest = parts.size();
            float area = -1;
            for (std::size_t i = 0; i < parts.size(); ++i) {
                if (parts[i].isSolid() || parts.size() - 1 + sizeOpened(parts[i]) > W) continue;
                const float size = boxOf(parts[i]).halfArea();
                if (!(size > area)) continue;
                largest = i;
                area = size;
            }
            if (largest == parts.size()) break;
            const Parts inner = open(parts[largest]);
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
            node.child[i] = used && parts[i].isSolid() ? addSolid(solidOf(parts[i]))
                                                       : wideRef(0, WideKind::None);
        }
        // After all solids of the node, which so lie in a row.
        for (std::size_t i = 0; i < parts.size(); ++i)
            if (!parts[i].isSolid()) node.child[i] = addNode(open(parts[i]));
        std::copy_n(reinterpret_cast<const WideTree::Line*>(&node), kLines,
                    tree_.lines.begin() + static_cast<std::ptrdiff_t>(line));
        return wideRef(line, WideKind::Node);
    }

    WideRef addSolid(std::uint32_t index) {
        tree_.solids.push_back(solids_[index]);
        tree_.boxes.push_back(boxes_[index]);
        return wideRef(tree_.solids.size() - 1, WideKind::Leaf);
    }

    SolidTree& tree_;
    const Bvh& bvh_;
    const std::vector<SolidTree::Solid> solids_;
    const std::vector<Bounds> boxes_;
};

} // namespace

void SolidTree::add(const Bounds& box, std::uint32_t number, bool hides, const SolidForm& form) {
    Solid solid{.number = number, .hides = hides};
    solid.isTube = form.hull.axis != Vec3d{};
    solid.centre = toFloat(form.hull.centre), solid.axis = toFloat(form.hull.axis);
    solid.radius = floatAbove(form.hull.radius * (1 + 0x1p-20));
    solid.halfLength = floatAbove(form.hull.halfLength * (1 + 0x1p-20));
    // Not where the exact formula might over- or underflow.
    const double size = form.sphere ? form.sphere->radius : form.hull.innerRadius;
    if (size > 0x1p-100 && size < 0x1p100)
        solid.innerRadius = static_cast<float>(form.hull.innerRadius * (1 - 0x1p-20));
    if (form.sphere) {
        solid.kind = Kind::Sphere;
        solid.part = static_cast<std::uint32_t>(spheres.size());
        const auto& m = form.sphere->objectFromWorld;
        const bool turned =
            m[1] != 0 || m[2] != 0 || m[4] != 0 || m[6] != 0 || m[8] != 0 || m[9] != 0;
        spheres.push_back({*form.sphere, turned});
    }
    if (form.facets) {
        solid.kind = Kind::Facets;
        solid.part = static_cast<std::uint32_t>(facets.size());
        FacetGroup group{.facet = {},
                         .count = static_cast<std::uint32_t>(form.facets->triangles.size()),
                         .extent = form.facets->extent,
                         .side = form.facets->side};
        for (std::size_t i = 0; i < group.count; ++i) {
            const auto& p = form.facets->triangles[i];
            const Vec3d p0 = toDouble(p[0]);
            group.facet[i] = {p, cross(toDouble(p[1]) - p0, toDouble(p[2]) - p0)};
        }
        facets.push_back(group);
    }
    solids.push_back(solid);
    boxes.push_back(box);
}

void SolidTree::build(int nodeWidth, const Bvh& bvh) {
    width = nodeWidth;
    lines.clear();
    if (nodeWidth == 16)
        Widener<16>(*this, bvh).run();
    else
        Widener<8>(*this, bvh).run();
}

#define SOLID_FUNCTIONS(isa)                                                                       \
    namespace kernels::isa {                                                                       \
    void closestSolids(const SolidTree&, const SolidCalls&, const RaySpan&,                        \
                       std::span<const std::uint32_t>, Hit*);                                      \
    void anySolids(const SolidTree&, const SolidCalls&, const RaySpan&,                            \
                   std::span<const std::uint32_t>, std::uint8_t*);                                 \
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

namespace {

// Sorts the rays of a batch that are still asked for by their origins: the shadow rays of a wave
// come lamp by lamp for every hit, and packets want those of one lamp.
class Origins {
public:
    template <class WantedFn> void sort(const RaySpan& rays, WantedFn&& wanted) {
        ends_.clear();
        order_.clear();
        origins_.clear();
        groups_.clear();
        if (areFromOnePoint(rays)) {
            order_.resize(rays.size());
            std::size_t count = 0;
            for (std::uint32_t i = 0; i < rays.size(); ++i) {
                order_[count] = i;
                count += wanted(i);
            }
            order_.resize(count);
            return ends_.push_back(count);
        }
        std::size_t guess = 0; // lamps take turns
        for (std::uint32_t i = 0; i < rays.size(); ++i) {
            if (!wanted(i)) continue;
            order_.push_back(i);
            if (origins_.size() > kMostOrigins) continue;
            const Vec3 origin = rays.org[i];
            if (guess >= origins_.size() || !(origins_[guess] == origin)) {
                guess = 0;
                while (guess < origins_.size() && !(origins_[guess] == origin)) ++guess;
                if (guess == origins_.size()) origins_.push_back(origin), ends_.push_back(0);
            }
            ++ends_[guess];
            groups_.push_back(static_cast<std::uint8_t>(guess));
            if (++guess == origins_.size()) guess = 0;
        }
        // Origins of their own, as after a bounce, stay in their order.
        if (origins_.size() > kMostOrigins) ends_.assign(1, order_.size());
        if (ends_.size() < 2) return;
        std::size_t sum = 0;
        for (std::size_t& end : ends_) end = std::exchange(sum, sum + end);
        sorted_.resize(order_.size());
        for (std::size_t k = 0; k < order_.size(); ++k) sorted_[ends_[groups_[k]]++] = order_[k];
        order_.swap(sorted_);
    }

    template <class CallFn> void forEachGroup(CallFn&& call) const {
        std::size_t begin = 0;
        for (const std::size_t end : ends_) {
            call(std::span(order_).subspan(begin, end - begin));
            begin = end;
        }
    }

private:
    static bool areFromOnePoint(const RaySpan& rays) {
        const auto* const first = rays.org.data();
        return rays.size() > 0 &&
               std::memcmp(first, first + 1, (rays.size() - 1) * sizeof(Vec3)) == 0;
    }

    static constexpr std::size_t kMostOrigins = 16;
    std::vector<std::uint32_t> order_, sorted_;
    std::vector<std::uint8_t> groups_; // of the rays in order_
    std::vector<std::size_t> ends_;    // of the groups in order_
    std::vector<Vec3> origins_;
};

} // namespace

void closestSolids(const SolidKernel& kernel, const SolidTree& tree, const SolidCalls& calls,
                   const RaySpan& rays, std::span<Hit> hits) {
    thread_local Origins origins;
    origins.sort(rays, [](std::uint32_t) { return true; });
    origins.forEachGroup([&](std::span<const std::uint32_t> order) {
        kernel.closest(tree, calls, rays, order, hits.data());
    });
}

void anySolids(const SolidKernel& kernel, const SolidTree& tree, const SolidCalls& calls,
               const RaySpan& rays, std::span<std::uint8_t> hidden) {
    thread_local Origins origins;
    origins.sort(rays, [&](std::uint32_t i) { return hidden[i] == 0; });
    origins.forEachGroup([&](std::span<const std::uint32_t> order) {
        kernel.any(tree, calls, rays, order, hidden.data());
    });
}
