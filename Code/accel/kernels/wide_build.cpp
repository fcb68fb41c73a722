// Builds wide trees in one pass from the top down. A binned SAH split (Wald 2007) sorts triangles
// into two halves and, in the same pass, into the bins of both; leaves are made as soon as a range
// fits into one. Ranges of the top are divided one level after the other, by all threads together;
// what is below is a subtree for one thread. No step looks at the number of threads for anything
// but the size of its jobs, and minima and counts don't depend on their order: neither does the
// tree.
#include "accel/kernels/build/build.h"
#include "accel/kernels/build/subtree.h"
#include "accel/kernels/build/write_tree.h"
#include "base/parallel.h"

#include <algorithm>
#include <utility>

namespace {

using namespace kernels::build;

// Triangles of a subtree, at most; and of one job in the passes above: many enough for any number
// of threads to end at about the same time.
std::uint32_t subtreeSize(std::uint32_t count) { return std::max(4096u, count / 64); }
std::uint32_t jobSizeFor(std::uint32_t count) { return std::clamp(count / 256, 2048u, 1u << 14); }

// From which depth on the top is no longer divided: what is so lopsided is left to a subtree.
constexpr std::uint16_t kTopDepthOfWide = 40;

void merge(PrimBox& to, const PrimBox& from) {
    for (std::size_t i = 0; i < 4; ++i) {
        to.lo[i] = std::min(to.lo[i], from.lo[i]);
        to.negHi[i] = std::min(to.negHi[i], from.negHi[i]);
    }
}

// Neighbours in a range that one job divides; `left` of them go to the left.
struct Part {
    std::uint32_t count, left;
};

std::uint32_t leftOf(const WideBinSplit& split, const WideBins& bins) {
    std::uint32_t sum = 0;
    for (std::uint32_t b = 0; split.axis >= 0 && b < static_cast<std::uint32_t>(split.cut); ++b)
        sum += bins.count[b][static_cast<std::size_t>(split.axis)];
    return sum;
}

class WideBuilder {
public:
    WideBuilder(int width, const BuildInput& in, int threads)
        : width_(width), count_(static_cast<std::uint32_t>(in.triangles.size() + in.boxes.size())),
          // Few triangles are sorted before another thread has woken up.
          pool_(count_ < 2 * subtreeSize(count_) ? 1 : threads), in_(in), grown_(workers()) {
        in_.lists = &lists_;
    }

    WideTree run() {
        WideTree tree;
        tree.width = width_;
        tree.isOfBoxes = isOfBoxes();
        // In front of the lists: small things between it and them would keep their memory, when all
        // of it is free, from being in one piece for the next tree.
        tree.triangleIds.resize(count_);
        in_.ids = tree.triangleIds.data();
        divideTop();
        growSubtrees();
        // 32 bytes a triangle, before the tree takes its place.
        decltype(lists_.spare)().swap(lists_.spare);
        (width_ == 16 ? writeTree<16> : writeTree<8>)(tree, top_, subtrees_, grown_,
                                                      std::move(lists_.prims), pool_);
        return tree;
    }

private:
    void divideTop() {
        lists_.prims.resize(count_), lists_.spare.resize(count_);
        top_.resize(2); // the root, and a place that keeps pairs of children together
        std::vector<Open> level{root()};
        top_[0] = leafNode(level[0].range.box);
        while (!level.empty()) level = divideLevel(level);
        std::vector<Job>().swap(jobs_);
    }

    bool isOfBoxes() const { return in_.triangles.empty(); }
    std::size_t workers() const { return static_cast<std::size_t>(pool_.threads()); }

    // A range with its split, in the parts in which it has been looked at.
    struct Open {
        BuildRange range;
        std::vector<Part> parts;
        void add(Part part, std::uint32_t most) {
            if (!parts.empty() && parts.back().count + part.count <= most)
                parts.back().count += part.count, parts.back().left += part.left;
            else
                parts.push_back(part);
        }
    };

    // One thread divides a range at once.
    std::uint32_t jobSize() const { return pool_.threads() == 1 ? count_ : jobSizeFor(count_); }
    std::size_t jobCount(std::uint32_t count) const {
        return (std::size_t{count} + jobSize() - 1) / jobSize();
    }

    Open root() {
        const std::size_t jobs = jobCount(count_);
        struct Bounded {
            PrimBox box, centres;
        };
        std::vector<Bounded> parts(jobs);
        const auto sizeOf = [&](std::size_t job) {
            return std::min(jobSize(), count_ - static_cast<std::uint32_t>(job) * jobSize());
        };
        pool_.run(jobs, [&](std::size_t job, int) {
            makePrims(in_, static_cast<std::uint32_t>(job) * jobSize(), sizeOf(job), parts[job].box,
                      parts[job].centres);
        });
        for (const Bounded& part : parts)
            merge(parts[0].box, part.box), merge(parts[0].centres, part.centres);
        BuildRange r{};
        r.count = count_;
        r.box = parts[0].box;
        r.grid = gridOver(Box::load(parts[0].centres), count_);
        std::vector<WideBins> bins(jobs);
        pool_.run(jobs, [&](std::size_t job, int) {
            fillBins(r.grid, lists_.of(r) + job * jobSize(), sizeOf(job), bins[job]);
        });
        WideBins all = bins[0];
        for (std::size_t job = 1; job < jobs; ++job) mergeBins(all, bins[job], r.grid.bins());
        chooseSplit(r, all);
        Open open{r, {}};
        for (std::size_t job = 0; job < jobs; ++job)
            open.parts.push_back({sizeOf(job), leftOf(r.split, bins[job])});
        return open;
    }

