// Trees of a few leaves, in which no ray is worth a way of its own: W rays at once against one
// triangle after the other.
// Included by the file of each instruction set inside its namespace, in front of queue.inl.

template <Query Q> class Handful {
public:
    static constexpr std::uint64_t kMostLeaves = 2;

    Handful(const WideMesh& mesh, const RaySpan& rays)
        : mesh_(mesh), rays_(rays), root_(mesh.tree) {}

    template <class Results>
    void run(std::span<const std::uint32_t> order, const Results& results) {
        RayBlock b;
        for (std::size_t next = 0; next < order.size(); next += W) {
            const std::size_t count = std::min<std::size_t>(W, order.size() - next);
            const unsigned lanes = setUpRays<Q>(rays_, &order[next], count, mesh_.extent, b);
            for (std::size_t i = 0; i < root_.count; ++i)
                if (const unsigned entered = raysEntering(b, root_[i]) & lanes; entered != 0)
                    testLeaf(b, root_.node.child[i], entered);
            writeAnswers(b, mesh_.tree, results);
        }
    }

private:
    void testLeaf(RayBlock& b, WideRef ref, unsigned lanes) {
        const auto& leaf = mesh_.tree.at<WideLeaf<W>>(ref);
        alignas(64) float x[W][W], y[W][W], z[W][W]; // of a point, by ray
        int points = 0;
        for (const auto& corner : leaf.corner)
            for (int j = 0; j < leaf.count; ++j) points = std::max(points, corner[j] + 1);
        const Mask alongZ = Ints::load(b.axis[2]) == Ints(2 * W * 4);
        const Mask alongY = Ints::load(b.axis[2]) == Ints(W * 4);
        const auto pick = [&](const float* p, int ifX, int ifY, int ifZ) {
            const auto at = [&](int axis) { return Floats(p[axis * W]); };
            return select(alongZ, at(ifZ), select(alongY, at(ifY), at(ifX)));
        };
        for (int i = 0; i < points; ++i) {
            const float* const p = &leaf.point[0][i];
            const Floats depth = pick(p, 0, 1, 2) - Floats::load(b.origin[2]);
            const Floats px = pick(p, 1, 2, 0) - Floats::load(b.origin[0]);
            const Floats py = pick(p, 2, 0, 1) - Floats::load(b.origin[1]);
            depth.store(z[i]);
            (px - Floats::load(b.shearX) * depth).store(x[i]);
            (py - Floats::load(b.shearY) * depth).store(y[i]);
        }
        const Floats sign = Floats::load(b.sign), zCut = Floats::load(b.zCut);
        const unsigned endless = bits(Floats::load(b.below) == Floats(kInfinityF));
        std::uint32_t n = 0;
        unsigned hidden = 0;
        for (std::uint32_t j = 0; j < leaf.count; ++j) {
            Sheared s;
            for (int c = 0; c < 3; ++c) {
                const std::uint8_t i = leaf.corner[c][j];
                s.x[c] = Floats::load(x[i]), s.y[c] = Floats::load(y[i]);
                s.z[c] = Floats::load(z[i]);
            }
            const Judged judged = judge(s, sign);
            if constexpr (Q == Query::Any) hidden |= judged.certain(zCut) & endless & lanes;
            unsigned left = judged.candidates(zCut) & lanes & ~hidden;
            for (; left != 0; left &= left - 1)
                pairs_[n++] = {static_cast<std::uint32_t>(std::countr_zero(left)), ref, j};
        }
        if constexpr (Q == Query::Any)
            select(maskOf(hidden), Ints(0u), Ints::load(b.triangle)).store(b.triangle);
        if (n != 0) settlePairs<Q>(mesh_, rays_, &b, {pairs_, n}, [](std::uint32_t) {});
    }

    const WideMesh& mesh_;
    const RaySpan& rays_;
    const RootBoxes root_;
    RayTriangle pairs_[W * W];
};
