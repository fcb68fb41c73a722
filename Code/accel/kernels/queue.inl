// The kernel for rays of any kind. Many rays are on their way at once, each at its next node or
// leaf; two lists say which. A round takes one step with every ray of a list: the steps don't
// depend on each other, so the CPU overlaps their memory accesses and latencies, and nothing but
// the length of the lists is a branch.
// Included by the file of each instruction set inside its namespace.

enum class Query { Closest, Any };

// What every step of a ray reads, for W rays: RaySetup of accel/ray_setup.h by columns.
struct alignas(64) RayBlock {
    float r[3][W], nearOffset[3][W], farOffset[3][W]; // slabs of boxes by axis, in z
    std::uint32_t nearPlane[3][W];                    // where in a node, in bytes
    float zCut[W];
    // Triangles: origin and coordinates in the order lateral x, lateral y, depth.
    float origin[3][W];
    std::uint32_t axis[3][W];   // where in a leaf, in bytes
    float shearX[W], shearY[W]; // the slopes, for depths without the sign of the direction
    float sign[W];              // of the direction along z
    float lateralError[W];      // of a vertex in the ray's frame, 4 units of the space's size
    float key[W], below[W], dz[W];
    std::uint32_t at[W], stackTop[W], triangle[W], ray[W];
    std::uint32_t bestLeaf[W], bestLane[W]; // where the triangle is
    std::uint32_t count, live;              // rays at the start and now
};

