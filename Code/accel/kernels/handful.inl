// Trees of a few leaves, in which no ray is worth a way of its own: W rays at once against one
// triangle after the other. Of rays that meet nothing hardly more is computed than that.
// Included by the file of each instruction set inside its namespace, in front of queue.inl.

template <Query Q> class Handful {
public:
    static constexpr std::uint64_t kMostLeaves = 2;
    // So few that their boxes are not worth a question.
    static constexpr std::size_t kFewTriangles = 4;

    Handful(const WideMesh& mesh, const RaySpan& rays)
        : mesh_(mesh), rays_(rays), root_(mesh.tree),
          asksBoxes_(mesh.triangles.size() > kFewTriangles) {}

    template <class Results>
    void run(std::span<const std::uint32_t> order, const Results& results) {
        for (std::size_t next = 0; next < order.size(); next += W) {
            const std::size_t count = std::min<std::size_t>(W, order.size() - next);
            const RayColumns columns = loadRays(rays_, &order[next], count, block_.ray);
            const RayAxes axes(columns);
            start(columns, axes, count);
            const unsigned lanes = axes.traceable & ((1u << count) - 1);
            if (asksBoxes_) {
                const RayLanes slabs(columns, axes, mesh_.extent);
                for (std::size_t i = 0; i < root_.count; ++i) {
                    Floats entry;
                    testLeaf(columns, axes, i, slabs.entering(root_[i], zCut_, entry) & lanes);
                }
            } else {
                for (std::size_t i = 0; i < root_.count; ++i) testLeaf(columns, axes, i, lanes);
            }
            decide(columns, axes);
            writeAnswers(block_, mesh_.tree, results);
        }
    }

private:
    // A triangle that some rays may meet.
    struct Met {
        WideRef leaf;
        std::uint32_t triangle; // number in the leaf
        unsigned candidates, certain;
        alignas(64) float nearest[W], farthest[W];
    };

    void start(const RayColumns& columns, const RayAxes& axes, std::size_t count) {
        setUpAnswers<Q>(columns, axes, count, block_);
        zCut_ = Floats::load(block_.zCut);
        endless_ = bits(Floats::load(block_.below) == Floats(kInfinityF));
        hidden_ = 0, metCount_ = 0;
    }

    void testLeaf(const RayColumns& columns, const RayAxes& axes, std::size_t child,
                  unsigned lanes) {
        if (lanes == 0) return;
        const WideRef ref = root_.node.child[child];
        const auto& leaf = mesh_.tree.at<WideLeaf<W>>(ref);
        alignas(64) float x[W][W], y[W][W], z[W][W]; // of a point, by ray
        int points = 0;
        for (const auto& corner : leaf.corner)
            for (int j = 0; j < leaf.count; ++j) points = std::max(points, corner[j] + 1);
        const Floats shearX = axes.Sx * axes.sign, shearY = axes.Sy * axes.sign;
        for (int i = 0; i < points; ++i) {
            const Floats relative[3] = {Floats(leaf.point[0][i]) - columns.org[0],
                                        Floats(leaf.point[1][i]) - columns.org[1],
                                        Floats(leaf.point[2][i]) - columns.org[2]};
            const Floats depth = axes.dominant(relative);
            depth.store(z[i]);
            (axes.lateralX(relative) - shearX * depth).store(x[i]);
            (axes.lateralY(relative) - shearY * depth).store(y[i]);
        }
        for (std::uint32_t j = 0; j < leaf.count; ++j) {
            Sheared s;
            for (int c = 0; c < 3; ++c) {
                const std::uint8_t i = leaf.corner[c][j];
                s.x[c] = Floats::load(x[i]), s.y[c] = Floats::load(y[i]);
                s.z[c] = Floats::load(z[i]);
            }
            const Judged judged = judge(s, Edges(s), axes.sign);
            if constexpr (Q == Query::Any) hidden_ |= judged.certain(zCut_) & endless_ & lanes;
            const unsigned candidates = judged.candidates(zCut_) & lanes & ~hidden_;
            if (candidates == 0) continue;
            Met& met = met_[metCount_++];
            met.leaf = ref, met.triangle = j;
            met.candidates = candidates;
            if constexpr (Q == Query::Closest) {
                const Floats inverse = Floats(1.0f) / judged.det;
                met.certain = bits(judged.certain()) & candidates;
                judged.nearest(inverse).store(met.nearest);
                judged.farthest(inverse).store(met.farthest);
            }
        }
    }

    // The best hits, or whether there is one.
    void decide(const RayColumns& columns, const RayAxes& axes) {
        if constexpr (Q == Query::Any)
            select(maskOf(hidden_), Ints(0u), Ints::load(block_.triangle)).store(block_.triangle);
        if (metCount_ == 0) return;
        setUpTriangles(columns, axes, mesh_.extent, block_);
        if constexpr (Q == Query::Closest) acceptNearest();
        std::uint32_t n = 0;
        for (std::uint32_t m = 0; m < metCount_; ++m) {
            unsigned left = met_[m].candidates & ~(Q == Query::Any ? hidden_ : block_.open);
            for (; left != 0; left &= left - 1)
                pairs_[n++] = {static_cast<std::uint32_t>(std::countr_zero(left)), met_[m].leaf,
                               met_[m].triangle};
        }
        if (n != 0) settlePairs<Q>(mesh_, rays_, &block_, {pairs_, n}, [](std::uint32_t) {});
        if (block_.open != 0) settleOpen(mesh_, rays_, block_);
    }

    // Rays whose nearest hit is certain without keys need but one, that of the hit.
    void acceptNearest() {
        Floats depth(kInfinityF);
        for (std::uint32_t m = 0; m < metCount_; ++m) {
            const Floats farthest = Floats::load(met_[m].farthest);
            depth = select(maskOf(met_[m].certain), min(farthest, depth), depth);
        }
        unsigned certain = 0, rivals = 0, several = 0;
        Ints leaf(0u), lane(0u);
        for (std::uint32_t m = 0; m < metCount_; ++m) {
            const unsigned here =
                bits(notGreater(Floats::load(met_[m].nearest), depth)) & met_[m].candidates;
            several |= rivals & here;
            rivals |= here;
            certain |= here & met_[m].certain;
            leaf = select(maskOf(here), Ints(met_[m].leaf), leaf);
            lane = select(maskOf(here), Ints(met_[m].triangle), lane);
        }
        block_.open = certain & ~several & endless_;
        leaf.store(block_.bestLeaf), lane.store(block_.bestLane);
    }

    const WideMesh& mesh_;
    const RaySpan& rays_;
    const RootBoxes root_;
    const bool asksBoxes_;
    RayBlock block_;
    Floats zCut_;
    unsigned endless_ = 0, hidden_ = 0; // rays that start where they start, and hidden ones
    std::uint32_t metCount_ = 0;
    Met met_[kMostLeaves * W];
    RayTriangle pairs_[kMostLeaves * W * W];
};
