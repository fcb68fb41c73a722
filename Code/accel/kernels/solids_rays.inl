// W rays of a packet, set up for boxes and solids: what PacketHulls and those who build on it ask.
// Included by solids.inl.

enum class Answer { Closest, Any };

class PacketRays {
protected:
    PacketRays(const SolidTree& tree, const RaySpan& rays) : tree_(tree), rays_(rays) {}

    static constexpr unsigned kAll = (1u << W) - 1;
    // Fewer rays than this look at a node one by one.
    static constexpr int kFewestForInterval = 6;

    // RaySetup for W rays; the formulas are its own, lane by lane. Returns the lanes to be traced.
    template <Answer A, class Result>
    unsigned setUp(std::span<const std::uint32_t> order, const Result* results) {
        const std::size_t count = std::min<std::size_t>(W, order.size());
        for (std::size_t i = 0; i < W; ++i) ray_[i] = order[i < count ? i : 0];
        Floats o[3], d[3], tMax;
        if (const std::size_t first = ray_[0]; count == W && ray_[W - 1] == first + (W - 1)) {
            loadVectors(&rays_.org[first].x, o[0], o[1], o[2]);
            loadVectors(&rays_.dir[first].x, d[0], d[1], d[2]);
            tMin_ = Floats::unaligned(&rays_.tMin[first]);
            tMax = Floats::unaligned(&rays_.tMax[first]);
        } else {
            alignas(64) float org[3][W], dir[3][W], lo[W], hi[W];
            for (std::size_t i = 0; i < W; ++i) {
                const Vec3 from = rays_.org[ray_[i]], along = rays_.dir[ray_[i]];
                org[0][i] = from.x, org[1][i] = from.y, org[2][i] = from.z;
                dir[0][i] = along.x, dir[1][i] = along.y, dir[2][i] = along.z;
                lo[i] = rays_.tMin[ray_[i]], hi[i] = rays_.tMax[ray_[i]];
            }
            for (int axis = 0; axis < 3; ++axis)
                o[axis] = Floats::load(org[axis]), d[axis] = Floats::load(dir[axis]);
            tMin_ = Floats::load(lo), tMax = Floats::load(hi);
        }
        unsigned lanes = (1u << count) - 1;
        if constexpr (A == Answer::Any) {
            best_ = tMax;
        } else {
            alignas(64) float t[W];
            for (std::size_t i = 0; i < W; ++i) {
                const Hit& hit = results[ray_[i]];
                t[i] = hit.t, number_[i] = hit.shape;
            }
            best_ = Floats::load(t);
        }

        const Floats one(1.0f), zero(0.0f);
        const Floats ax = abs(d[0]), ay = abs(d[1]), az = abs(d[2]);
        const Mask alongZ = (az >= ax) & (az >= ay), alongY = ay >= ax;
        const auto pick = [&](Floats x, Floats y, Floats z) {
            return select(alongZ, z, select(alongY, y, x));
        };
        alongZ_ = alongZ, alongY_ = alongY;
        const Floats depth = pick(d[0], d[1], d[2]);
        dz_ = abs(depth);
        const Floats sign = select(depth < zero, Floats(-1.0f), one);
        const Floats Sx = pick(d[1], d[2], d[0]) / dz_, Sy = pick(d[2], d[0], d[1]) / dz_;
        sign_ = sign, Sx_ = Sx, Sy_ = Sy;
        const Floats smallestSlope(RaySetup::kSmallestSlope);
        const Floats rx = one / withSign(max(abs(Sx), smallestSlope), Sx);
        const Floats ry = one / withSign(max(abs(Sy), smallestSlope), Sy);
        const Floats oMax = max(max(abs(o[0]), abs(o[1])), abs(o[2]));
        const Floats e = max(Floats(tree_.extent), oMax) * Floats(0x1p-19f);
        const Floats px = e * abs(rx), py = e * abs(ry);
        const auto slab = [&](int axis, Floats r, Floats pad) {
            const Floats at = (zero - o[axis]) * r, twice = pad + pad;
            r_[axis] = r;
            near_[axis] = at - twice;
            far_[axis] = at + twice;
            pad_[axis] = twice;
            o_[axis] = o[axis];
            d_[axis] = d[axis];
        };
        slab(0, pick(sign, ry, rx), pick(e, py, px));
        slab(1, pick(rx, sign, ry), pick(px, e, py));
        slab(2, pick(ry, rx, sign), pick(py, px, e));
        zCut_ = cutOf(best_);
        const Floats length2 = fma(d[0], d[0], fma(d[1], d[1], d[2] * d[2]));
        length_ = sqrt(length2);
        perLength_ = one / length_;
        perLength2_ = one / length2;
        slack_ = max(Floats(tree_.extent), oMax) * Floats(0x1p-18f);
        oMax_ = oMax;

        // isTraceable(), and a range to be hit in.
        const Floats sum = ((d[0] + d[1]) + d[2]) + ((o[0] + o[1]) + o[2]);
        const Floats longest = max(max(ax, ay), az);
        lanes &= bits((longest > Floats(1e-30f)) & (longest < Floats(1e30f)) &
                      (oMax < Floats(1e30f)) & (sum - sum == zero) & (tMin_ < best_));
        if (lanes != 0) findInterval(lanes);
        return lanes;
    }

