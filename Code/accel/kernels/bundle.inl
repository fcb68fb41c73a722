// The kernel for rays from one point. Around the dominant axis of their directions such rays are
// points S = (x/z, y/z) of a plane, a bundle of them is a rectangle, and tracing it is rasterising
// a tile with the tree as its hierarchy of what is hidden: boxes and triangles are tested against
// the rectangle, W at a time, and a ray is touched only by triangles that overlap its packet.
// The tests in front of the canonical hit are exact or certain:
//   boxes: if one is beside the rectangle, the monotone rounding of x - S z gives all vertices in
//     it the same strict sign, and ShearedTriangle::containsRay() is false;
//   depth: a key is at most 1/zMin of its triangle, so a box behind zCut holds no better one;
//   edges: as affine functions of S, with a bound of their and the canonical ones' rounding; where
//     the sign is not certain, the canonical edge functions decide.
// Included like queue.inl, behind it.

template <Query Q> class Bundle {
public:
    Bundle(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order)
        : mesh_(mesh), rays_(rays), order_(order), origin_(rays.org[order[0]]),
          pad_(::max(mesh.extent, maxAbs(origin_)) * 0x1p-21f) {}

    template <class Result> void run(Result* results) {
        std::size_t size = kMostRays, first = 0;
        while (first < order_.size()) {
            const auto list = order_.subspan(first, std::min(size, order_.size() - first));
            leaves_ = 0;
            mostLeaves_ = list.size() + list.size() / 4 + 16;
            trace(list, results);
            first += list.size();
            if (!postponed_.empty() && size == kFewRays) break;
            // Large bundles of fine triangles touch too many of them: the size follows what the
            // last one met. No answer depends on it.
            if (leaves_ > kManyLeaves) size = kFewRays;
            if (leaves_ < kManyLeaves / 3) size = kMostRays;
        }
        if (postponed_.empty()) return;
        postponed_.insert(postponed_.end(), order_.begin() + static_cast<std::ptrdiff_t>(first),
                          order_.end());
        if constexpr (Q == Query::Any)
            any(mesh_, rays_, postponed_, results);
        else
            closest(mesh_, rays_, postponed_, results);
    }

private:
    static constexpr std::size_t kMostRays = 256, kFewRays = 64;
    static constexpr int kPackets = kMostRays / W;
    static constexpr std::size_t kManyLeaves = 40;
    static constexpr float kUnit = 0x1p-24f; // of rounding

    struct Range {
        float lo, hi;
        bool isEmpty() const { return lo > hi; }
    };
    static Range rangeOf(Floats x, Mask active) {
        return {smallest(select(active, x, Floats(kInfinityF))),
                largest(select(active, x, Floats(-kInfinityF)))};
    }

    // ---- bundles of the rays whose directions have the same dominant axis and sign

    template <class Result> void trace(std::span<const std::uint32_t> list, Result* results) {
        const int packets = (static_cast<int>(list.size()) + W - 1) / W;
        inARow_ = list.back() - list.front() + 1 == list.size(); // lists are in ascending order
        unsigned left[kPackets];
        for (int p = 0; p < packets; ++p) left[p] = loadDirections(list, p);
        for (int p = 0; p < packets; ++p) {
            while (left[p] != 0) {
                chooseAxis(p, std::countr_zero(left[p]));
                unsigned active[kPackets];
                for (int q = 0; q < packets; ++q) active[q] = left[q] & slopes(q);
                if constexpr (Q == Query::Any) cutGaps(packets, active);
                setUp(list, packets, active);
                const bool done = traverse();
                for (int q = 0; q < packets; ++q) left[q] &= ~active[q];
                for (int q = 0; q < packets_; ++q)
                    done ? write(list, packet_[q], q, results) : postpone(list, packet_[q], q);
            }
        }
        for (int p = 0; p < packets; ++p) { // what isTraceable() refuses
            const std::size_t first = static_cast<std::size_t>(p) * W;
            const std::size_t rays = std::min<std::size_t>(W, list.size() - first);
            unsigned refused = ~traceable_[p] & ((1u << rays) - 1);
            for (; refused != 0; refused &= refused - 1)
                results[list[first + static_cast<std::size_t>(std::countr_zero(refused))]] =
                    Result();
        }
    }

    // Is every lane of the packet a ray, and do they follow each other in the batch?
    bool isFull(std::span<const std::uint32_t> list, int p) const {
        return inARow_ && static_cast<std::size_t>(p + 1) * W <= list.size();
    }

    // Returns the lanes that hold a ray that isTraceable().
    unsigned loadDirections(std::span<const std::uint32_t> list, int p) {
        const auto first = static_cast<std::size_t>(p) * W;
        Floats x, y, z;
        if (isFull(list, p)) {
            const std::uint32_t ray = list[first];
            if (ray + kMostRays + W <= rays_.size()) { // for the next bundle, probably
                const float* const next = &rays_.dir[ray + kMostRays].x;
                for (int k = 0; k < 3 * W; k += 16) __builtin_prefetch(next + k);
                __builtin_prefetch(&rays_.tMin[ray + kMostRays]);
                __builtin_prefetch(&rays_.tMax[ray + kMostRays]);
            }
            loadVectors(&rays_.dir[ray].x, x, y, z);
            x.store(dir_[0][p]), y.store(dir_[1][p]), z.store(dir_[2][p]);
        } else {
            for (std::size_t i = 0; i < W; ++i) {
                const Vec3 d = first + i < list.size() ? rays_.dir[list[first + i]] : Vec3{};
                dir_[0][p][i] = d.x, dir_[1][p][i] = d.y, dir_[2][p][i] = d.z;
            }
            x = Floats::load(dir_[0][p]), y = Floats::load(dir_[1][p]);
            z = Floats::load(dir_[2][p]);
        }
        const Floats sum = ((x + y) + z) + Floats((origin_.x + origin_.y) + origin_.z);
        const Floats size = max(max(abs(x), abs(y)), abs(z));
        const Mask good =
            (size > Floats(1e-30f)) & (size < Floats(1e30f)) & (sum - sum == Floats(0.0f));
        traceable_[p] = maxAbs(origin_) < 1e30f ? bits(good) : 0;
        return traceable_[p];
    }

    void chooseAxis(int p, int lane) {
        const RaySetup ray(origin_, {dir_[0][p][lane], dir_[1][p][lane], dir_[2][p][lane]},
                           mesh_.extent);
        k_ = ray.k, kx_ = ray.kx, ky_ = ray.ky, sign_ = ray.sign;
    }

    // Computes the slopes of a packet; returns the lanes of the chosen axis and sign.
    unsigned slopes(int p) {
        const Floats d = Floats::load(dir_[k_][p]), x = Floats::load(dir_[kx_][p]),
                     y = Floats::load(dir_[ky_][p]);
        const Floats z = abs(d);
        const Mask beatsX = kx_ < k_ ? z >= abs(x) : z > abs(x); // equal ones: z, then y, then x
        const Mask beatsY = ky_ < k_ ? z >= abs(y) : z > abs(y);
        const unsigned negative = bits(d < Floats(0.0f));
        (x / z).store(rawX_[p]);
        (y / z).store(rawY_[p]);
        z.store(rawZ_[p]);
        return bits(beatsX & beatsY) & (sign_ < 0 ? negative : ~negative);
    }

    // Shadow rays of a tile end on surfaces far apart: while nearly half of the rectangle is an
    // empty stretch, the rays on the far side of it wait for the next round.
    void cutGaps(int packets, unsigned* active) {
        constexpr float kGap = 0.45f;
        for (int round = 0; round < 6; ++round) {
            const auto gap = [&](const float(*raw)[W], float& middle) {
                Floats lo(kInfinityF), hi(-kInfinityF);
                for (int p = 0; p < packets; ++p) {
                    const Mask m = maskOf(active[p]);
                    const Floats s = Floats::load(raw[p]);
                    lo = min(lo, select(m, s, Floats(kInfinityF)));
                    hi = max(hi, select(m, s, Floats(-kInfinityF)));
                }
                const float first = smallest(lo), last = largest(hi);
                middle = 0.5f * (first + last);
                Floats below(-kInfinityF), above(kInfinityF);
                for (int p = 0; p < packets; ++p) {
                    const Mask m = maskOf(active[p]);
                    const Floats s = Floats::load(raw[p]);
                    const Mask upper = s > Floats(middle);
                    above = min(above, select(m & upper, s, Floats(kInfinityF)));
                    below = max(below, select(upper, below, select(m, s, below)));
                }
                const float width = smallest(above) - largest(below);
                return width < kInfinityF && width > kGap * (last - first) ? width : 0.0f;
            };
            float middleX = 0, middleY = 0;
            const float x = gap(rawX_, middleX), y = gap(rawY_, middleY);
            if (x == 0 && y == 0) return;
            const auto* raw = x > y ? rawX_ : rawY_;
            const float middle = x > y ? middleX : middleY;
            int first = 0;
            while (active[first] == 0) ++first;
            const bool keepUpper = raw[first][std::countr_zero(active[first])] > middle;
            for (int p = 0; p < packets; ++p) {
                const unsigned upper = bits(Floats::load(raw[p]) > Floats(middle));
                active[p] &= keepUpper ? upper : ~upper;
            }
        }
    }

    // Packets with the active lanes, their rectangles and that of the bundle.
    void setUp(std::span<const std::uint32_t> list, int packets, const unsigned* active) {
        packets_ = 0;
        zTop_ = 0;
        x_ = y_ = {kInfinityF, -kInfinityF};
        for (int p = 0; p < packets; ++p) {
            if (active[p] == 0) continue;
            const int q = packets_++;
            packet_[q] = p;
            active_[q] = active[p];
            const Mask on = maskOf(active[p]);
            const auto first = static_cast<std::size_t>(std::countr_zero(active[p]));
            Floats tMin, tMax;
            loadRanges(list, p, first, tMin, tMax);
            // The other lanes are copies of an active one that nothing is near enough for.
            const Floats sx = select(on, Floats::load(rawX_[p]), Floats(rawX_[p][first]));
            const Floats sy = select(on, Floats::load(rawY_[p]), Floats(rawY_[p][first]));
            const Floats dz = select(on, Floats::load(rawZ_[p]), Floats(rawZ_[p][first]));
            const Floats one(1.0f);
            // Keys that count are in (above, below), as t is in (tMin, tMax): KeyRange of
            // shape/mesh.cpp. For most rays without an end that is (0, infinity).
            Floats above(0.0f), below(kInfinityF);
            zFar_[q] = depthCut(0);
            if (bits((tMin == Floats(0.0f)) & (tMax == Floats(kInfinityF))) != (1u << W) - 1) {
                above = keyAbove(tMax, dz), below = keyBelow(tMin, dz);
                zFar_[q] = depthCut(smallest(above));
            }
            if (Q == Query::Any) mostAbove_[q] = largest(above), leastBelow_[q] = smallest(below);
            zTop_ = ::max(zFar_[q], zTop_);
            select(on, Q == Query::Any ? above : Floats(0.0f), Floats(kInfinityF)).store(key_[q]);
            below.store(below_[q]);
            sx.store(Sx_[q]), sy.store(Sy_[q]), dz.store(dz_[q]), tMax.store(tMax_[q]);
            Doubles(sx).store(SxExact_[q]), Doubles(sy).store(SyExact_[q]);
            Ints(TriangleHit::kNone).store(triangle_[q]);
            found_[q] = 0;
            xs_[q] = rangeOf(sx, on), ys_[q] = rangeOf(sy, on);
            x_ = {::min(xs_[q].lo, x_.lo), ::max(xs_[q].hi, x_.hi)};
            y_ = {::min(ys_[q].lo, y_.lo), ::max(ys_[q].hi, y_.hi)};
        }
        centreX_ = 0.5f * (x_.lo + x_.hi), centreY_ = 0.5f * (y_.lo + y_.hi);
        halfX_ = 0.5000001f * (x_.hi - x_.lo) + 1e-7f;
        halfY_ = 0.5000001f * (y_.hi - y_.lo) + 1e-7f;
        slopeSum_ =
            ::max(std::fabs(x_.lo), std::fabs(x_.hi)) + ::max(std::fabs(y_.lo), std::fabs(y_.hi));
        // What roughInverse() is off by at the rim of the rectangle, and a few roundings.
        const float rough = W == 16 ? 3e-4f : 2e-3f;
        const float padX = rough * halfX_ + 2e-6f, padY = rough * halfY_ + 2e-6f;
        const auto padded = [](Range r, float centre, float pad) {
            return Range{r.lo - centre - pad, r.hi - centre + pad};
        };
        for (int q = 0; q < packets_; ++q) {
            Rect& r = rect_[q];
            r.x = padded(xs_[q], centreX_, padX), r.y = padded(ys_[q], centreY_, padY);
            r.centreX = 0.5f * (xs_[q].lo + xs_[q].hi) - centreX_;
            r.centreY = 0.5f * (ys_[q].lo + ys_[q].hi) - centreY_;
            r.halfX = 0.5f * (xs_[q].hi - xs_[q].lo) * 1.00001f + 2e-6f;
            r.halfY = 0.5f * (ys_[q].hi - ys_[q].lo) * 1.00001f + 2e-6f;
            (Floats::load(Sx_[q]) - Floats(centreX_)).store(relX_[q]);
            (Floats::load(Sy_[q]) - Floats(centreY_)).store(relY_[q]);
        }
        all_.x = padded(x_, centreX_, padX), all_.y = padded(y_, centreY_, padY);
        limitDepth();
    }

    // Lanes without a ray get what the lane `spare` has.
    void loadRanges(std::span<const std::uint32_t> list, int p, std::size_t spare, Floats& tMin,
                    Floats& tMax) const {
        const std::size_t first = static_cast<std::size_t>(p) * W;
        if (isFull(list, p)) {
            tMin = Floats::unaligned(&rays_.tMin[list[first]]);
            tMax = Floats::unaligned(&rays_.tMax[list[first]]);
            return;
        }
        alignas(64) float lo[W], hi[W];
        for (std::size_t i = 0; i < W; ++i) {
            const std::uint32_t ray = list[first + i < list.size() ? first + i : first + spare];
            lo[i] = rays_.tMin[ray], hi[i] = rays_.tMax[ray];
        }
        tMin = Floats::load(lo), tMax = Floats::load(hi);
    }

    // Nothing behind zCut_ can be better for any ray; below 0: all rays are done.
    void limitDepth() {
        Floats least = Floats::load(key_[0]);
        for (int q = 1; q < packets_; ++q) least = min(least, Floats::load(key_[q]));
        const float key = smallest(least);
        zCut_ = key == kInfinityF ? -1 : ::min(depthCut(key), zTop_);
    }

    void write(std::span<const std::uint32_t> list, int p, int q, TriangleHit* hits) const {
        const Floats t = Floats(1.0f) / (Floats::load(key_[q]) * Floats::load(dz_[q]));
        const Floats tMax = Floats::load(tMax_[q]);
        const Ints none(TriangleHit::kNone), triangle = Ints::load(triangle_[q]);
        const Mask hit = (triangle < none) & (t <= tMax);
        const Floats tHit = select(hit, t, Floats(kInfinityF));
        const Ints triangleHit = select(hit, triangle, none);
        if (active_[q] == (1u << W) - 1 && isFull(list, p)) {
            storePairs(tHit, triangleHit, &hits[list[static_cast<std::size_t>(p) * W]].t);
            return;
        }
        alignas(64) float ts[W];
        alignas(64) std::uint32_t triangles[W];
        tHit.store(ts), triangleHit.store(triangles);
        for (unsigned lanes = active_[q]; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            hits[list[static_cast<std::size_t>(p) * W + static_cast<std::size_t>(i)]] = {
                ts[i], triangles[i]};
        }
    }
    void write(std::span<const std::uint32_t> list, int p, int q, std::uint8_t* hidden) const {
        for (unsigned lanes = active_[q]; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            hidden[list[static_cast<std::size_t>(p) * W + static_cast<std::size_t>(i)]] =
                found_[q] >> i & 1;
        }
    }

    // Rays from one point to places all over the scene are no bundle: the queue takes them.
    void postpone(std::span<const std::uint32_t> list, int p, int q) {
        for (unsigned lanes = active_[q]; lanes != 0; lanes &= lanes - 1)
            postponed_.push_back(list[static_cast<std::size_t>(p) * W +
                                      static_cast<std::size_t>(std::countr_zero(lanes))]);
    }

    // ---- the tree

    // False: given up, as the queue would have been faster by now.
    bool traverse() {
        struct Entry {
            float z;
            WideRef ref;
        };
        auto* const stack =
            reinterpret_cast<Entry*>(scratchMemory((mesh_.tree.stackSize + W) * sizeof(Entry)));
        std::uint32_t size = 0;
        WideRef at = mesh_.tree.root;
        while (zCut_ >= 0) {
            if (kindOf(at) == WideKind::Node) {
                const auto& node = mesh_.tree.at<WideNode<W>>(at);
                alignas(64) float z[W];
                const std::uint32_t before = size;
                for (unsigned hit = enteredChildren(node, z); hit != 0; hit &= hit - 1) {
                    const int i = std::countr_zero(hit);
                    prefetch(node.child[i]);
                    std::uint32_t place = size++; // the nearest on top
                    for (; place > before && stack[place - 1].z < z[i]; --place)
                        stack[place] = stack[place - 1];
                    stack[place] = {z[i], node.child[i]};
                }
            } else {
                if (leaves_ > mostLeaves_) return false;
                if (leaf(mesh_.tree.at<WideLeaf<W>>(at))) limitDepth();
            }
            do {
                if (size == 0) return true;
                --size;
            } while (stack[size].z > zCut_);
            at = stack[size].ref;
        }
        return true;
    }

    void prefetch(WideRef ref) const {
        const std::byte* const line = mesh_.tree.base() + byteOffset(ref);
        for (int k = 0; k < 4; ++k) __builtin_prefetch(line + std::ptrdiff_t{64} * k);
    }

    // Children that the rectangle's pyramid enters in front of zCut_, and their depths.
    unsigned enteredChildren(const WideNode<W>& node, float* entry) const {
        const Floats s(sign_), zero(0.0f), oz(origin_[k_]);
        const bool backwards = sign_ < 0;
        const Floats zNear = (Floats::load(node.plane[k_][backwards ? 1 : 0]) - oz) * s;
        const Floats zFar = (Floats::load(node.plane[k_][backwards ? 0 : 1]) - oz) * s;
        max(zNear, zero).store(entry);
        const Mask ahead = (zFar > zero) & (zNear <= Floats(zCut_));
        // Of S z with S in the range and z in the box, the extremes are at corners.
        if (bits(ahead & (zNear < zero)) != 0) [[unlikely]] {
            const auto meets = [&](std::size_t axis, Range S) {
                const Floats o(origin_[axis]), lo(S.lo), hi(S.hi);
                const Floats a = lo * zNear, b = lo * zFar, c = hi * zNear, d = hi * zFar;
                return ((Floats::load(node.plane[axis][0]) - o) <= max(max(a, b), max(c, d))) &
                       ((Floats::load(node.plane[axis][1]) - o) >= min(min(a, b), min(c, d)));
            };
            return bits(ahead & meets(kx_, x_) & meets(ky_, y_));
        }
        const auto meets = [&](std::size_t axis, Range S) {
            const Floats o(origin_[axis]), lo(S.lo), hi(S.hi);
            return ((Floats::load(node.plane[axis][0]) - o) <= hi * (S.hi > 0 ? zFar : zNear)) &
                   ((Floats::load(node.plane[axis][1]) - o) >= lo * (S.lo > 0 ? zNear : zFar));
        };
        return bits(ahead & meets(kx_, x_) & meets(ky_, y_));
    }

    // ---- triangles

    struct Corners {
        Floats x[3], y[3], z[3]; // ShearedTriangle::v
    };

    Corners cornersOf(const WideLeaf<W>& l) const {
        const auto relative = [&](std::size_t axis) {
            return Floats::load(l.point[axis]) - Floats(origin_[axis]);
        };
        const Floats x = relative(kx_), y = relative(ky_), z = relative(k_) * Floats(sign_);
        Corners c;
        for (int i = 0; i < 3; ++i) {
            const Ints at = Ints::bytes(l.corner[i]);
            c.x[i] = permute(x, at), c.y[i] = permute(y, at), c.z[i] = permute(z, at);
        }
        return c;
    }

    // Tests W triangles with all packets; true when a ray has got a better hit.
    bool leaf(const WideLeaf<W>& l) {
        ++leaves_;
        const Floats zero(0.0f);
        const Corners v = cornersOf(l);
        const Floats zMin = min(min(v.z[0], v.z[1]), v.z[2]);
        const Floats zMax = max(max(v.z[0], v.z[1]), v.z[2]);
        unsigned live = bits((zMax > zero) & (zMin <= Floats(zCut_))) & ((1u << l.count) - 1);
        const unsigned straddling = bits(zMin <= zero) & live;
        // Too near for a quotient that need not be infinite.
        const unsigned close = bits(zMin <= Floats(1e-30f)) & live;

        // Where the corners are seen from the origin, about the centre of the rectangle.
        Floats x[3], y[3], seenX[3], seenY[3];
        for (int i = 0; i < 3; ++i) {
            x[i] = fnma(Floats(centreX_), v.z[i], v.x[i]);
            y[i] = fnma(Floats(centreY_), v.z[i], v.y[i]);
            const Floats inverse = roughInverse(v.z[i]);
            seenX[i] = x[i] * inverse, seenY[i] = y[i] * inverse;
        }
        const Floats xLo = min(min(seenX[0], seenX[1]), seenX[2]);
        const Floats xHi = max(max(seenX[0], seenX[1]), seenX[2]);
        const Floats yLo = min(min(seenY[0], seenY[1]), seenY[2]);
        const Floats yHi = max(max(seenY[0], seenY[1]), seenY[2]);
        const auto overlap = [&](const Rect& r) {
            return close | bits((xLo <= Floats(r.x.hi)) & (xHi >= Floats(r.x.lo)) &
                                (yLo <= Floats(r.y.hi)) & (yHi >= Floats(r.y.lo)));
        };
        live &= overlap(all_);
        if (live == 0) return false;

        Block& b = block_;
        const unsigned uncertain = edgeFunctions(v, x, y, zMin, zMax, b) & live;
        unsigned wanted[kPackets], any = 0;
        for (int q = 0; q < packets_; ++q) {
            wanted[q] = 0;
            if (Q == Query::Any && (active_[q] & ~found_[q]) == 0) continue;
            wanted[q] = live & overlap(rect_[q]);
            if constexpr (Q == Query::Any) {
                wanted[q] &= bits(zMin <= Floats(zFar_[q]));
            }
            if (wanted[q] == 0) continue;
            wanted[q] &= uncertain | mayContain(b, rect_[q]);
            any |= wanted[q];
        }
        if (any == 0) return false;

        b.leaf = &l;
        b.straddling = straddling;
        b.corners = &v;
        b.hasPlanes = false;
        const Floats one(1.0f);
        (one / zMax).store(b.keyLo);
        select(zMin > zero, one / zMin, Floats(kInfinityF)).store(b.keyHi);
        bool better = false;
        for (int q = 0; q < packets_; ++q)
            if (wanted[q] != 0) better |= testPacket(b, q, wanted[q], uncertain);
        return better;
    }

    struct Rect {
        Range x, y; // padded, about the bundle's centre
        float centreX, centreY, halfX, halfY;
    };

    // What the rays need of the W triangles of a leaf, one column per triangle.
    struct alignas(64) Block {
        float edge[3][3][W]; // edge e at S: edge[e][0] + x edge[e][1] + y edge[e][2]
        float noise[W];      // the sign of an edge is certain beyond this
        float keyLo[W], keyHi[W];
        double nx[W], ny[W], nz[W], n0[W];    // normal, and its product with a corner
        float xLo[W], xHi[W], yLo[W], yHi[W]; // of the triangle's box, padded
        const WideLeaf<W>* leaf;
        const Corners* corners;
        bool hasPlanes; // nx to yHi are filled
        unsigned straddling;
    };

    // Edge functions as affine functions of S - centre, turned so that inside is positive. Returns
    // the triangles whose side can't be told: seen from their edge.
    // noise: Woop's vertices differ from exact ones by u (|S| z + 3 R) each, R the size of the
    // triangle about the rectangle, which moves an edge by u R (2 z |S| + 12 R); evaluation of the
    // affine form adds 27 u R^2 at most, without FMA.
    unsigned edgeFunctions(const Corners& v, const Floats* x, const Floats* y, Floats zMin,
                           Floats zMax, Block& b) const {
        const Floats zero(0.0f);
        const Floats zSize = max(zMax, zero - zMin);
        Floats reach = zSize, size(0.0f);
        for (int i = 0; i < 3; ++i) {
            reach = max(reach, max(abs(v.x[i]), abs(v.y[i])));
            size = max(size, max(abs(x[i]), abs(y[i])));
        }
        size = fma(zSize, Floats(::max(halfX_, halfY_)), size);
        const Floats noise =
            size * fma(zSize, Floats(2.2f * kUnit * slopeSum_), size * Floats(44 * kUnit));
        noise.store(b.noise);

        const Floats e1x = v.x[1] - v.x[0], e1y = v.y[1] - v.y[0], e1z = v.z[1] - v.z[0];
        const Floats e2x = v.x[2] - v.x[0], e2y = v.y[2] - v.y[0], e2z = v.z[2] - v.z[0];
        const Floats nx = e1y * e2z - e1z * e2y, ny = e1z * e2x - e1x * e2z,
                     nz = e1x * e2y - e1y * e2x;
        const Floats side = (nx * v.x[0] + ny * v.y[0]) + nz * v.z[0];
        const Floats longest =
            max(max(max(abs(e1x), abs(e1y)), max(abs(e1z), abs(e2x))), max(abs(e2y), abs(e2z)));
        const Floats turn = zero - side;
        for (int e = 0; e < 3; ++e) {
            const int i = (e + 1) % 3, k = (e + 2) % 3;
            flipSign(fms(x[k], y[i], y[k] * x[i]), turn).store(b.edge[e][0]);
            flipSign(fms(y[k], v.z[i], y[i] * v.z[k]), turn).store(b.edge[e][1]);
            flipSign(fms(x[i], v.z[k], x[k] * v.z[i]), turn).store(b.edge[e][2]);
        }
        const Floats bound = longest * longest * reach * Floats(48 * kUnit);
        return bits(notGreater(abs(side), bound));
    }

    // Triangles of whose edges none has the whole packet outside.
    unsigned mayContain(const Block& b, const Rect& r) const {
        Floats least(kInfinityF);
        for (int e = 0; e < 3; ++e) {
            const Floats a = Floats::load(b.edge[e][1]), c = Floats::load(b.edge[e][2]);
            const Floats most =
                fma(Floats(r.centreX), a,
                    fma(Floats(r.centreY), c,
                        fma(Floats(r.halfX), abs(a),
                            fma(Floats(r.halfY), abs(c), Floats::load(b.edge[e][0])))));
            least = min(most, least);
        }
        return bits(notGreater(Floats(0.0f) - Floats::load(b.noise), least));
    }

    // planeKey() of accel/triangle.h up to the ray, and the bounds of canonicalKey(). The padded
    // box is a quarter of the canonical pad wide of the triangle: a key that is inside it on both
    // lateral axes is not changed by the canonical clamp.
    [[gnu::noinline]] void planes(Block& b) const {
        const Corners& v = *b.corners;
        b.hasPlanes = true;
        const auto relative = [&](int corner, std::size_t axis) { // in double, as planeKey() has it
            const Floats point =
                permute(Floats::load(b.leaf->point[axis]), Ints::bytes(b.leaf->corner[corner]));
            return Doubles(point) - Doubles(static_cast<double>(origin_[axis]));
        };
        const Doubles sign(static_cast<double>(sign_));
        const Doubles x0 = relative(0, kx_), y0 = relative(0, ky_), z0 = relative(0, k_) * sign;
        const Doubles ax = relative(1, kx_) - x0, ay = relative(1, ky_) - y0,
                      az = relative(1, k_) * sign - z0;
        const Doubles bx = relative(2, kx_) - x0, by = relative(2, ky_) - y0,
                      bz = relative(2, k_) * sign - z0;
        const Doubles nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * bx;
        nx.store(b.nx), ny.store(b.ny), nz.store(b.nz);
        (nx * x0 + ny * y0 + nz * z0).store(b.n0);
        const Floats pad(pad_);
        (min(min(v.x[0], v.x[1]), v.x[2]) - pad).store(b.xLo);
        (max(max(v.x[0], v.x[1]), v.x[2]) + pad).store(b.xHi);
        (min(min(v.y[0], v.y[1]), v.y[2]) - pad).store(b.yLo);
        (max(max(v.y[0], v.y[1]), v.y[2]) + pad).store(b.yHi);
    }

    [[gnu::always_inline]] bool testPacket(Block& b, int q, unsigned wanted, unsigned uncertain) {
        const Floats x = Floats::load(relX_[q]), y = Floats::load(relY_[q]);
        bool better = false;
        for (; wanted != 0; wanted &= wanted - 1) {
            const int j = std::countr_zero(wanted);
            Mask inside = maskOf(active_[q]);
            bool ask = uncertain >> j & 1;
            if (!ask) [[likely]] {
                const auto edge = [&](int e) {
                    return fma(x, Floats(b.edge[e][1][j]),
                               fma(y, Floats(b.edge[e][2][j]), Floats(b.edge[e][0][j])));
                };
                const Floats least = min(min(edge(0), edge(1)), edge(2));
                const float noise = b.noise[j];
                inside = least >= Floats(-noise);
                ask = (bits(inside) & bits(least <= Floats(noise)) & active_[q]) != 0;
            }
            if (ask) [[unlikely]]
                inside = containsRays(b, q, j);
            if constexpr (Q == Query::Any) {
                if (isInFront(b, q, j)) {
                    hide(q, inside);
                    better |= bits(inside) != 0;
                    continue;
                }
            }
            better |= accept(b, q, j, inside);
        }
        return better;
    }

    // ShearedTriangle::containsRay() for the rays of a packet; what it has to decide in double is
    // asked ray by ray.
    [[gnu::noinline]] Mask containsRays(const Block& b, int q, int j) const {
        const Floats Sx = Floats::load(Sx_[q]), Sy = Floats::load(Sy_[q]), zero(0.0f);
        Floats x[3], y[3];
        for (int i = 0; i < 3; ++i) {
            const auto at = [&](std::size_t axis) {
                return b.leaf->point[axis][b.leaf->corner[i][j]] - origin_[axis];
            };
            const Floats z(at(k_) * sign_);
            x[i] = Floats(at(kx_)) - Sx * z;
            y[i] = Floats(at(ky_)) - Sy * z;
        }
        const Floats U = x[2] * y[1] - y[2] * x[1], V = x[0] * y[2] - y[0] * x[2],
                     R = x[1] * y[0] - y[1] * x[0];
        const Mask positive = (U >= zero) & (V >= zero) & (R >= zero);
        const Mask negative = (U <= zero) & (V <= zero) & (R <= zero);
        unsigned inside = bits(positive | negative) & active_[q];
        unsigned zeros = inside & bits((U == zero) | (V == zero) | (R == zero));
        for (; zeros != 0; zeros &= zeros - 1) {
            const int i = std::countr_zero(zeros);
            if (exactKeyOf(b, q, j, i) == 0) inside &= ~(1u << i);
        }
        return maskOf(inside);
    }

    float exactKeyOf(const Block& b, int q, int j, int lane) const {
        const int p = packet_[q];
        return exactKey(mesh_, origin_, {dir_[0][p][lane], dir_[1][p][lane], dir_[2][p][lane]},
                        *b.leaf, static_cast<unsigned>(j));
    }
    std::uint32_t triangleId(const Block& b, int j) const {
        return mesh_.tree.triangleIds[b.leaf->first + static_cast<std::uint32_t>(j)];
    }

    // A ray that containsRay() meets the triangle, up to 4 units of rounding across, between its
    // least and its largest depth, and so in front of the exit of its padded box: its key is in
    // [1/zMax (1 - 4u), 1/zMin]. If all such keys count, the plane need not be known.
    bool isInFront(const Block& b, int q, int j) const {
        return (b.straddling >> j & 1) == 0 && b.keyLo[j] * 0.999999f > mostAbove_[q] &&
               b.keyHi[j] < leastBelow_[q];
    }
    void hide(int q, Mask lanes) {
        select(lanes, Floats(kInfinityF), Floats::load(key_[q])).store(key_[q]);
        found_[q] |= bits(lanes);
    }

    // canonicalKey() for the rays that are inside, and the better ones of them kept.
    [[gnu::always_inline]] bool accept(Block& b, int q, int j, Mask inside) {
        if (!b.hasPlanes) planes(b);
        const Doubles slope = Doubles(b.nx[j]) * Doubles::load(SxExact_[q]) +
                              Doubles(b.ny[j]) * Doubles::load(SyExact_[q]) + Doubles(b.nz[j]);
        const Floats plane = (slope / Doubles(b.n0[j])).toFloats();
        if (b.straddling >> j & 1) inside = inside & (plane > Floats(0.0f));
        Floats key = min(max(plane, Floats(b.keyLo[j])), Floats(b.keyHi[j]));

        const Floats best = Floats::load(key_[q]), Sx = Floats::load(Sx_[q]),
                     Sy = Floats::load(Sy_[q]), below = Floats::load(below_[q]);
        const Mask inBox = (Floats(b.xLo[j]) * key <= Sx) & (Sx <= Floats(b.xHi[j]) * key) &
                           (Floats(b.yLo[j]) * key <= Sy) & (Sy <= Floats(b.yHi[j]) * key);
        const unsigned clamped = bits(inside & (key >= best)) & ~bits(inBox) & active_[q];
        if (clamped != 0) [[unlikely]]
            key = clampedKeys(b, q, j, clamped, key);

        Mask better = inside & (key > best) & (key < below);
        if constexpr (Q == Query::Any) {
            hide(q, better);
            return bits(better) != 0;
        } else {
            const Ints id(triangleId(b, j)), bestId = Ints::load(triangle_[q]);
            const Mask equal = inside & (key == best) & (key < below);
            if (bits(equal) != 0) [[unlikely]]
                better = better | (equal & (id < bestId));
            select(better, key, best).store(key_[q]);
            select(better, id, bestId).store(triangle_[q]);
            return true;
        }
    }

    [[gnu::noinline]] Floats clampedKeys(const Block& b, int q, int j, unsigned lanes,
                                         Floats key) const {
        alignas(64) float keys[W];
        key.store(keys);
        for (; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            keys[i] = exactKeyOf(b, q, j, i);
        }
        return Floats::load(keys);
    }

    const WideMesh& mesh_;
    const RaySpan& rays_;
    std::span<const std::uint32_t> order_;
    Vec3 origin_;
    float pad_;
    std::size_t k_ = 2, kx_ = 0, ky_ = 1; // RaySetup's, of all active rays
    float sign_ = 1;
    std::size_t leaves_ = 0, mostLeaves_ = 0;
    std::vector<std::uint32_t> postponed_;

    alignas(64) float dir_[3][kPackets][W];
    float rawX_[kPackets][W], rawY_[kPackets][W], rawZ_[kPackets][W];
    unsigned traceable_[kPackets];
    bool inARow_ = false;

    // The packets that have active rays.
    int packets_ = 0, packet_[kPackets];
    unsigned active_[kPackets], found_[kPackets];
    float mostAbove_[kPackets], leastBelow_[kPackets]; // bounds of the keys that count
    float zFar_[kPackets];                             // behind it no ray of the packet asks
    alignas(64) float Sx_[kPackets][W], Sy_[kPackets][W], relX_[kPackets][W], relY_[kPackets][W];
    float dz_[kPackets][W], key_[kPackets][W], below_[kPackets][W], tMax_[kPackets][W];
    double SxExact_[kPackets][W], SyExact_[kPackets][W];
    std::uint32_t triangle_[kPackets][W];
    Range xs_[kPackets], ys_[kPackets], x_, y_;
    Rect rect_[kPackets], all_;
    float centreX_, centreY_, halfX_, halfY_, slopeSum_, zTop_, zCut_;
    Block block_;
};

void closestFromPoint(const WideMesh& mesh, const RaySpan& rays,
                      std::span<const std::uint32_t> order, TriangleHit* hits) {
    Bundle<Query::Closest>(mesh, rays, order).run(hits);
}
void anyFromPoint(const WideMesh& mesh, const RaySpan& rays, std::span<const std::uint32_t> order,
                  std::uint8_t* hidden) {
    Bundle<Query::Any>(mesh, rays, order).run(hidden);
}
