// Solids that few rays of a packet come near at a time: pairs of a ray and a solid wait until there
// are W of them and pass the filters together; those left wait for others of their formula and are
// met together. What a ray hits for certain, though not yet where exactly, hides what lies behind.
// The order of the tests changes nothing: of all hits the smallest (t, number) is the best.
#pragma once

#include "accel/kernels/ray_lanes.h"
#include "accel/kernels/solids.h"
#include "accel/kernels/solids_each.h"
#include "accel/kernels/solids_hulls.h"
#include "accel/kernels/wide_tree.h"
#include "base/cpu.h"
#include "simd/lanes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

LANES_BEGIN

class PacketPairs : public PacketEach {
protected:
    using PacketEach::PacketEach;

    static constexpr auto kFormulas = static_cast<std::size_t>(SolidTree::Meets::Alone);

    // `solid` as a node's child; stores write W places at once.
    template <std::size_t Most> struct Pairs {
        alignas(64) std::uint32_t solid[Most + W];
        alignas(64) std::uint8_t lane[Most + W];
        std::uint32_t count = 0;

        void add(std::uint32_t solidOf, std::uint8_t laneOf) {
            solid[count] = solidOf, lane[count] = laneOf;
            ++count;
        }
        // The first ones, all or some W; fewer than W are left.
        void drop(std::uint32_t done) {
            count -= done;
            if (count == 0) return;
            std::memcpy(solid, solid + done, W * sizeof *solid);
            std::memcpy(lane, lane + done, W);
        }
    };

    using Passed = Pairs<std::size_t{2} * W>;
    Pairs<std::size_t{W} * (W + 1)> waiting_; // for the filters: what is left, and of one step

    // The filter of tubes is long enough for it, that of balls is not.
    const bool areInPairs_ = kPairsPay && !tree_.tubes.empty();

    // W times the number of each lane: to load them takes less than to spread one.
    alignas(64) static constexpr auto kLane = [] {
        std::array<std::array<std::uint8_t, W>, W> lanes{};
        for (std::size_t i = 0; i < W; ++i) lanes[i].fill(static_cast<std::uint8_t>(i));
        return lanes;
    }();

    // Returns how many wait then, who were `count`.
    [[gnu::always_inline]] std::uint32_t wait(int ray, Mask chosen, const WideRef* solids,
                                              std::uint32_t count) {
        storeChosen(chosen, solids, waiting_.solid + count);
        std::memcpy(waiting_.lane + count, kLane[static_cast<std::size_t>(ray)].data(), W);
        return count + static_cast<std::uint32_t>(std::popcount(bits(chosen)));
    }

    template <Answer A, class Result> void meetFull(Result* results) {
        std::uint32_t done = 0;
        for (; waiting_.count - done >= W; done += W) {
            filter<A>(done, W, results);
            if (A == Answer::Any && live_ == 0) return;
        }
        waiting_.drop(done);
    }

    template <Answer A, class Result> void meetAll(Result* results) {
        if (waiting_.count != 0) filter<A>(0, waiting_.count, results);
        waiting_.count = 0;
        for (std::size_t i = 0; i < kFormulas; ++i)
            if (passed_[i].count != 0 && (A == Answer::Closest || live_ != 0))
                meetPassed<A>(static_cast<SolidTree::Meets>(i), results);
    }

    void dropAll() {
        waiting_.count = 0;
        for (Passed& list : passed_) list.count = 0;
    }

private:
    struct Hulls {
        BallLanes ball;
        TubeLanes tube;
        unsigned tubes, openFronts; // lanes
    };
    Hulls hullsOf(const std::uint32_t* solids) const {
        static_assert(offsetof(SolidTree::Solid, isOpenFront) ==
                      offsetof(SolidTree::Solid, centre) + 9 * sizeof(float));
        const float* row[W];
        for (int i = 0; i < W; ++i) row[i] = &solidOf(solids[i]).centre.x;
        Floats a[4], b[4], c[4];
        loadRows(row, a);
        for (const float*& from : row) from += 4;
        loadRows(row, b);
        for (const float*& from : row) from += 2;
        loadRows(row, c);
        const Floats none(0.0f);
        return {{{a[0], a[1], a[2]}, b[2], b[3]},
                {{a[3], b[0], b[1]}, c[2]},
                bits(maxAbs(maxAbs(a[3], b[0]), b[1]) > none),
                bits(c[3] > none)};
    }

    Lines linesOf(Ints lane) const {
        const auto at = [&](Floats x) { return permute(x, lane); };
        const RayColumns rays = permuted(columns_, lane);
        return {{rays.org[0], rays.org[1], rays.org[2]},
                {rays.dir[0], rays.dir[1], rays.dir[2]},
                at(length_),
                at(perLength_),
                at(perLength2_),
                at(slack_),
                rays.tMin,
                at(bound_)};
    }

