// Builds wide trees in one pass: a top-down binned SAH split (Wald 2007) makes leaves as soon as a
// range of triangles fits into one, and a dynamic program over the small binary tree that is left
// chooses which of its nodes become the W children of a wide one (Ylitie et al. 2017).
#include "accel/kernels/wide_tree.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <memory>

#if defined(__x86_64__)
#include <emmintrin.h>

namespace {

using Corners = std::array<std::uint32_t, 3>;

// Four lanes of which three count.
struct Lanes {
    __m128 v;
};
inline Lanes operator+(Lanes a, Lanes b) { return {_mm_add_ps(a.v, b.v)}; }
inline Lanes operator-(Lanes a, Lanes b) { return {_mm_sub_ps(a.v, b.v)}; }
inline Lanes operator*(Lanes a, Lanes b) { return {_mm_mul_ps(a.v, b.v)}; }
inline Lanes all(float x) { return {_mm_set1_ps(x)}; }
inline std::array<float, 4> toArray(Lanes a) {
    alignas(16) std::array<float, 4> out;
    _mm_store_ps(out.data(), a.v);
    return out;
}

// The upper corner is negated: growing a box is two minima.
struct Box {
    Lanes lo, negHi;
    void extend(const Box& b) {
        lo.v = _mm_min_ps(lo.v, b.lo.v);
        negHi.v = _mm_min_ps(negHi.v, b.negHi.v);
    }
    Lanes size() const { return {_mm_sub_ps(_mm_setzero_ps(), (lo + negHi).v)}; }
    float halfArea() const {
        const auto d = toArray(size());
        return d[0] * d[1] + d[1] * d[2] + d[2] * d[0];
    }
};
const float kHuge = std::numeric_limits<float>::max();
inline Box emptyBox() { return {all(kHuge), all(kHuge)}; }

// A triangle while it is sorted. The fourth lane of lo holds its number, with a bit that makes it a
// normal float: arithmetic on denormal ones is slow.
using Prim = Box;
constexpr std::uint32_t kNormal = 0x40000000u;
inline std::uint32_t idOf(const Prim& p) {
    const __m128i fourth = _mm_castps_si128(_mm_shuffle_ps(p.lo.v, p.lo.v, 0xff));
    return static_cast<std::uint32_t>(_mm_cvtsi128_si32(fourth)) & ~kNormal;
}
inline Lanes twiceCentre(const Prim& p) { return p.lo - p.negHi; }
inline Box pointBox(Lanes p) { return {p, {_mm_sub_ps(_mm_setzero_ps(), p.v)}}; }

inline Box where(__m128 mask, const Box& a) { // a or the empty box
    const __m128 huge = _mm_set1_ps(kHuge);
    const auto pick = [&](Lanes x) -> Lanes {
        return {_mm_or_ps(_mm_and_ps(mask, x.v), _mm_andnot_ps(mask, huge))};
    };
    return {pick(a.lo), pick(a.negHi)};
}

constexpr int kBins = 16;
// Fewer triangles than this are not split for their own sake.
constexpr std::uint32_t kSmallLeaf = 4;
// A further split of what fits into a leaf must save this part of its area.
constexpr float kWorthwhile = 0.8f;

struct BinaryNode {
    Box box;
    std::uint32_t left = 0; // children left, left + 1; 0: a leaf
    std::uint32_t leaf = 0;
};

struct Range {
    std::uint32_t node, first, count;
    Box box, centres; // of the doubled centres
};

struct Split {
    int axis = -1, bin = 0; // triangles of bins < bin go left
    Box left, right;
};

template <int W> class WideBuilder {
public:
    WideBuilder(std::span<const Vec3> points, std::span<const Corners> triangles)
        : points_(points), triangles_(triangles) {}

    WideTree run() {
        WideTree tree;
        const auto n = static_cast<std::uint32_t>(triangles_.size());
        if (n == 0) return tree;
        tree.width = W;
        tree.triangleIds.reserve(n);
        ids_ = &tree.triangleIds;
        nodes_.reserve(n / 2 + 64);
        leaves_.reserve(n / 4 + 64);
        splitAll(makePrims());
        prims_.reset(), spare_.reset(); // 64 bytes a triangle, before the tree takes its place
        writeTree(tree);
        return tree;
    }

private:
    Range makePrims() {
        const auto n = static_cast<std::uint32_t>(triangles_.size());
        prims_ = std::make_unique_for_overwrite<Prim[]>(n);
        spare_ = std::make_unique_for_overwrite<Prim[]>(n);
        Box box = emptyBox(), centres = emptyBox();
        for (std::uint32_t i = 0; i < n; ++i) {
            Prim p = emptyBox();
            for (const std::uint32_t corner : triangles_[i]) {
                const Vec3 v = points_[corner];
                p.extend(pointBox({_mm_setr_ps(v.x, v.y, v.z, 0)}));
            }
            box.extend(p);
            centres.extend(pointBox(twiceCentre(p)));
            const __m128 last = _mm_castsi128_ps(_mm_setr_epi32(0, 0, 0, -1));
            const __m128 id =
                _mm_castsi128_ps(_mm_setr_epi32(0, 0, 0, static_cast<int>(i | kNormal)));
            p.lo.v = _mm_or_ps(_mm_andnot_ps(last, p.lo.v), id);
            prims_[i] = p;
        }
        return {0, 0, n, box, centres};
    }

    void splitAll(Range current) {
        nodes_.resize(2); // the root, and a place that keeps pairs of children together
        nodes_[0].box = current.box;
        std::vector<Range> waiting;
        for (;;) {
            if (fitsLeaf(current)) {
                if (waiting.empty()) return;
                current = waiting.back();
                waiting.pop_back();
                continue;
            }
            Range right;
            Range left = divide(current, right);
            const auto child = static_cast<std::uint32_t>(nodes_.size());
            nodes_[current.node].left = child;
            nodes_.push_back({left.box, 0, 0});
            nodes_.push_back({right.box, 0, 0});
            left.node = child, right.node = child + 1;
            waiting.push_back(right);
            current = left;
        }
    }

    bool fitsLeaf(const Range& r) {
        if (r.count > W || (r.count > kSmallLeaf && worthSplitting(r))) return false;
        return makeLeaf(r);
    }

    // Would cutting the range in the middle, along some axis, leave much less area?
    bool worthSplitting(const Range& r) const {
        const Lanes middle = (r.centres.lo - r.centres.negHi) * all(0.5f);
        const auto extent = toArray(r.centres.size());
        std::array<Box, 3> left, right;
        left.fill(emptyBox()), right.fill(emptyBox());
        for (std::uint32_t i = r.first; i < r.first + r.count; ++i) {
            const Prim& p = prims_[i];
            const __m128 below = _mm_cmplt_ps(twiceCentre(p).v, middle.v);
            const __m128 side[3] = {_mm_shuffle_ps(below, below, 0x00),
                                    _mm_shuffle_ps(below, below, 0x55),
                                    _mm_shuffle_ps(below, below, 0xaa)};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                left[axis].extend(where(side[axis], p));
                right[axis].extend(
                    where(_mm_xor_ps(side[axis], _mm_castsi128_ps(_mm_set1_epi32(-1))), p));
            }
        }
        const float enough = r.box.halfArea() * kWorthwhile;
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (extent[axis] > 0 && left[axis].halfArea() + right[axis].halfArea() < enough)
                return true;
        return false;
    }

