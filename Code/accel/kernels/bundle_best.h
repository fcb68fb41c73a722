// The best hits of a bundle's rays so far. As long as bounds of the keys tell which of two hits is
// nearer, neither key is computed: for fine meshes that is nearly always, and one key per ray is
// enough, at its end.
#pragma once

#include "accel/kernels/chord.h"
#include "accel/kernels/bundle_keys.h"
#include "accel/kernels/bundle_rays.h"
#include "accel/kernels/kernels.h"
#include "accel/kernels/queue_rays.h"
#include "simd/vectors3.h"
#include "accel/kernels/wide_tree.h"
#include "base/math.h"
#include "simd/lanes.h"

#include <bit>
#include <cstddef>
#include <cstdint>

LANES_BEGIN

template <Query Q> class BundleBest {
public:
    BundleBest(const WideMesh& mesh, const BundleRays<Q>& rays, const BundleKeys<Q>& keys)
        : mesh_(mesh), rays_(rays), keys_(keys) {}

    // Behind BundleRays::nextRound().
    void start() {
        open_ = static_cast<std::uint32_t>((std::uint64_t{1} << rays_.packets) - 1);
        zTop_ = 0;
        unmet_ = 0;
        for (int q = 0; q < rays_.packets; ++q) {
            if constexpr (Q == Query::Any) {
                missing_[q] = rays_.active[q];
            } else {
                const Floats none =
                    select(maskOf(rays_.active[q]), Floats(0.0f), Floats(kInfinityF));
                none.store(keyLo_[q]), none.store(keyHi_[q]);
                Ints(kNowhere).store(place_[q]);
            }
            zTop_ = ::max(rays_.zFar[q], zTop_);
        }
    }

    // Packets that still ask, a bit each.
    std::uint32_t open() const { return open_; }
    // Rays of a packet that do.
    unsigned asking(unsigned q) const { return Q == Query::Any ? missing_[q] : rays_.active[q]; }
    // Bounds of the key of the best hit, which are equal when it is known, or of the ray's end.
    Floats keyLo(unsigned q) const {
        return Floats::load(Q == Query::Any ? rays_.aboveLo[q] : keyLo_[q]);
    }
    Floats keyHi(unsigned q) const {
        return Floats::load(Q == Query::Any ? rays_.aboveHi[q] : keyHi_[q]);
    }

    [[gnu::always_inline]] void accept(unsigned q, std::uint32_t place, Mask lanes, Floats keyLo,
                                       Floats keyHi) {
        if constexpr (Q == Query::Any) {
            missing_[q] &= ~bits(lanes);
        } else {
            select(lanes, keyLo, Floats::load(keyLo_[q])).store(keyLo_[q]);
            select(lanes, keyHi, Floats::load(keyHi_[q])).store(keyHi_[q]);
            select(lanes, Ints(place), Ints::load(place_[q])).store(place_[q]);
        }
    }

    // Those of the lanes for which the triangle is in front of the best one by its number.
    unsigned lowerIds(unsigned q, std::uint32_t place, unsigned lanes) const {
        unsigned lower = 0;
        const std::uint32_t id = keys_.triangleAt(place);
        for (; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            if (place_[q][i] != kNowhere && id < keys_.triangleAt(place_[q][i])) lower |= 1u << i;
        }
        return lower;
    }

    // Computes the keys of these hits where they were left open.
    void settle(unsigned q, unsigned lanes) { settle(q, lanes, winnersOf(q, lanes)); }

    void closePackets() {
        for (std::uint32_t left = open_; left != 0; left &= left - 1) {
            const int packet = std::countr_zero(left);
            if (missing_[packet] == 0) open_ &= ~(1u << packet);
        }
    }

    // Nothing behind this depth can be better for any ray; below 0: all rays are done.
    float depthLimit() {
        if constexpr (Q == Query::Any) {
            float limit = -1;
            for (std::uint32_t left = open_; left != 0; left &= left - 1)
                limit = ::max(rays_.zFar[std::countr_zero(left)], limit);
            return limit;
        } else {
            // Nothing is hidden as long as a ray has met nothing.
            const auto met = [&](int q) {
                return bits(Floats::load(keyLo_[q]) <= Floats(0.0f)) == 0;
            };
            while (unmet_ < rays_.packets && met(unmet_)) ++unmet_;
            if (unmet_ < rays_.packets) return zTop_;
            Floats least = Floats::load(keyLo_[0]);
            for (int q = 1; q < rays_.packets; ++q) least = min(least, Floats::load(keyLo_[q]));
            return ::min(depthCut(smallest(least)), zTop_);
        }
    }

    void write(const HitLists& hits) {
        const Ints none(TriangleHit::kNone), noShape(Hit::kNoShape);
        const Floats zero(0.0f), never(kInfinityF);
        for (int q = 0; q < rays_.packets; ++q) {
            const Floats tMax = Floats::load(rays_.tMax[q]);
            const unsigned found = bits(Ints::load(place_[q]) < Ints(kNowhere)) & rays_.active[q];
            if (found == 0) {
                if (hits.whole != nullptr)
                    rays_.write(q, tMax, Weights{zero, zero}, Ints(0u), noShape, hits.whole);
                else
                    rays_.write(q, never, none, hits.brief);
                continue;
            }
            const Winners winners = winnersOf(static_cast<unsigned>(q), found);
            settle(static_cast<unsigned>(q), found, winners);
            const Floats t =
                Floats(1.0f) / (Floats::load(keyLo_[q]) * rays_.depth(static_cast<unsigned>(q)));
            const Mask hit = maskOf(found) & (t <= tMax);
            if (hits.whole != nullptr) {
                const Weights w = weightsOf(winners, static_cast<unsigned>(q));
                rays_.write(q, select(hit, t, tMax),
                            Weights{select(hit, w.u, zero), select(hit, w.v, zero)},
                            select(hit, winners.id, Ints(0u)),
                            select(hit, Ints(hits.shape), noShape), hits.whole);
            } else {
                rays_.write(q, select(hit, t, never), select(hit, winners.id, none), hits.brief);
            }
        }
    }
    void write(std::uint8_t* hidden) const {
        for (int q = 0; q < rays_.packets; ++q) rays_.write(q, ~missing_[q], hidden);
    }

private:
    static constexpr int kPackets = BundleRays<Q>::kPackets;
    static constexpr std::uint32_t kNowhere = BundleKeys<Q>::kNowhere;

    // The triangles of the best hits of a packet, lane by lane; zeros for the others.
    struct Winners {
        Floats point[3][3]; // corner, axis
        Ints id{0u};
    };
    // Neighbours mostly meet the same few triangles: each is fetched once.
    [[gnu::always_inline]] Winners winnersOf(unsigned q, unsigned lanes) const {
        Winners w;
        for (auto& corner : w.point)
            for (Floats& p : corner) p = Floats(0.0f);
        const Ints places = Ints::load(place_[q]);
        while (lanes != 0) {
            const std::uint32_t place = place_[q][std::countr_zero(lanes)];
            const Mask same = places == Ints(place);
            lanes &= ~bits(same);
            const WideLeaf<W>& l = keys_.leafOf(place);
            const unsigned j = keys_.laneOf(place);
            w.id = select(same, Ints(mesh_.tree.triangleIds[l.first + j]), w.id);
            for (std::size_t c = 0; c < 3; ++c)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    w.point[c][axis] =
                        select(same, Floats(l.point[axis][l.corner[c][j]]), w.point[c][axis]);
        }
        return w;
    }

    [[gnu::noinline]] void settle(unsigned q, unsigned lanes, const Winners& winners) {
        const Floats lo = Floats::load(keyLo_[q]), hi = Floats::load(keyHi_[q]);
        const unsigned open = bits(lo < hi) & lanes;
        if (open == 0) return;
        const BundlePlanes p =
            keys_.planesOf([&](int i, std::size_t axis) { return winners.point[i][axis]; });
        Mask inside = maskOf(open);
        const Floats key = keys_.keysOf(p, Ints::load(place_[q]), q, inside);
        select(maskOf(open), key, lo).store(keyLo_[q]);
        select(maskOf(open), key, hi).store(keyHi_[q]);
    }

    Weights weightsOf(const Winners& winners, unsigned q) const {
        Floats x[3], y[3];
        for (int i = 0; i < 3; ++i) {
            const auto relative = [&](std::size_t axis) {
                return winners.point[i][axis] - Floats(rays_.origin[axis]);
            };
            const Floats z = relative(rays_.k) * Floats(rays_.sign);
            x[i] = relative(rays_.kx) - Floats::load(rays_.Sx[q]) * z;
            y[i] = relative(rays_.ky) - Floats::load(rays_.Sy[q]) * z;
        }
        return barycentrics(x, y);
    }

    const WideMesh& mesh_;
    const BundleRays<Q>& rays_;
    const BundleKeys<Q>& keys_;
    float zTop_ = 0;
    std::uint32_t open_ = 0;
    int unmet_ = 0;              // the first packet with a ray that has met nothing
    unsigned missing_[kPackets]; // rays that are not hidden yet
    alignas(64) float keyLo_[kPackets][W], keyHi_[kPackets][W];
    std::uint32_t place_[kPackets][W]; // of the triangle
};

LANES_END