    template <Answer A, class Result>
    [[gnu::noinline]] void filter(std::uint32_t first, std::uint32_t count, Result* results) {
        std::uint32_t* const solids = waiting_.solid + first;
        std::uint8_t* const lanes = waiting_.lane + first;
        for (std::uint32_t i = count; i < W; ++i) solids[i] = solids[0], lanes[i] = lanes[0];
        const Ints lane = Ints::bytes(lanes);
        unsigned on = (1u << count) - 1;
        if constexpr (A == Answer::Any) on &= stillAsking(lane);
        const Hulls hulls = hullsOf(solids);
        const Lines lines = linesOf(lane);
        const Nearness near =
            (on & hulls.tubes) == 0
                ? nearBall<A>(lines, hulls.ball)
                : nearTube<A, HullMix::WithBalls>(lines, hulls.ball, hulls.tube, on);
        on &= near.may;
        if constexpr (A == Answer::Any) {
            hideCertain(near.certain & on, solids, lanes, results);
            on &= stillAsking(lane);
        } else {
            // They see it from inside where they leave it.
            if ((on & hulls.tubes) != 0) on &= ~(near.behind & hulls.openFronts);
            on = boundBy(near, on, solids, lanes, lane);
        }
        pass<A>(on, solids, lanes, results);
    }

    unsigned stillAsking(Ints lane) const {
        const Floats none(0.0f);
        return bits(permute(select(maskOf(live_), Floats(1.0f), none), lane) > none);
    }

    // Returns which of the pairs are not behind what their rays hit for certain.
    unsigned boundBy(const Nearness& near, unsigned on, const std::uint32_t* solids,
                     const std::uint8_t* lanes, Ints lane) {
        if (const unsigned certain = near.certain & on; certain != 0) {
            alignas(64) float farthest[W], bound[W];
            near.farthest.store(farthest), bound_.store(bound);
            for (unsigned rest = certain; rest != 0; rest &= rest - 1) {
                const int i = std::countr_zero(rest);
                if (solidOf(solids[i]).meets == SolidTree::Meets::Alone) continue;
                bound[lanes[i]] = ::min(farthest[i], bound[lanes[i]]);
            }
            bindTo(Floats::load(bound));
        }
        return on & bits(notGreater(near.nearest, permute(bound_, lane)));
    }

    void hideCertain(unsigned certain, const std::uint32_t* solids, const std::uint8_t* lanes,
                     std::uint8_t* hidden) {
        unsigned hit = 0;
        for (; certain != 0; certain &= certain - 1) {
            const int i = std::countr_zero(certain);
            if (!solidOf(solids[i]).hides) continue;
            hit |= 1u << lanes[i];
            asked_ = solids[i] >> 2;
        }
        if (hit != 0) hide(hit, hidden);
    }

    template <Answer A, class Result>
    void pass(unsigned on, const std::uint32_t* solids, const std::uint8_t* lanes,
              Result* results) {
        unsigned full = 0; // lists
        for (; on != 0; on &= on - 1) {
            const int i = std::countr_zero(on);
            const SolidTree::Solid& solid = solidOf(solids[i]);
            if (A == Answer::Any && !solid.hides) continue;
            const auto formula = static_cast<std::size_t>(solid.meets);
            passed_[formula].add(solids[i], lanes[i]);
            full |= unsigned{passed_[formula].count >= W} << formula;
            prefetch(solid);
            __builtin_prefetch(&tree_.boxes[solids[i] >> 2]);
        }
        if (passed_[kFormulas].count != 0) meetAlone<A>(results);
        for (full &= (1u << kFormulas) - 1; full != 0; full &= full - 1) {
            if (A == Answer::Any && live_ == 0) return;
            meetPassed<A>(static_cast<SolidTree::Meets>(std::countr_zero(full)), results);
        }
    }

    // The rays of each at once.
    template <Answer A, class Result> [[gnu::noinline]] void meetAlone(Result* results) {
        Passed& list = passed_[kFormulas];
        while (list.count != 0) {
            const std::uint32_t ref = list.solid[0];
            unsigned lanes = 0;
            std::uint32_t kept = 0;
            for (std::uint32_t i = 0; i < list.count; ++i) {
                if (list.solid[i] == ref) {
                    lanes |= 1u << list.lane[i];
                } else {
                    list.solid[kept] = list.solid[i], list.lane[kept] = list.lane[i];
                    ++kept;
                }
            }
            list.count = kept;
            if constexpr (A == Answer::Any) lanes &= live_;
            if (lanes != 0) this->template meetOne<A>(ref >> 2, lanes, results);
        }
    }

    // The first W that passed.
    template <Answer A, class Result> void meetPassed(SolidTree::Meets formula, Result* results) {
        Passed& list = passed_[static_cast<std::size_t>(formula)];
        const std::uint32_t count = std::min<std::uint32_t>(list.count, W);
        for (std::uint32_t i = count; i < W; ++i)
            list.solid[i] = list.solid[0], list.lane[i] = list.lane[0];
        this->template meetEach<A>(formula, list.solid, list.lane, (1u << count) - 1, results);
        list.drop(count);
    }

    Passed passed_[kFormulas + 1]; // by formula, and those without; fewer than W wait for others
};

LANES_END