    // False when the triangles have more than W different points.
    bool makeLeaf(const Range& r) {
        alignas(64) WideLeaf<W> leaf{};
        alignas(16) std::array<std::uint32_t, W> known;
        known.fill(0xffffffffu);
        std::uint32_t count = 0;
        for (std::uint32_t i = 0; i < r.count; ++i) {
            const Corners& corners = triangles_[idOf(prims_[r.first + i])];
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t at = placeOf(corners[k], known);
                if (at == count) {
                    if (count == W) return false;
                    known[count++] = corners[k];
                }
                leaf.corner[k][i] = static_cast<std::uint8_t>(at);
            }
        }
        for (std::uint32_t i = 0; i < W; ++i) {
            const Vec3 p = points_[known[i < count ? i : 0]];
            for (std::size_t axis = 0; axis < 3; ++axis) leaf.point[axis][i] = p[axis];
        }
        leaf.first = static_cast<std::uint32_t>(ids_->size());
        leaf.count = static_cast<std::uint8_t>(r.count);
        float reach = 0;
        for (std::uint32_t i = r.first; i < r.first + r.count; ++i) {
            ids_->push_back(idOf(prims_[i]));
            const auto d = toArray(prims_[i].size());
            reach = max(max(max(d[0], d[1]), d[2]), reach);
        }
        // Rounded up, and the infinite stays infinite.
        leaf.reach = static_cast<std::uint16_t>(
            min(std::bit_cast<std::uint32_t>(reach) + 0xffffu, 0x7f800000u) >> 16);
        nodes_[r.node].leaf = static_cast<std::uint32_t>(leaves_.size());
        leaves_.push_back(leaf);
        return true;
    }

    // Where the number is in the list; the first free place when it is not.
    static std::uint32_t placeOf(std::uint32_t number, const std::array<std::uint32_t, W>& known) {
        const __m128i wanted = _mm_set1_epi32(static_cast<int>(number));
        const __m128i none = _mm_set1_epi32(-1);
        unsigned equal = 0, empty = 0;
        for (int k = 0; k < W; k += 4) {
            const __m128i four = _mm_load_si128(reinterpret_cast<const __m128i*>(known.data() + k));
            const auto maskOf = [&](__m128i x) {
                return static_cast<unsigned>(
                    _mm_movemask_ps(_mm_castsi128_ps(_mm_cmpeq_epi32(four, x))));
            };
            equal |= maskOf(wanted) << k;
            empty |= maskOf(none) << k;
        }
        if (equal != 0) return static_cast<std::uint32_t>(std::countr_zero(equal));
        return empty != 0 ? static_cast<std::uint32_t>(std::countr_zero(empty)) : W;
    }

    // Sorts the range's triangles into those of the left and of the right child.
    Range divide(const Range& r, Range& right) {
        // An axis on which all centres agree gets no scale: everything falls into its first bin.
        const Lanes extent = r.centres.size();
        const int bins = std::min(kBins, 4 + static_cast<int>(r.count / 20));
        const __m128 some = _mm_cmpgt_ps(extent.v, _mm_set1_ps(0x1p-100f));
        const Lanes scale = {_mm_and_ps(
            some, _mm_div_ps(_mm_set1_ps(static_cast<float>(bins) * 0.9999f), extent.v))};
        const auto binsOf = [&](const Prim& p) {
            return _mm_cvttps_epi32(((twiceCentre(p) - r.centres.lo) * scale).v);
        };
        const Split split = bestSplit(r, bins, _mm_movemask_ps(some), binsOf);
        Range left{0, r.first, 0, split.left, emptyBox()};
        right = {0, 0, 0, split.right, emptyBox()};
        if (split.axis < 0) {
            halve(r, left, right);
            return left;
        }
        const __m128i cut = _mm_set1_epi32(split.bin);
        Prim* const prims = prims_.get() + r.first;
        std::uint32_t l = 0, rest = 0;
        for (std::uint32_t i = 0; i < r.count; ++i) {
            const Prim p = prims[i];
            const __m128 below = _mm_castsi128_ps(_mm_cmplt_epi32(binsOf(p), cut));
            const unsigned goesLeft =
                static_cast<unsigned>(_mm_movemask_ps(below)) >> split.axis & 1;
            // Written to both sides, kept on one: there is no branch to guess.
            prims[l] = p, spare_[rest] = p;
            l += goesLeft, rest += 1 - goesLeft;
            const __m128 side = _mm_castsi128_ps(_mm_set1_epi32(-static_cast<int>(goesLeft)));
            const Box centre = pointBox(twiceCentre(p));
            left.centres.extend(where(side, centre));
            right.centres.extend(
                where(_mm_xor_ps(side, _mm_castsi128_ps(_mm_set1_epi32(-1))), centre));
        }
        std::copy_n(spare_.get(), rest, prims + l);
        left.count = l;
        right.first = r.first + l, right.count = rest;
        return left;
    }

    template <class BinsFn>
    Split bestSplit(const Range& r, int bins, int usableAxes, BinsFn&& binsOf) const {
        Split best;
        best.left = best.right = emptyBox();
        if ((usableAxes & 7) == 0) return best;
        // Neighbours in the list often fall into the same bin; every second one has bins of its
        // own, so that it need not wait for the other's sum.
        Box box[3][kBins], odd[3][kBins];
        std::uint32_t count[3][kBins] = {};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::fill_n(box[axis], bins, emptyBox());
            std::fill_n(odd[axis], bins, emptyBox());
        }
        const auto add = [&](const Prim& p, Box(&to)[3][kBins]) {
            const __m128i at = binsOf(p);
            const auto xy = static_cast<std::uint64_t>(_mm_cvtsi128_si64(at));
            const std::size_t x = static_cast<std::uint32_t>(xy), y = xy >> 32;
            const auto z = static_cast<std::uint32_t>(
                _mm_cvtsi128_si32(_mm_shuffle_epi32(at, _MM_SHUFFLE(2, 2, 2, 2))));
            to[0][x].extend(p), to[1][y].extend(p), to[2][z].extend(p);
            ++count[0][x], ++count[1][y], ++count[2][z];
        };
        const std::uint32_t end = r.first + r.count;
        std::uint32_t i = r.first;
        for (; i + 1 < end; i += 2) add(prims_[i], box), add(prims_[i + 1], odd);
        if (i < end) add(prims_[i], box);
        for (std::size_t axis = 0; axis < 3; ++axis)
            for (int b = 0; b < bins; ++b) box[axis][b].extend(odd[axis][b]);
        float least = std::numeric_limits<float>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            if ((usableAxes >> axis & 1) == 0) continue;
            float rightCost[kBins];
            Box sum = emptyBox();
            std::uint32_t n = 0;
            for (int b = bins - 1; b > 0; --b) {
                sum.extend(box[axis][b]);
                n += count[axis][b];
                rightCost[b] = n > 0 ? sum.halfArea() * static_cast<float>(n) : kHuge;
            }
            sum = emptyBox(), n = 0;
            for (int b = 1; b < bins; ++b) {
                sum.extend(box[axis][b - 1]);
                n += count[axis][b - 1];
                if (n == 0 || n == r.count) continue;
                const float cost = sum.halfArea() * static_cast<float>(n) + rightCost[b];
                if (cost < least) least = cost, best.axis = axis, best.bin = b;
            }
        }
        if (best.axis < 0) return best;
        for (int b = 0; b < bins; ++b)
            (b < best.bin ? best.left : best.right).extend(box[best.axis][b]);
        return best;
    }

    // All centres in one place: any two halves are as good.
    void halve(const Range& r, Range& left, Range& right) const {
        left.count = r.count / 2;
        right.first = r.first + left.count, right.count = r.count - left.count;
        for (Range* side : {&left, &right}) {
            side->centres = emptyBox();
            for (std::uint32_t i = side->first; i < side->first + side->count; ++i) {
                side->box.extend(prims_[i]);
                side->centres.extend(pointBox(twiceCentre(prims_[i])));
            }
        }
    }

    // ---- from binary to wide

    // Cost of a subtree as 1..W children of a wide node, and how many of them come from its left
    // child; 0: it is one child itself.
    struct Choice {
        std::array<float, W> cost;
        std::array<std::uint8_t, W> left;
        std::uint8_t split;  // of the subtree's own wide node
        std::uint8_t leaves; // more than these many children it can't have; at most W
    };

    std::vector<Choice> choose() const {
        std::vector<Choice> choice(nodes_.size());
        const float root = nodes_[0].box.halfArea();
        const float scale = root > 0 ? 1 / root : 1;
        for (std::size_t i = nodes_.size(); i-- > 0;) {
            if (i == 1) continue;
            Choice& c = choice[i];
            const float area = nodes_[i].box.halfArea() * scale;
            if (nodes_[i].left == 0) {
                c.cost.fill(area), c.left.fill(0);
                c.leaves = 1;
                continue;
            }
            const Choice &a = choice[nodes_[i].left], &b = choice[nodes_[i].left + 1];
            c.cost.fill(kHuge), c.left.fill(0);
            const std::size_t most = std::min<std::size_t>(W, a.leaves + b.leaves);
            for (std::size_t k = 1; k <= a.leaves && k < most; ++k)          // from the left
                for (std::size_t m = 1; m <= b.leaves && k + m <= most; ++m) // from the right
                    if (const float cost = a.cost[k - 1] + b.cost[m - 1]; cost < c.cost[k + m - 1])
                        c.cost[k + m - 1] = cost, c.left[k + m - 1] = static_cast<std::uint8_t>(k);
            c.leaves = static_cast<std::uint8_t>(most);
            c.split = c.left[most - 1];
            c.cost[0] = c.cost[most - 1] + area;
            for (std::size_t k = 1; k < W; ++k)
                if (c.cost[k - 1] <= c.cost[k]) {
                    c.cost[k] = c.cost[k - 1];
                    c.left[k] = k == 1 ? std::uint8_t{0} : c.left[k - 1];
                }
        }
        return choice;
    }

    // Children of the wide node that starts at binary node `at`.
    std::vector<std::uint32_t> childrenOf(std::uint32_t at, const std::vector<Choice>& choice) {
        std::vector<std::uint32_t> children;
        if (nodes_[at].left == 0) return {at};
        struct Open {
            std::uint32_t node;
            int slots;
        };
        std::vector<Open> open;
        const auto openBoth = [&](std::uint32_t node, int left, int slots) {
            open.push_back({nodes_[node].left + 1, slots - left});
            open.push_back({nodes_[node].left, left});
        };
        openBoth(at, choice[at].split, W);
        while (!open.empty()) {
            const Open o = open.back();
            open.pop_back();
            const int left = choice[o.node].left[static_cast<std::size_t>(o.slots - 1)];
            if (nodes_[o.node].left == 0 || o.slots == 1 || left == 0)
                children.push_back(o.node);
            else
                openBoth(o.node, left, o.slots);
        }
        std::stable_sort(children.begin(), children.end(), [&](std::uint32_t a, std::uint32_t b) {
            return nodes_[a].box.halfArea() > nodes_[b].box.halfArea();
        });
        return children;
    }

    void writeTree(WideTree& tree) {
        constexpr std::size_t kNodeLines = sizeof(WideNode<W>) / 64;
        constexpr std::size_t kLeafLines = sizeof(WideLeaf<W>) / 64;
        const std::vector<Choice> choice = choose();
        // Behind the last leaf an empty one, for slots without a child.
        const std::uint32_t emptyLeaf = static_cast<std::uint32_t>(leaves_.size());
        leaves_.push_back(WideLeaf<W>{});
        const auto leafRef = [&](std::uint32_t leaf) {
            return wideRef(leaf * kLeafLines, WideKind::Leaf);
        };

        std::vector<WideNode<W>> wide;
        struct Task {
            std::uint32_t binary, parent, slot, depth;
        };
        std::vector<Task> tasks{{0, 0, 0, 1}};
        const std::size_t firstNodeLine = leaves_.size() * kLeafLines;
        std::uint32_t depth = 0;
        double area = 0;
        while (!tasks.empty()) {
            const Task task = tasks.back();
            tasks.pop_back();
            depth = std::max(depth, task.depth);
            const auto number = static_cast<std::uint32_t>(wide.size());
            const WideRef self = wideRef(firstNodeLine + number * kNodeLines, WideKind::Node);
            if (number > 0) wide[task.parent].child[task.slot] = self;
            WideNode<W>& node = wide.emplace_back();
            for (auto& planes : node.plane) {
                std::fill_n(planes[0], W, std::numeric_limits<float>::infinity());
                std::fill_n(planes[1], W, -std::numeric_limits<float>::infinity());
            }
            std::fill_n(node.child, W, leafRef(emptyLeaf));
            const auto children = childrenOf(task.binary, choice);
            area += static_cast<double>(nodes_[task.binary].box.halfArea());
            for (std::size_t i = 0; i < children.size(); ++i) {
                const BinaryNode& child = nodes_[children[i]];
                const auto lo = toArray(child.box.lo), negHi = toArray(child.box.negHi);
                for (std::size_t axis = 0; axis < 3; ++axis) {
                    node.plane[axis][0][i] = lo[axis];
                    node.plane[axis][1][i] = -negHi[axis];
                }
                if (child.left == 0) {
                    node.child[i] = leafRef(child.leaf);
                    area += static_cast<double>(child.box.halfArea()) * leaves_[child.leaf].count;
                }
            }
            for (std::size_t i = children.size(); i-- > 0;)
                if (nodes_[children[i]].left != 0)
                    tasks.push_back(
                        {children[i], number, static_cast<std::uint32_t>(i), task.depth + 1});
        }

        tree.nodes = wide.size(), tree.leaves = leaves_.size() - 1;
        tree.root = wideRef(firstNodeLine, WideKind::Node);
        tree.stackSize = depth * (W - 1) + 1;
        const double root = static_cast<double>(nodes_[0].box.halfArea());
        tree.sah = root > 0 ? area / root : static_cast<double>(wide.size());
        const std::size_t leafBytes = leaves_.size() * sizeof(WideLeaf<W>);
        const std::size_t nodeBytes = wide.size() * sizeof(WideNode<W>);
        tree.lines.resize((leafBytes + nodeBytes) / sizeof(WideTree::Line));
        auto* const to = reinterpret_cast<std::byte*>(tree.lines.data());
        std::memcpy(to, leaves_.data(), leafBytes);
        std::memcpy(to + leafBytes, wide.data(), nodeBytes);
    }

    std::span<const Vec3> points_;
    std::span<const Corners> triangles_;
    std::unique_ptr<Prim[]> prims_, spare_;
    std::vector<BinaryNode> nodes_; // children behind their parents
    std::vector<WideLeaf<W>> leaves_;
    std::vector<std::uint32_t>* ids_ = nullptr;
};

} // namespace

WideTree buildWide(int width, std::span<const Vec3> points, std::span<const Corners> triangles) {
    return width == 16 ? WideBuilder<16>(points, triangles).run()
                       : WideBuilder<8>(points, triangles).run();
}
#else
WideTree buildWide(int, std::span<const Vec3>, std::span<const std::array<std::uint32_t, 3>>) {
    return {}; // no kernel here wants one
}
#endif
