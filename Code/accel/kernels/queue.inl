// The kernel for rays of any kind. Many rays are on their way at once, each at its next node or
// leaf; two lists say which. A round takes one step with every ray of a list: the steps don't
// depend on each other, so the CPU overlaps their memory accesses and latencies, and nothing but
// the length of the lists is a branch. A nearest hit that is certain in float is taken at once, and
// its canonical key is computed when W rays are done; where bounds overlap, rays wait until there
// are enough of them for the keys of W pairs at once.
// Included by the file of each instruction set inside its namespace, behind handful.inl.

template <Query Q> class Queue {
public:
    Queue(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order)
        : mesh_(mesh), rays_(rays), order_(order), base_(mesh.tree.base()), root_(mesh.tree),
          prefetches_(mesh.tree.lines.size() > kManyLines),
          stride_(strideOfStacks(mesh.tree.stackSize)) {
        const std::size_t stacks = kSlots * stride_ * sizeof(std::uint32_t);
        std::byte* const memory = scratchMemory(kBlocks * sizeof(RayBlock) + 2 * stacks);
        blocks_ = reinterpret_cast<RayBlock*>(memory);
        refs_ = reinterpret_cast<std::uint32_t*>(memory + kBlocks * sizeof(RayBlock));
        entries_ = refs_ + kSlots * stride_;
        for (std::size_t slot = 0; slot < std::min<std::size_t>(kSlots, order.size()); ++slot) {
            refs_[slot * stride_] = wideRef(0, WideKind::None); // the end of every stack
            entries_[slot * stride_] = 0;
        }
    }

    template <class Results> void run(const Results& results) {
        Lists now{lists_[0], lists_[1], lists_[2]}, next{lists_[3], lists_[4], lists_[2]};
        for (std::uint32_t b = 0; b < kBlocks; ++b) refill(b, next, results);
        while (live_ > 0) {
            std::swap(now, next);
            next.nodeCount = next.leafCount = next.doneCount = 0;
            for (std::uint32_t i = 0; i < now.nodeCount; ++i) nodeStep(now.nodes[i], next);
            besideCount_ = 0;
            if (Q == Query::Closest && leafMeetings_ == Meetings::Many)
                leafSteps<Meetings::Many>(now, next);
            else if (leafMeetings_ == Meetings::Few)
                leafSteps<Meetings::Few>(now, next);
            else
                leafSteps<Meetings::Some>(now, next);
            learnMeetings(now.leafCount);
            if constexpr (Q == Query::Closest) acceptMet(next);
            if (waitingPairs_ >= W || next.nodeCount + next.leafCount < kFewBusy)
                settleWaiting(next);
            for (std::uint32_t i = 0; i < next.doneCount; ++i) {
                const std::uint32_t b = next.done[i] / W;
                --live_;
                if (--blocks_[b].live > 0) continue;
                if (blocks_[b].open != 0) settleOpen(mesh_, rays_, blocks_[b]);
                writeAnswers(blocks_[b], mesh_.tree, results);
                refill(b, next, results);
            }
        }
    }

private:
    static constexpr std::uint32_t kSlots = 96; // rays on their way at most
    static constexpr std::uint32_t kBlocks = kSlots / W;
    // Rays that are not waiting for others; with fewer, the others don't wait either.
    static constexpr std::uint32_t kFewBusy = kSlots / 3;
    // Of a tree that the caches don't hold; for others prefetches are work in vain. 4 MB.
    static constexpr std::size_t kManyLines = std::size_t{1} << 16;

    // How many rays meet triangles of their leaves: branches are guessed right where nearly all do
    // the same, and cost more than what they spare elsewhere.
    enum class Meetings { Many, Some, Few };

    // What the rays are at, by their slots.
    struct Lists {
        std::uint32_t *nodes, *leaves, *done;
        std::uint32_t nodeCount = 0, leafCount = 0, doneCount = 0;
    };
    struct Waiting {
        std::uint32_t slot, candidates; // triangles of the leaf that the ray is at
    };

    // Triangles of the leaf that a ray is at, and what Judged says of their depths.
    struct alignas(64) Met {
        float depth[W], noise[W], det[W];
        std::uint32_t slot, candidates, certain; // certain: to be hits
    };

    // ---- rays in, hits out

    // The next rays that enter the tree, if there are any left, take this block. Those that don't
    // are answered at once.
    template <class Results> void refill(std::uint32_t number, Lists& to, const Results& results) {
        RayBlock& b = blocks_[number];
        while (next_ < order_.size()) {
            const unsigned entered = root_.entering(b, takeRays(b));
            if (entered == 0) {
                writeAnswers(b, mesh_.tree, results);
                continue;
            }
            Ints(mesh_.tree.root).store(b.at);
            Ints(1u).store(b.stackTop);
            b.live = static_cast<std::uint32_t>(std::popcount(entered));
            live_ += b.live;
            for (unsigned lanes = entered; lanes != 0; lanes &= lanes - 1)
                to.nodes[to.nodeCount++] =
                    number * W + static_cast<std::uint32_t>(std::countr_zero(lanes));
            return;
        }
    }

    unsigned takeRays(RayBlock& b) {
        const std::size_t count = std::min<std::size_t>(W, order_.size() - next_);
        const unsigned lanes = setUpRays<Q>(rays_, &order_[next_], count, mesh_.extent, b);
        next_ += count;
        return lanes;
    }

    // ---- steps

    // Takes the ray to `ref`: three stores, of which one counts.
    [[gnu::always_inline]] void send(std::uint32_t slot, WideRef ref, Lists& to) const {
        const std::byte* const line = base_ + byteOffset(ref);
        if (prefetches_)
            for (int k = 0; k < 4; ++k) __builtin_prefetch(line + std::ptrdiff_t{64} * k);
        to.nodes[to.nodeCount] = slot;
        to.leaves[to.leafCount] = slot;
        to.done[to.doneCount] = slot;
        to.nodeCount += kindOf(ref) == WideKind::Node;
        to.leafCount += kindOf(ref) == WideKind::Leaf;
        to.doneCount += kindOf(ref) == WideKind::None;
    }

    // RaySetup::enters() for W boxes. With FMA or without: the pads of the slabs are twice those of
    // the canonical hit, and the difference covers either rounding several times.
    [[gnu::always_inline]] void nodeStep(std::uint32_t slot, Lists& to) {
        RayBlock& b = blocks_[slot / W];
        const std::uint32_t i = slot % W;
        const std::byte* const node = base_ + byteOffset(b.at[i]);
        Floats entry(0.0f), exit(b.zCut[i]);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t nearPlane = b.nearPlane[axis][i], farPlane = nearPlane ^ (W * 4);
            const Floats r(b.r[axis][i]);
            entry =
                max(fma(Floats::load(node + nearPlane), r, Floats(b.nearOffset[axis][i])), entry);
            exit = min(fma(Floats::load(node + farPlane), r, Floats(b.farOffset[axis][i])), exit);
        }
        const unsigned hit = bits(entry <= exit);
        const auto* const child =
            reinterpret_cast<const WideRef*>(node + std::ptrdiff_t{6} * W * 4);
        std::uint32_t* const refs = refs_ + slot * stride_;
        const std::uint32_t top = b.stackTop[i];
        // The next one is taken from registers: what was just stored takes long to come back.
        const WideRef nearest = Q == Query::Any ? pushAny(hit, child, refs + top)
                                                : pushSorted(hit, entry, child, refs + top,
                                                             entries_ + slot * stride_ + top);
        // Without a child, what was on top before.
        const WideRef before = refs[top - 1];
        const WideRef next = hit != 0 ? nearest : before;
        b.stackTop[i] = top + static_cast<std::uint32_t>(std::popcount(hit)) - 1;
        b.at[i] = next;
        send(slot, next, to);
    }

    template <Meetings M> void leafSteps(const Lists& now, Lists& next) {
        for (std::uint32_t i = 0; i < now.leafCount; ++i) leafStep<M>(now.leaves[i], next);
    }

    // From one round for the next.
    void learnMeetings(std::uint32_t leaves) {
        leafMeetings_ = metCount_ * 3 > leaves                 ? Meetings::Many
                        : (leaves - besideCount_) * 8 < leaves ? Meetings::Few
                                                               : Meetings::Some;
    }

    template <Meetings M> [[gnu::always_inline]] void leafStep(std::uint32_t slot, Lists& to) {
        RayBlock& b = blocks_[slot / W];
        const std::uint32_t i = slot % W;
        const auto& leaf = *reinterpret_cast<const WideLeaf<W>*>(base_ + byteOffset(b.at[i]));
        const Sheared corners = sheared(b, i, leaf);
        const Edges edges(corners);
        const unsigned all = (1u << leaf.count) - 1;
        if constexpr (M != Meetings::Many) {
            const bool isBeside = (bits(edges.around()) & all) == 0; // all triangles
            besideCount_ += isBeside;
            if (M == Meetings::Few && isBeside) [[likely]]
                return pop(slot, to);
        }
        const Judged judged = judge(corners, edges, Floats(b.sign[i]));
        const Floats zCut(b.zCut[i]);
        unsigned candidates = judged.candidates(zCut) & all;
        if constexpr (Q == Query::Any) {
            const bool met = (judged.certain(zCut) & all) != 0 && b.below[i] == kInfinityF;
            b.triangle[i] = met ? 0 : b.triangle[i];
            b.stackTop[i] = met ? 1 : b.stackTop[i];
            candidates = met ? 0 : candidates;
        }
        if (M != Meetings::Many && candidates == 0) [[likely]]
            return pop(slot, to);
        if constexpr (Q == Query::Any) {
            wait(slot, candidates);
        } else {
            passed_[passedCount_] = slot;
            passedCount_ += candidates == 0;
            Met& met = met_[metCount_];
            metCount_ += candidates != 0;
            met.slot = slot, met.candidates = candidates;
            met.certain = bits(judged.certain()) & candidates;
            judged.depth.store(met.depth), judged.noise.store(met.noise);
            judged.det.store(met.det);
        }
    }

    void wait(std::uint32_t slot, std::uint32_t candidates) {
        waiting_[waitingCount_++] = {slot, candidates};
        waitingPairs_ += static_cast<std::uint32_t>(std::popcount(candidates));
    }

    // Takes for each ray the candidate that is nearest, if that is certain without keys; the key of
    // what remains the best one is computed at the end.
    void acceptMet(Lists& to) {
        for (std::uint32_t i = 0; i < passedCount_; ++i) pop(passed_[i], to);
        passedCount_ = 0;
        for (std::uint32_t m = 0; m < metCount_; ++m) {
            const Met& met = met_[m];
            if (accept(met))
                pop(met.slot, to);
            else
                wait(met.slot, met.candidates);
        }
        metCount_ = 0;
    }

    [[gnu::always_inline]] bool accept(const Met& met) {
        RayBlock& b = blocks_[met.slot / W];
        const std::uint32_t i = met.slot % W;
        Judged judged;
        judged.depth = Floats::load(met.depth), judged.noise = Floats::load(met.noise);
        const Floats never(kInfinityF), inverse = Floats(1.0f) / Floats::load(met.det);
        const Floats nearest = judged.nearest(inverse), farthest = judged.farthest(inverse);
        alignas(64) float each[W];
        nearest.store(each);
        const float depth = smallest(select(maskOf(met.certain), farthest, never));
        const unsigned rivals = bits(notGreater(nearest, Floats(depth))) & met.candidates;
        if (!std::has_single_bit(rivals) || (rivals & met.certain) == 0 || !(depth < b.depth[i]) ||
            b.below[i] != kInfinityF) [[unlikely]]
            return false;
        b.bestLane[i] = static_cast<std::uint32_t>(std::countr_zero(rivals));
        b.bestLeaf[i] = b.at[i];
        b.depth[i] = each[b.bestLane[i]];
        b.zCut[i] = ::min(depth, b.zCut[i]);
        b.open |= 1u << i;
        dropBehind(met.slot);
        return true;
    }

    [[gnu::always_inline]] void pop(std::uint32_t slot, Lists& to) {
        RayBlock& b = blocks_[slot / W];
        const std::uint32_t i = slot % W, top = b.stackTop[i] - 1;
        const WideRef ref = refs_[slot * stride_ + top];
        b.stackTop[i] = top;
        b.at[i] = ref;
        send(slot, ref, to);
    }

    // ShearedTriangle of accel/triangle.h for the triangles of a leaf: they share their points.
    [[gnu::always_inline]] static Sheared sheared(const RayBlock& b, std::uint32_t i,
                                                  const WideLeaf<W>& leaf) {
        const std::byte* const p = reinterpret_cast<const std::byte*>(&leaf);
        const Floats x = Floats::load(p + b.axis[0][i]) - Floats(b.origin[0][i]);
        const Floats y = Floats::load(p + b.axis[1][i]) - Floats(b.origin[1][i]);
        const Floats z = Floats::load(p + b.axis[2][i]) - Floats(b.origin[2][i]);
        const Floats xs = x - Floats(b.shearX[i]) * z, ys = y - Floats(b.shearY[i]) * z;
        Sheared s;
        for (int c = 0; c < 3; ++c) {
            const Ints at = Ints::bytes(leaf.corner[c]);
            s.x[c] = permute(xs, at), s.y[c] = permute(ys, at), s.z[c] = permute(z, at);
        }
        return s;
    }

    // What the best hit hides is taken off the ray's stack.
    void dropBehind(std::uint32_t slot) {
        RayBlock& b = blocks_[slot / W];
        const std::size_t stack = slot * stride_;
        std::uint32_t& top = b.stackTop[slot % W];
        top = dropHidden(refs_ + stack, entries_ + stack, top, b.zCut[slot % W]);
    }

    // ---- canonical keys

    void settleWaiting(Lists& to) {
        std::uint32_t n = 0;
        for (std::uint32_t w = 0; w < waitingCount_; ++w) {
            const auto [slot, candidates] = waiting_[w];
            const WideRef leaf = blocks_[slot / W].at[slot % W];
            if constexpr (Q == Query::Closest) reopen(slot, n);
            for (unsigned left = candidates; left != 0; left &= left - 1)
                pairs_[n++] = {slot, leaf, static_cast<std::uint32_t>(std::countr_zero(left))};
        }
        takePairs(n);
        for (std::uint32_t w = 0; w < waitingCount_; ++w) pop(waiting_[w].slot, to);
        waitingCount_ = waitingPairs_ = 0;
    }

    // A hit without a key that others come near needs one, too.
    void reopen(std::uint32_t slot, std::uint32_t& n) {
        RayBlock& b = blocks_[slot / W];
        const std::uint32_t i = slot % W;
        if ((b.open >> i & 1) == 0) return;
        b.open &= ~(1u << i);
        pairs_[n++] = {slot, b.bestLeaf[i], b.bestLane[i]};
    }

    void takePairs(std::uint32_t n) {
        settlePairs<Q>(mesh_, rays_, blocks_, {pairs_, n}, [this](std::uint32_t slot) {
            if constexpr (Q == Query::Any)
                blocks_[slot / W].stackTop[slot % W] = 1; // only the end
            else
                dropBehind(slot);
        });
    }

    const WideMesh& mesh_;
    const RaySpan& rays_;
    std::span<const std::uint32_t> order_;
    const std::byte* base_;
    RootQuestion root_;
    const bool prefetches_;
    std::size_t stride_, next_ = 0;
    RayBlock* blocks_;
    std::uint32_t *refs_, *entries_; // a stack per slot; entries only for nearest hits
    std::uint32_t live_ = 0;
    // One place more than rays: send() writes to lists that are full.
    std::uint32_t lists_[5][kSlots + 1];
    Waiting waiting_[kSlots];
    Met met_[kSlots + 1];
    std::uint32_t passed_[kSlots + 1]; // rays that met nothing in their leaves
    std::uint32_t metCount_ = 0, passedCount_ = 0;
    std::uint32_t besideCount_ = 0;
    Meetings leafMeetings_ = Meetings::Some; // in the last round
    std::uint32_t waitingCount_ = 0, waitingPairs_ = 0;
    RayTriangle pairs_[kSlots * (W + 1)];
};

template <Query Q, class Results>
void traceOneByOne(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order,
                   const Results& results) {
    if (mesh.tree.leaves <= Handful<Q>::kMostLeaves)
        Handful<Q>(mesh, rays).run(order, results);
    else
        Queue<Q>(mesh, rays, order).run(results);
}

void closest(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order,
             const HitLists& hits) {
    traceOneByOne<Query::Closest>(mesh, rays, order, hits);
}
void any(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order,
         std::uint8_t* hidden) {
    traceOneByOne<Query::Any>(mesh, rays, order, hidden);
}