    struct Division {
        const BuildRange* range;
        BuildRange left, right;
        std::size_t firstJob, jobs;
    };
    struct Job {
        std::size_t division;
        Part part;
        std::uint32_t first;       // within the range
        std::uint32_t left, right; // how many go there before
        WideBins bins[2];          // not zeroed

        Job(std::size_t ofDivision, Part of, std::uint32_t from, std::uint32_t goneLeft)
            : division(ofDivision), part(of), first(from), left(goneLeft), right(from - goneLeft) {}
    };

    // Returns what is to be divided further. The rest becomes subtrees.
    std::vector<Open> divideLevel(const std::vector<Open>& level) {
        std::vector<Division> divisions;
        std::size_t most = 0;
        for (const Open& range : level) most += range.parts.size();
        jobs_.clear();
        jobs_.reserve(most);
        for (const auto& [r, parts] : level) {
            if (r.count <= subtreeSize(count_) || r.split.axis < 0 || r.depth >= kTopDepthOfWide) {
                ranges_.push_back(r);
                continue;
            }
            const auto division = divisions.size();
            divisions.push_back({&r, {}, {}, jobs_.size(), parts.size()});
            makeChildren(r, divisions.back().left, divisions.back().right);
            std::uint32_t first = 0, left = 0;
            for (const Part& part : parts) {
                jobs_.emplace_back(division, part, first, left);
                first += part.count, left += part.left;
            }
        }
        pool_.run(jobs_.size(), [&](std::size_t i, int) {
            Job& job = jobs_[i];
            const Division& d = divisions[job.division];
            const WideBinGrid grids[2] = {d.left.grid, d.right.grid};
            PrimBox* const to = lists_.of(*d.range, true);
            divide(in_, *d.range, grids, lists_.of(*d.range) + job.first, job.part.count,
                   to + job.left, to + d.range->count - 1 - job.right, job.bins);
        });
        std::vector<Open> next;
        for (Division& d : divisions) {
            const std::span<const Job> mine(&jobs_[d.firstJob], d.jobs);
            BuildRange* const kids[2] = {&d.left, &d.right};
            const auto child = static_cast<std::uint32_t>(top_.size());
            top_[d.range->node].left = child;
            for (std::size_t side = 0; side < 2; ++side) {
                BuildRange& kid = *kids[side];
                WideBins all = mine[0].bins[side];
                for (const Job& job : mine.subspan(1))
                    mergeBins(all, job.bins[side], kid.grid.bins());
                chooseSplit(kid, all);
                kid.node = child + static_cast<std::uint32_t>(side);
                top_.push_back(leafNode(kid.box));
                next.push_back(open(kid, mine, side));
            }
        }
        return next;
    }

    // What each job has put into a child lies together: on the right in the opposite order. Its
    // bins tell how many of them will go to the left.
    Open open(const BuildRange& kid, std::span<const Job> jobs, std::size_t side) const {
        Open out{kid, {}};
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            const Job& job = jobs[side == 0 ? i : jobs.size() - 1 - i];
            const Part& part = job.part;
            out.add(
                {side == 0 ? part.left : part.count - part.left, leftOf(kid.split, job.bins[side])},
                jobSize());
        }
        return out;
    }

    void growSubtrees() {
        std::vector<std::pair<std::uint32_t, std::size_t>> order; // from left to right
        for (const BuildRange& r : ranges_) order.emplace_back(r.first, order.size());
        std::sort(order.begin(), order.end());
        for (const auto& [first, i] : order) subtrees_.push_back({ranges_[i]});
        // What a scanned mesh needs, in lines the nodes that follow the leaves included: at most 40
        // bytes for each triangle. Others grow. Nodes get no more, as their pages go on with lines.
        const std::size_t share = count_ / workers();
        const std::size_t nodes = share * (isOfBoxes() ? 32 : width_ == 16 ? 3 : 7) / 16;
        for (Grown& grown : grown_) {
            grown.nodes.reserve(nodes + 64);
            if (!isOfBoxes()) grown.lines.reserve(share * 5 / 8 + 1024);
        }
        pool_.run(subtrees_.size(), [&](std::size_t i, int worker) {
            SubtreeRange& s = subtrees_[i];
            s.grower = static_cast<std::uint32_t>(worker);
            Grown& grown = grown_[s.grower];
            s.firstNode = static_cast<std::uint32_t>(grown.nodes.size());
            s.firstLeaf = grown.leaves;
            if (isOfBoxes())
                Subtree<kSingle>(in_, grown).grow(s.range);
            else if (width_ == 16)
                Subtree<16>(in_, grown).grow(s.range);
            else
                Subtree<8>(in_, grown).grow(s.range);
            s.endNode = static_cast<std::uint32_t>(grown.nodes.size());
            s.endLeaf = grown.leaves;
        });
    }

    int width_;
    std::uint32_t count_;
    ThreadPool pool_;
    PrimLists lists_;
    BuildInput in_;
    std::vector<BinaryNode> top_;
    std::vector<Job> jobs_;              // of a level; the next one takes their memory
    std::vector<BuildRange> ranges_;     // of the subtrees, as they were found
    std::vector<SubtreeRange> subtrees_; // from left to right
    std::vector<Grown> grown_;           // by worker
};

} // namespace

WideTree buildWide(int width, std::span<const Vec3> points,
                   std::span<const std::array<std::uint32_t, 3>> triangles, int threads) {
    if (triangles.empty()) return {};
    const BuildInput in{points, triangles, {}, nullptr, nullptr};
    return WideBuilder(width, in, threads).run();
}

WideTree buildWideOfBoxes(int width, std::span<const Bounds> boxes, int threads) {
    if (boxes.empty()) return {};
    const BuildInput in{{}, {}, boxes, nullptr, nullptr};
    return WideBuilder(width, in, threads).run();
}
