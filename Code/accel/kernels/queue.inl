// The kernel for rays of any kind. Many rays are on their way at once, each at its next node or
// leaf; two lists say which. A round takes one step with every ray of a list: the steps don't
// depend on each other, so the CPU overlaps their memory accesses and latencies, and nothing but
// the length of the lists is a branch. A nearest hit that is certain in float is taken at once, and
// its canonical key is computed when W rays are done; where bounds overlap, rays wait until there
// are enough of them for the keys of W pairs at once.
// Included by the file of each instruction set inside its namespace, behind queue_slots.inl.

template <Query Q> class Queue {
    using Lists = QueueSlots::Lists;
    using Counts = QueueSlots::Counts;

public:
    Queue(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order)
        : mesh_(mesh), rays_(rays), order_(order), base_(mesh.tree.base()), root_(mesh.tree),
          slots_(mesh.tree, order.size()) {}

    template <class Results> void run(const Results& results) {
        Lists *now = &lists_[0], *next = &lists_[1];
        Counts count;
        for (std::uint32_t b = 0; b < kBlocks; ++b) refill(b, *next, count, results);
        while (live_ > 0) {
            std::swap(now, next);
            const Counts all = std::exchange(count, {});
            for (std::uint32_t i = 0; i < all.nodes; ++i) nodeStep(now->nodes[i], *next, count);
            takeLeaves(*now, all.leaves, *next, count);
            if (waitingPairs_ >= W || count.nodes + count.leaves < kFewBusy)
                settleWaiting(*next, count);
            for (std::uint32_t i = 0; i < count.done; ++i) {
                const std::uint32_t number = QueueSlots::blockOf(next->done[i]);
                RayBlock& b = slots_.block(number);
                --live_;
                if (--b.live > 0) continue;
                if (b.open != 0) settleOpen(mesh_, rays_, b);
                writeAnswers(b, mesh_.tree, results);
                refill(number, *next, count, results);
            }
        }
    }

private:
    static constexpr std::uint32_t kSlots = QueueSlots::kSlots, kBlocks = QueueSlots::kBlocks;
    // Rays that are not waiting for others; with fewer, the others don't wait either.
    static constexpr std::uint32_t kFewBusy = kSlots / 3;

    // How many rays meet triangles of their leaves: branches are guessed right where nearly all do
    // the same, and cost more than what they spare elsewhere.
    enum class Meetings { Many, Some, Few };

    struct Waiting {
        Slot slot;
        std::uint32_t candidates; // triangles of the leaf that the ray is at
    };

    // Triangles of the leaf that a ray is at, and what Judged says of their depths.
    struct alignas(64) Met {
        float depth[W], noise[W], det[W];
        Slot slot;
        std::uint32_t candidates, certain; // certain: to be hits
    };

    // What the leaves of a round had.
    struct Found {
        std::uint32_t met = 0, passed = 0, beside = 0;
    };

    // ---- rays in, hits out

    // The next rays that enter the tree, if there are any left, take this block. Those that don't
    // are answered at once.
    template <class Results>
    void refill(std::uint32_t number, Lists& to, Counts& count, const Results& results) {
        RayBlock& b = slots_.block(number);
        while (next_ < order_.size()) {
            const unsigned entered = root_.entering(b, takeRays(b));
            if (entered == 0) {
                writeAnswers(b, mesh_.tree, results);
                continue;
            }
            slots_.start(number, mesh_.tree.root);
            b.live = static_cast<std::uint32_t>(std::popcount(entered));
            live_ += b.live;
            for (unsigned lanes = entered; lanes != 0; lanes &= lanes - 1)
                to.nodes[count.nodes++] =
                    QueueSlots::slotOf(number, static_cast<std::uint32_t>(std::countr_zero(lanes)));
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

    // RaySetup::enters() for W boxes. With FMA or without: the pads of the slabs are twice those of
    // the canonical hit, and the difference covers either rounding several times.
    [[gnu::always_inline]] void nodeStep(Slot slot, Lists& to, Counts& count) {
        const std::byte* const node = base_ + byteOffset(slots_.at(slot, &RayBlock::at));
        Floats entry(0.0f), exit(slots_.at(slot, &RayBlock::zCut));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t nearPlane = slots_.at(slot, &RayBlock::nearPlane, axis);
            const std::uint32_t farPlane = nearPlane ^ (W * 4);
            const Floats r(slots_.at(slot, &RayBlock::r, axis));
            entry = max(fma(Floats::load(node + nearPlane), r,
                            Floats(slots_.at(slot, &RayBlock::nearOffset, axis))),
                        entry);
            exit = min(fma(Floats::load(node + farPlane), r,
                           Floats(slots_.at(slot, &RayBlock::farOffset, axis))),
                       exit);
        }
        const Mask hit = entry <= exit;
        const unsigned lanes = bits(hit);
        const int hits = std::popcount(lanes);
        const auto* const child =
            reinterpret_cast<const WideRef*>(node + std::ptrdiff_t{6} * W * 4);
        std::uint32_t& top = slots_.at(slot, &RayBlock::stackTop);
        std::uint32_t* const refs = slots_.refs(top);
        // The next one is taken from registers: what was just stored takes long to come back.
        const WideRef nearest =
            Q == Query::Any ? pushAny(hit, lanes, child, refs)
                            : pushSorted(hit, hits, entry, child, refs, slots_.entries(top));
        // Without a child, what was on top before.
        const WideRef before = refs[-1];
        const WideRef next = hits != 0 ? nearest : before;
        top = top + static_cast<std::uint32_t>(hits) - 1;
        slots_.send(slot, next, to, count);
    }

    void takeLeaves(const Lists& now, std::uint32_t leaves, Lists& next, Counts& count) {
        Found found;
        if (Q == Query::Closest && leafMeetings_ == Meetings::Many)
            found = leafSteps<Meetings::Many>(now, leaves, next, count);
        else if (leafMeetings_ == Meetings::Few)
            found = leafSteps<Meetings::Few>(now, leaves, next, count);
        else
            found = leafSteps<Meetings::Some>(now, leaves, next, count);
        leafMeetings_ = found.met * 3 > leaves                 ? Meetings::Many
                        : (leaves - found.beside) * 8 < leaves ? Meetings::Few
                                                               : Meetings::Some;
        if constexpr (Q == Query::Closest) acceptMet(found, next, count);
    }

    template <Meetings M>
    Found leafSteps(const Lists& now, std::uint32_t leaves, Lists& next, Counts& count) {
        Found found;
        Counts here = count; // in registers
        for (std::uint32_t i = 0; i < leaves; ++i) leafStep<M>(now.leaves[i], found, next, here);
        count = here;
        return found;
    }

    template <Meetings M>
    [[gnu::always_inline]] void leafStep(Slot slot, Found& found, Lists& to, Counts& count) {
        const auto& leaf = *reinterpret_cast<const WideLeaf<W>*>(
            base_ + byteOffset(slots_.at(slot, &RayBlock::at)));
        const Sheared corners = sheared(slot, leaf);
        const Edges edges(corners);
        const unsigned all = (1u << leaf.count) - 1;
        if constexpr (M != Meetings::Many) {
            const bool isBeside = (bits(edges.around()) & all) == 0; // all triangles
            found.beside += isBeside;
            if (M == Meetings::Few && isBeside) [[likely]]
                return slots_.pop(slot, to, count);
        }
        const Judged judged = judge(corners, edges, Floats(slots_.at(slot, &RayBlock::sign)));
        const Floats zCut(slots_.at(slot, &RayBlock::zCut));
        unsigned candidates = judged.candidates(zCut) & all;
        if constexpr (Q == Query::Any) {
            const bool met = (judged.certain(zCut) & all) != 0 &&
                             slots_.at(slot, &RayBlock::below) == kInfinityF;
            std::uint32_t& triangle = slots_.at(slot, &RayBlock::triangle);
            std::uint32_t& top = slots_.at(slot, &RayBlock::stackTop);
            triangle = met ? 0 : triangle;
            top = met ? slots_.at(slot, &RayBlock::bottom) + 1 : top;
            candidates = met ? 0 : candidates;
        }
        if (M != Meetings::Many && candidates == 0) [[likely]]
            return slots_.pop(slot, to, count);
        if constexpr (Q == Query::Any) {
            wait(slot, candidates);
        } else {
            passed_[found.passed] = slot;
            found.passed += candidates == 0;
            Met& met = met_[found.met];
            found.met += candidates != 0;
            met.slot = slot, met.candidates = candidates;
            met.certain = bits(judged.certain()) & candidates;
            judged.depth.store(met.depth), judged.noise.store(met.noise);
            judged.det.store(met.det);
        }
    }

    void wait(Slot slot, std::uint32_t candidates) {
        waiting_[waitingCount_++] = {slot, candidates};
        waitingPairs_ += static_cast<std::uint32_t>(std::popcount(candidates));
    }

    // Takes for each ray the candidate that is nearest, if that is certain without keys; the key of
    // what remains the best one is computed at the end.
    void acceptMet(const Found& found, Lists& to, Counts& count) {
        for (std::uint32_t i = 0; i < found.passed; ++i) slots_.pop(passed_[i], to, count);
        for (std::uint32_t m = 0; m < found.met; ++m) {
            const Met& met = met_[m];
            if (accept(met))
                slots_.pop(met.slot, to, count);
            else
                wait(met.slot, met.candidates);
        }
    }

    [[gnu::always_inline]] bool accept(const Met& met) {
        const Slot slot = met.slot;
        Judged judged;
        judged.depth = Floats::load(met.depth), judged.noise = Floats::load(met.noise);
        const Floats never(kInfinityF), inverse = Floats(1.0f) / Floats::load(met.det);
        const Floats nearest = judged.nearest(inverse), farthest = judged.farthest(inverse);
        alignas(64) float each[W];
        nearest.store(each);
        const float depth = smallest(select(maskOf(met.certain), farthest, never));
        const unsigned rivals = bits(notGreater(nearest, Floats(depth))) & met.candidates;
        float& best = slots_.at(slot, &RayBlock::depth);
        if (!std::has_single_bit(rivals) || (rivals & met.certain) == 0 || !(depth < best) ||
            slots_.at(slot, &RayBlock::below) != kInfinityF) [[unlikely]]
            return false;
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(rivals));
        slots_.at(slot, &RayBlock::bestLane) = lane;
        slots_.at(slot, &RayBlock::bestLeaf) = slots_.at(slot, &RayBlock::at);
        best = each[lane];
        float& zCut = slots_.at(slot, &RayBlock::zCut);
        zCut = ::min(depth, zCut);
        slots_.block(QueueSlots::blockOf(slot)).open |= 1u << QueueSlots::laneOf(slot);
        slots_.dropBehind(slot);
        return true;
    }

    // ShearedTriangle of accel/triangle.h for the triangles of a leaf: they share their points.
    [[gnu::always_inline]] Sheared sheared(Slot slot, const WideLeaf<W>& leaf) const {
        const std::byte* const p = reinterpret_cast<const std::byte*>(&leaf);
        const auto relative = [&](std::size_t axis) {
            return Floats::load(p + slots_.at(slot, &RayBlock::axis, axis)) -
                   Floats(slots_.at(slot, &RayBlock::origin, axis));
        };
        const Floats x = relative(0), y = relative(1), z = relative(2);
        const Floats xs = x - Floats(slots_.at(slot, &RayBlock::shearX)) * z,
                     ys = y - Floats(slots_.at(slot, &RayBlock::shearY)) * z;
        Sheared s;
        for (int c = 0; c < 3; ++c) {
            const Ints at = Ints::bytes(leaf.corner[c]);
            s.x[c] = permute(xs, at), s.y[c] = permute(ys, at), s.z[c] = permute(z, at);
        }
        return s;
    }

    // ---- canonical keys

    void settleWaiting(Lists& to, Counts& count) {
        std::uint32_t n = 0;
        for (std::uint32_t w = 0; w < waitingCount_; ++w) {
            const auto [slot, candidates] = waiting_[w];
            const WideRef leaf = slots_.at(slot, &RayBlock::at);
            if constexpr (Q == Query::Closest) reopen(slot, n);
            for (unsigned left = candidates; left != 0; left &= left - 1)
                pairs_[n++] = {numberOf(slot), leaf,
                               static_cast<std::uint32_t>(std::countr_zero(left))};
        }
        takePairs(n);
        for (std::uint32_t w = 0; w < waitingCount_; ++w) slots_.pop(waiting_[w].slot, to, count);
        waitingCount_ = waitingPairs_ = 0;
    }

    // A hit without a key that others come near needs one, too.
    void reopen(Slot slot, std::uint32_t& n) {
        RayBlock& b = slots_.block(QueueSlots::blockOf(slot));
        const std::uint32_t i = QueueSlots::laneOf(slot);
        if ((b.open >> i & 1) == 0) return;
        b.open &= ~(1u << i);
        pairs_[n++] = {numberOf(slot), b.bestLeaf[i], b.bestLane[i]};
    }

    // As pairs have it.
    static std::uint32_t numberOf(Slot slot) {
        return QueueSlots::blockOf(slot) * W + QueueSlots::laneOf(slot);
    }

    void takePairs(std::uint32_t n) {
        settlePairs<Q>(mesh_, rays_, slots_.blocks(), {pairs_, n}, [this](std::uint32_t number) {
            const Slot slot = QueueSlots::slotOf(number / W, number % W);
            if constexpr (Q == Query::Any)
                slots_.leaveOnlyEnd(slot);
            else
                slots_.dropBehind(slot);
        });
    }

    const WideMesh& mesh_;
    const RaySpan& rays_;
    std::span<const std::uint32_t> order_;
    const std::byte* base_;
    RootQuestion root_;
    std::size_t next_ = 0;
    QueueSlots slots_;
    std::uint32_t live_ = 0;
    Lists lists_[2];
    Waiting waiting_[kSlots];
    Met met_[kSlots + 1];
    Slot passed_[kSlots + 1];                // rays that met nothing in their leaves
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