    // depthCut(1 / (t dz))
    Floats cutOf(Floats t) const {
        const Floats one(1.0f), zero(0.0f), key = one / (t * dz_);
        return select(key > zero, (one / key) * Floats(1.0000005f),
                      Floats(std::numeric_limits<float>::max()));
    }

    // The ranges of origins and r, for packets into one octant.
    void findInterval(unsigned lanes) {
        const Mask on = maskOf(lanes);

        together_ = std::popcount(lanes) >= kFewestForInterval;
        for (int axis = 0; axis < 3; ++axis) {
            r_[axis].store(rays1_.r[axis]);
            near_[axis].store(rays1_.nearOffset[axis]);
            far_[axis].store(rays1_.farOffset[axis]);
            const unsigned backwards = bits(r_[axis] < Floats(0.0f));
            backwards_[axis] = backwards;
            if (!together_) continue;
            together_ = (backwards & lanes) == 0 || (backwards & lanes) == lanes;
            oLo_[axis] = smallest(select(on, o_[axis], Floats(kInfinityF)));
            oHi_[axis] = largest(select(on, o_[axis], Floats(-kInfinityF)));
            rLo_[axis] = smallest(select(on, r_[axis], Floats(kInfinityF)));
            rHi_[axis] = largest(select(on, r_[axis], Floats(-kInfinityF)));
            mostPad_[axis] = largest(select(on, pad_[axis], Floats(0.0f)));
        }
        zCut_.store(rays1_.zCut);
        zTop_ = largest(select(on, zCut_, Floats(-1.0f)));
    }

    // Nothing behind these t counts any more.
    void limit(Floats best) {
        best_ = best;
        zCut_ = min(cutOf(best), zCut_);
        zCut_.store(rays1_.zCut);
        zTop_ = largest(select(maskOf(live_), zCut_, Floats(-1.0f)));
    }

    const SolidTree& tree_;
    const RaySpan& rays_;
    std::uint32_t ray_[W]; // of the lane
    unsigned live_ = 0;    // lanes that still ask
    Floats o_[3], d_[3], r_[3], near_[3], far_[3], pad_[3], dz_, tMin_;
    Floats length_, perLength_, perLength2_, slack_; // of the directions; see nearCentre()
    // What a facet asks: the dominant axis, and RaySetup's numbers for it.
    Mask alongZ_, alongY_;
    Floats sign_, Sx_, Sy_, oMax_;
    Floats best_, zCut_; // t up to which hits count, and the depth behind which none is
    std::uint32_t number_[W];
    unsigned backwards_[3]; // lanes with r < 0
    // The same by ray.
    struct alignas(64) {
        float r[3][W], nearOffset[3][W], farOffset[3][W], zCut[W];
    } rays1_;
    bool together_ = false;
    float oLo_[3], oHi_[3], rLo_[3], rHi_[3], mostPad_[3], zTop_ = 0;
};