template <Query Q> class Queue {
public:
    Queue(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order)
        : mesh_(mesh), rays_(rays), order_(order), base_(mesh.tree.base()),
          // An odd number of lines between stacks spreads them over the sets of the cache.
          stride_(((mesh.tree.stackSize + std::size_t{2} * W + 15) / 16 | 1) * 16) {
        const std::size_t stacks = kSlots * stride_ * sizeof(std::uint32_t);
        std::byte* const memory = scratchMemory(kBlocks * sizeof(RayBlock) + 2 * stacks);
        blocks_ = reinterpret_cast<RayBlock*>(memory);
        refs_ = reinterpret_cast<std::uint32_t*>(memory + kBlocks * sizeof(RayBlock));
        entries_ = refs_ + kSlots * stride_;
    }

    template <class Results> void run(const Results& results) {
        Lists now{lists_[0], lists_[1], lists_[2]}, next{lists_[3], lists_[4], lists_[2]};
        for (std::uint32_t b = 0; b < kBlocks && next_ < order_.size(); ++b) start(b, next);
        while (live_ > 0) {
            std::swap(now, next);
            next.nodeCount = next.leafCount = next.doneCount = 0;
            for (std::uint32_t i = 0; i < now.nodeCount; ++i) nodeStep(now.nodes[i], next);
            for (std::uint32_t i = 0; i < now.leafCount; ++i) leafStep(now.leaves[i], next);
            for (std::uint32_t i = 0; i < next.doneCount; ++i) {
                const std::uint32_t b = next.done[i] / W;
                --live_;
                if (--blocks_[b].live > 0) continue;
                finish(blocks_[b], results);
                if (next_ < order_.size()) start(b, next);
            }
        }
    }

private:
    static constexpr std::uint32_t kSlots = 64; // rays on their way at most
    static constexpr std::uint32_t kBlocks = kSlots / W;

    // What the rays are at, by their slots.
    struct Lists {
        std::uint32_t *nodes, *leaves, *done;
        std::uint32_t nodeCount = 0, leafCount = 0, doneCount = 0;
    };

    // ---- rays in, hits out

    // RaySetup for the next W rays; the formulas are its own, lane by lane.
    void start(std::uint32_t number, Lists& to) {
        RayBlock& b = blocks_[number];
        const std::size_t count = std::min<std::size_t>(W, order_.size() - next_);
        alignas(64) float o[3][W], d[3][W], tMin[W], tMax[W];
        for (std::size_t i = 0; i < W; ++i) {
            const std::uint32_t ray = order_[next_ + (i < count ? i : 0)];
            const Vec3 org = rays_.org[ray], dir = rays_.dir[ray];
            o[0][i] = org.x, o[1][i] = org.y, o[2][i] = org.z;
            d[0][i] = dir.x, d[1][i] = dir.y, d[2][i] = dir.z;
            tMin[i] = rays_.tMin[ray], tMax[i] = rays_.tMax[ray];
            b.ray[i] = ray;
        }
        next_ += count;
        const Floats one(1.0f), zero(0.0f);
        const Floats ox = Floats::load(o[0]), oy = Floats::load(o[1]), oz = Floats::load(o[2]);
        const Floats dx = Floats::load(d[0]), dy = Floats::load(d[1]), dz = Floats::load(d[2]);
        const Floats ax = abs(dx), ay = abs(dy), az = abs(dz);
        const Mask alongZ = (az >= ax) & (az >= ay), alongY = ay >= ax;
        const auto pick = [&](Floats x, Floats y, Floats z) {
            return select(alongZ, z, select(alongY, y, x));
        };
        const Floats depth = pick(dx, dy, dz), dMax = abs(depth);
        const Floats sign = select(depth < zero, Floats(-1.0f), one);
        const Floats Sx = pick(dy, dz, dx) / dMax, Sy = pick(dz, dx, dy) / dMax;
        const Floats smallest(RaySetup::kSmallestSlope);
        const Floats rx = one / withSign(max(abs(Sx), smallest), Sx);
        const Floats ry = one / withSign(max(abs(Sy), smallest), Sy);
        const Floats oMax = max(max(abs(ox), abs(oy)), abs(oz));
        const Floats e = max(Floats(mesh_.extent), oMax) * Floats(0x1p-19f);
        const Floats px = e * abs(rx), py = e * abs(ry);
        const auto slab = [&](std::size_t axis, Floats org, Floats r, Floats pad) {
            const Floats at = (zero - org) * r, twice = pad + pad;
            r.store(b.r[axis]);
            (at - twice).store(b.nearOffset[axis]);
            (at + twice).store(b.farOffset[axis]);
            const auto plane = [&](std::uint32_t upper) {
                return Ints(static_cast<std::uint32_t>(axis * 2 + upper) * W * 4);
            };
            select(r < zero, plane(1), plane(0)).store(b.nearPlane[axis]);
        };
        slab(0, ox, pick(sign, ry, rx), pick(e, py, px));
        slab(1, oy, pick(rx, sign, ry), pick(px, e, py));
        slab(2, oz, pick(ry, rx, sign), pick(py, px, e));

        pick(oy, oz, ox).store(b.origin[0]);
        pick(oz, ox, oy).store(b.origin[1]);
        pick(ox, oy, oz).store(b.origin[2]);
        const auto place = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
            constexpr std::uint32_t row = W * 4;
            return select(alongZ, Ints(z * row), select(alongY, Ints(y * row), Ints(x * row)));
        };
        place(1, 2, 0).store(b.axis[0]);
        place(2, 0, 1).store(b.axis[1]);
        place(0, 1, 2).store(b.axis[2]);
        (Sx * sign).store(b.shearX);
        (Sy * sign).store(b.shearY);
        sign.store(b.sign);
        (e * Floats(0.125f)).store(b.lateralError);
        dMax.store(b.dz);
        // Keys that count are in (above, below); see KeyRange of shape/triangle_queries.h.
        const Floats above = keyAbove(Floats::load(tMax), dMax);
        const Floats zCut = select(above > zero, (one / above) * Floats(1.0000005f),
                                   Floats(std::numeric_limits<float>::max()));
        (Q == Query::Any ? above : zero).store(b.key);
        keyBelow(Floats::load(tMin), dMax).store(b.below);
        // isTraceable(): what it refuses enters no box.
        const Floats sum = ((dx + dy) + dz) + ((ox + oy) + oz);
        const Floats dLargest = max(max(ax, ay), az);
        const Mask traceable = (dLargest > Floats(1e-30f)) & (dLargest < Floats(1e30f)) &
                               (oMax < Floats(1e30f)) & (sum - sum == zero);
        select(traceable, zCut, Floats(-1.0f)).store(b.zCut);

        b.count = b.live = static_cast<std::uint32_t>(count);
        live_ += b.live;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t slot = number * W + i;
            b.triangle[i] = TriangleHit::kNone;
            b.at[i] = mesh_.tree.root;
            b.stackTop[i] = 1;
            refs_[slot * stride_] = wideRef(0, WideKind::None); // the end of every stack
            entries_[slot * stride_] = 0;
            to.nodes[to.nodeCount++] = slot;
        }
    }

    void finish(const RayBlock& b, const HitLists& hits) const {
        alignas(64) float t[W];
        (Floats(1.0f) / (Floats::load(b.key) * Floats::load(b.dz))).store(t);
        unsigned found = 0;
        for (std::size_t i = 0; i < b.count; ++i) {
            const float tMax = rays_.tMax[b.ray[i]];
            const bool hit = b.triangle[i] != TriangleHit::kNone && t[i] <= tMax;
            found |= static_cast<unsigned>(hit) << i;
            if (!hit)
                hits.miss(b.ray[i], tMax);
            else if (hits.whole == nullptr)
                hits.brief[b.ray[i]] = {t[i], b.triangle[i]};
        }
        if (hits.whole != nullptr && found != 0) finishWhole(b, t, found, hits);
    }
    void finishWhole(const RayBlock& b, const float* t, unsigned found,
                     const HitLists& hits) const {
        alignas(64) float point[3][3][W] = {}; // axis as in the block, corner
        for (unsigned lanes = found; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            const std::byte* const p = base_ + byteOffset(b.bestLeaf[i]);
            const auto& leaf = *reinterpret_cast<const WideLeaf<W>*>(p);
            for (int c = 0; c < 3; ++c) {
                const std::uint8_t corner = leaf.corner[c][b.bestLane[i]];
                for (int axis = 0; axis < 3; ++axis)
                    point[axis][c][i] = reinterpret_cast<const float*>(p + b.axis[axis][i])[corner];
            }
        }
        Floats x[3], y[3];
        for (int c = 0; c < 3; ++c) {
            const auto relative = [&](int axis) {
                return Floats::load(point[axis][c]) - Floats::load(b.origin[axis]);
            };
            const Floats z = relative(2);
            x[c] = relative(0) - Floats::load(b.shearX) * z;
            y[c] = relative(1) - Floats::load(b.shearY) * z;
        }
        const Weights weights = barycentrics(x, y);
        alignas(64) float u[W], v[W];
        weights.u.store(u), weights.v.store(v);
        for (; found != 0; found &= found - 1) {
            const int i = std::countr_zero(found);
            hits.whole[b.ray[i]] = {t[i], u[i], v[i], b.triangle[i], hits.shape};
        }
    }
    void finish(const RayBlock& b, std::uint8_t* hidden) const {
        for (std::size_t i = 0; i < b.count; ++i)
            hidden[b.ray[i]] = b.triangle[i] != TriangleHit::kNone;
    }

    // ---- steps

    // Takes the ray to `ref`: three stores, of which one counts.
    [[gnu::always_inline]] void send(std::uint32_t slot, WideRef ref, Lists& to) const {
        const std::byte* const line = base_ + byteOffset(ref);
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
        WideRef nearest;
        if constexpr (Q == Query::Any) {
            storeChosen(hit, child, refs + top);
            nearest = child[(static_cast<int>(std::bit_width(hit)) - 1) & (W - 1)]; // 0: any
        } else {
            nearest = pushSorted(hit, entry, child, refs + top, entries_ + slot * stride_ + top);
        }
        // Without a child, what was on top before.
        const WideRef before = refs[top - 1];
        const WideRef next = hit != 0 ? nearest : before;
        b.stackTop[i] = top + static_cast<std::uint32_t>(std::popcount(hit)) - 1;
        b.at[i] = next;
        send(slot, next, to);
    }

    // The farthest child first. Up to four, 97 to 99 of 100 steps, by a sorting network. Returns
    // the nearest.
    static WideRef pushSorted(unsigned hit, Floats entry, const WideRef* child, WideRef* refs,
                              std::uint32_t* entries) {
        const auto keys = keysOf(hit, entry);
        if (std::popcount(hit) > 4) [[unlikely]] {
            alignas(64) std::uint32_t sorted[W];
            storeKeys(keys, sorted);
            const int n = std::popcount(hit);
            for (int a = 1; a < n; ++a) {
                const std::uint32_t key = sorted[a];
                int place = a;
                for (; place > 0 && sorted[place - 1] < key; --place)
                    sorted[place] = sorted[place - 1];
                sorted[place] = key;
            }
            for (int a = 0; a < n; ++a) entries[a] = sorted[a], refs[a] = child[sorted[a] & 15];
            return refs[n - 1];
        }
        __m128i k = firstFour(keys);
        const auto exchange = [](__m128i x, __m128i y, auto lower) {
            return _mm_castps_si128(_mm_blend_ps(_mm_castsi128_ps(_mm_max_epu32(x, y)),
                                                 _mm_castsi128_ps(_mm_min_epu32(x, y)),
                                                 decltype(lower)::value));
        };
        k = exchange(k, _mm_shuffle_epi32(k, _MM_SHUFFLE(1, 0, 3, 2)),
                     std::integral_constant<int, 12>());
        k = exchange(k, _mm_shuffle_epi32(k, _MM_SHUFFLE(2, 3, 0, 1)),
                     std::integral_constant<int, 10>());
        const __m128i middle = exchange(k, _mm_shuffle_epi32(k, _MM_SHUFFLE(3, 1, 2, 0)),
                                        std::integral_constant<int, 4>());
        k = _mm_blend_epi16(k, middle, 0x3c);
        _mm_storeu_si128(reinterpret_cast<__m128i*>(entries), k);
        const __m128i sorted = pick(k, child);
        _mm_storeu_si128(reinterpret_cast<__m128i*>(refs), sorted);
        return element(sorted, std::popcount(hit) - 1);
    }

    [[gnu::always_inline]] void leafStep(std::uint32_t slot, Lists& to) {
        RayBlock& b = blocks_[slot / W];
        const std::uint32_t i = slot % W;
        const unsigned candidates = leafCandidates(b, i);
        std::uint32_t* const refs = refs_ + slot * stride_;
        if (candidates != 0) [[unlikely]]
            test(b, i, slot, candidates);
        const std::uint32_t top = b.stackTop[i] - 1;
        b.stackTop[i] = top;
        b.at[i] = refs[top];
        send(slot, refs[top], to);
    }

    // Triangles of the leaf that may be better than what the ray has. ShearedTriangle of
    // accel/triangle.h for W triangles: edge functions with the same bits, then whether depth T/det
    // is certain to be out of range. Error of T and of the exact plane's, times |det|: with b the
    // size of the triangle across the ray and M its depth, below 68 u b (M + 2b)^2, u = 2^-24: 36
    // for the arithmetic here, 24 for corners that are rounded to float relative to the ray, 8 for
    // its rounded slopes.
    unsigned leafCandidates(const RayBlock& b, std::uint32_t i) const {
        const std::byte* const p = base_ + byteOffset(b.at[i]);
        const auto& leaf = *reinterpret_cast<const WideLeaf<W>*>(p);
        const Floats x = Floats::load(p + b.axis[0][i]) - Floats(b.origin[0][i]);
        const Floats y = Floats::load(p + b.axis[1][i]) - Floats(b.origin[1][i]);
        const Floats z = Floats::load(p + b.axis[2][i]) - Floats(b.origin[2][i]);
        const Floats xs = x - Floats(b.shearX[i]) * z, ys = y - Floats(b.shearY[i]) * z;
        const Ints i0 = Ints::bytes(leaf.corner[0]), i1 = Ints::bytes(leaf.corner[1]),
                   i2 = Ints::bytes(leaf.corner[2]);
        const Floats x0 = permute(xs, i0), x1 = permute(xs, i1), x2 = permute(xs, i2);
        const Floats y0 = permute(ys, i0), y1 = permute(ys, i1), y2 = permute(ys, i2);
        const Floats z0 = permute(z, i0), z1 = permute(z, i1), z2 = permute(z, i2);
        const Floats U = x2 * y1 - y2 * x1, V = x0 * y2 - y0 * x2, R = x1 * y0 - y1 * x0;
        const Floats zero(0.0f);
        const Mask inside =
            (zero <= min(min(U, V), R)) | (max(max(U, V), R) <= zero); // NaN never passes later
        const Floats det = (U + V) + R, T = (U * z0 + V * z1) + R * z2;
        const Floats depth = flipSign(flipSign(T, det), Floats(b.sign[i]));
        const float size = 2 * std::bit_cast<float>(static_cast<std::uint32_t>(leaf.reach) << 16) +
                           b.lateralError[i];
        const Floats m = max(max(abs(z0), abs(z1)), abs(z2)) + Floats(2 * size);
        const Floats noise = (Floats(68 * 0x1p-24f * size) * m) * m;
        const Floats limit = Floats(b.zCut[i] * 1.000001f) * abs(det) + noise;
        const Mask wanted = notGreater(depth, limit) & notGreater(zero - noise, depth);
        return bits(inside & wanted) & ((1u << leaf.count) - 1);
    }

    [[gnu::noinline]] void test(RayBlock& b, std::uint32_t i, std::uint32_t slot,
                                unsigned candidates) {
        const auto& leaf = *reinterpret_cast<const WideLeaf<W>*>(base_ + byteOffset(b.at[i]));
        const Vec3 org = rays_.org[b.ray[i]], dir = rays_.dir[b.ray[i]];
        RayBest best{b.key[i], b.below[i], b.triangle[i]};
        if constexpr (Q == Query::Any) {
            if (!hits(mesh_, org, dir, leaf, candidates, best)) return;
            b.triangle[i] = 0;
            b.stackTop[i] = 1;
        } else {
            if (!improve(mesh_, org, dir, leaf, candidates, best)) return;
            b.key[i] = best.key;
            b.triangle[i] = best.triangle;
            b.bestLeaf[i] = b.at[i], b.bestLane[i] = best.lane;
            b.zCut[i] = ::min(depthCut(best.key), b.zCut[i]);
            dropHidden(slot, b, i);
        }
    }

    // Takes out of the stack what starts behind the best hit, so that no pop has to look.
    void dropHidden(std::uint32_t slot, RayBlock& b, std::uint32_t i) {
        std::uint32_t* const refs = refs_ + slot * stride_;
        std::uint32_t* const entries = entries_ + slot * stride_;
        const auto cut = std::bit_cast<std::uint32_t>(b.zCut[i]);
        std::uint32_t kept = 0;
        for (std::uint32_t k = 0; k < b.stackTop[i]; ++k) {
            refs[kept] = refs[k], entries[kept] = entries[k];
            kept += (entries[k] & ~15u) <= cut;
        }
        b.stackTop[i] = kept;
    }

    const WideMesh& mesh_;
    const RaySpan& rays_;
    std::span<const std::uint32_t> order_;
    const std::byte* base_;
    std::size_t stride_, next_ = 0;
    RayBlock* blocks_;
    std::uint32_t *refs_, *entries_; // a stack per slot; entries only for nearest hits
    std::uint32_t live_ = 0;
    // One place more than rays: send() writes to lists that are full.
    std::uint32_t lists_[5][kSlots + 1];
};

void closest(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order,
             const HitLists& hits) {
    Queue<Query::Closest>(mesh, rays, order).run(hits);
}
void any(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order,
         std::uint8_t* hidden) {
    Queue<Query::Any>(mesh, rays, order).run(hidden);
}
