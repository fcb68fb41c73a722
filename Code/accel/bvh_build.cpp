#include "accel/bvh.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace {

constexpr int kBins = 16;
constexpr std::uint32_t kMaxLeaf = 8;
// From this depth on every split halves the list, which ends after at most 32 more levels.
constexpr int kHalvingDepth = kMaxBvhDepth - 34;

struct Bin {
    Bounds box;
    std::uint32_t count = 0;
};

struct Split {
    double cost = std::numeric_limits<double>::infinity(); // area-weighted primitive count
    std::size_t axis = 0;
    int bin = 0; // primitives of bins <= bin go left
};

double halfAreaOf(const Bounds& box) {
    const Vec3d d = toDouble(box.hi) - toDouble(box.lo);
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

class Builder {
public:
    explicit Builder(std::span<const Bounds> boxes) : boxes_(boxes), centres_(boxes.size()) {
        for (std::size_t i = 0; i < boxes.size(); ++i)
            centres_[i] = 0.5f * boxes[i].lo + 0.5f * boxes[i].hi;
        bvh_.primIds.resize(boxes.size());
        std::iota(bvh_.primIds.begin(), bvh_.primIds.end(), 0u);
        if (boxes.empty()) return;
        bvh_.nodes.reserve(2 * boxes.size());
        bvh_.nodes.emplace_back();
        build(0, 0, static_cast<std::uint32_t>(boxes.size()), 0);
    }
    Bvh take() { return std::move(bvh_); }

private:
    int binOf(std::uint32_t prim, std::size_t axis, const Bounds& centreBox) const {
        const float lo = centreBox.lo[axis], width = centreBox.hi[axis] - lo;
        const float position = (centres_[prim][axis] - lo) / width * kBins;
        return std::min(kBins - 1, static_cast<int>(position));
    }

    // Cheapest split over the bins of all three axes. An axis without extent offers none.
    Split bestSplit(std::span<const std::uint32_t> prims, const Bounds& centreBox) const {
        Split best;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (!(centreBox.hi[axis] > centreBox.lo[axis])) continue;
            std::array<Bin, kBins> bins;
            for (const std::uint32_t prim : prims) {
                Bin& bin = bins[static_cast<std::size_t>(binOf(prim, axis, centreBox))];
                bin.box.extend(boxes_[prim]);
                ++bin.count;
            }
            std::array<double, kBins> rightCost{};
            Bin right;
            for (std::size_t i = kBins - 1; i > 0; --i) {
                right.box.extend(bins[i].box);
                right.count += bins[i].count;
                rightCost[i] = right.count ? halfAreaOf(right.box) * right.count : 0;
            }
            Bin left;
            for (std::size_t i = 0; i + 1 < kBins; ++i) {
                left.box.extend(bins[i].box);
                left.count += bins[i].count;
                if (left.count == 0 || left.count == prims.size()) continue;
                const double cost = halfAreaOf(left.box) * left.count + rightCost[i + 1];
                if (cost < best.cost) best = {cost, axis, static_cast<int>(i)};
            }
        }
        return best;
    }

    void build(std::uint32_t at, std::uint32_t begin, std::uint32_t end, int depth) {
        Bounds box, centreBox;
        for (std::uint32_t i = begin; i < end; ++i) {
            const std::uint32_t prim = bvh_.primIds[i];
            box.extend(boxes_[prim]);
            centreBox.extend(centres_[prim]);
        }
        const std::uint32_t count = end - begin;
        bvh_.nodes[at].box = box;
        const auto makeLeaf = [&] {
            bvh_.nodes[at].first = begin;
            bvh_.nodes[at].count = count;
        };
        if (count == 1) return makeLeaf();

        const auto prims = std::span(bvh_.primIds).subspan(begin, count);
        const Split split = bestSplit(prims, centreBox);
        const bool splittable = split.cost < std::numeric_limits<double>::infinity();
        const double area = halfAreaOf(box);
        // Cost of a step into the children is that of one primitive.
        const bool worthIt = splittable && split.cost + area < area * count;
        if (!worthIt && count <= kMaxLeaf) return makeLeaf();

        std::uint32_t middle = begin + count / 2;
        if (splittable && depth < kHalvingDepth) {
            const auto goesLeft = [&](std::uint32_t p) {
                return binOf(p, split.axis, centreBox) <= split.bin;
            };
            const auto right = std::stable_partition(prims.begin(), prims.end(), goesLeft);
            middle = begin + static_cast<std::uint32_t>(right - prims.begin());
        }
        const auto child = static_cast<std::uint32_t>(bvh_.nodes.size());
        bvh_.nodes.resize(bvh_.nodes.size() + 2);
        bvh_.nodes[at].first = child;
        build(child, begin, middle, depth + 1);
        build(child + 1, middle, end, depth + 1);
    }

    std::span<const Bounds> boxes_;
    std::vector<Vec3> centres_;
    Bvh bvh_;
};

} // namespace

Bvh buildBvh(std::span<const Bounds> boxes) { return Builder(boxes).take(); }

double sahCost(const Bvh& bvh) {
    if (bvh.nodes.empty()) return 0;
    double sum = 0;
    for (const BvhNode& node : bvh.nodes)
        sum += halfAreaOf(node.box) * (node.isLeaf() ? node.count : 1);
    const double root = halfAreaOf(bvh.nodes[0].box);
    return root > 0 ? sum / root : static_cast<double>(bvh.nodes.size());
}

std::size_t leafCount(const Bvh& bvh) {
    return static_cast<std::size_t>(std::count_if(bvh.nodes.begin(), bvh.nodes.end(),
                                                  [](const BvhNode& n) { return n.isLeaf(); }));
}
