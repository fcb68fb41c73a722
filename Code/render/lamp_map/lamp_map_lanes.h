// The points of some blocks on the map of a lamp: led through the lists of their cells one by one,
// and met in pairs of a point and a hull, W of them together. Filters decide as those of the tree
// do, by the same functions: no hit passes by, and what is certain is one.
#pragma once

#include "accel/kernels/solids_hulls.h"
#include "base/math.h"
#include "render/lamp_map/lamp_map.h"
#include "render/lamp_map/lamp_map_cells.h"
#include "render/waves/lamp_lanes.h"
#include "simd/lanes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

LANES_BEGIN

// Points that something hides, and those of which only a ray can tell: a bit for each of a block.
struct HiddenByMap {
    unsigned hidden = 0, unsure = 0;
};

// The points of up to kBlocks blocks, each at a place. They take turns step by step, so that many
// wait for memory together.
class PointsOnMap {
public:
    static constexpr std::size_t kBlocks = 8;

    explicit PointsOnMap(const LampMap& map) : map_(map), hulls_(map.shapes->hulls.data()) {}

    void add(std::size_t slot, const LitBlock& block, const LitByLamp& by, unsigned points) {
        answers_[slot] = {};
        for (std::size_t first = 0; first < LitBlock::kPoints; first += W) {
            const unsigned some = points >> first & ((1u << W) - 1);
            if (some == 0) continue;
            const LanesOnMap lanes(map_, block, by, first, some);
            answers_[slot].unsure |= lanes.unsure() << first;
            for (unsigned rest = lanes.onMap(); rest != 0; rest &= rest - 1) {
                const int lane = std::countr_zero(rest);
                const std::size_t i = first + static_cast<std::size_t>(lane);
                const auto place = static_cast<std::uint32_t>(slot * LitBlock::kPoints + i);
                const bool inside = (block.inside >> i & 1) != 0;
                lines_[place] = {by.dir[0][i], by.dir[1][i], by.dir[2][i], by.tMax[i]};
                reach_[place] = lanes.reach(lane);
                const std::uint32_t cell = lanes.cell(lane);
                __builtin_prefetch(&map_.starts[cell]);
                walkers_.place[walking_] = place, walkers_.at[walking_] = cell;
                walkers_.own[walking_++] =
                    inside ? MappedShapes::kNoHull : map_.shapes->hullOf[block.shape[i]];
            }
        }
    }

    // All that was added is answered then.
    void run() {
        for (std::size_t k = 0; k < walking_; ++k) {
            walkers_.at[k] = map_.starts[walkers_.at[k]];
            __builtin_prefetch(&map_.lists[walkers_.at[k]]);
        }
        while (walking_ != 0) {
            step();
            meetSome<true>(balls_, balls_.count / W * W);
            meetSome<false>(others_, others_.count / W * W);
        }
        meetSome<true>(balls_, balls_.count);
        meetSome<false>(others_, others_.count);
    }

    HiddenByMap answer(std::size_t slot) const {
        const HiddenByMap& of = answers_[slot];
        return {of.hidden, of.unsure & ~of.hidden};
    }

private:
    static constexpr unsigned kAll = (1u << W) - 1;
    static constexpr std::size_t kPlaces = kBlocks * LitBlock::kPoints;
    struct Line {
        float x, y, z, tMax; // from the lamp
    };
    struct Walkers {
        alignas(64) std::uint32_t place[kPlaces + W], at[kPlaces + W]; // at: cell, then of lists
        alignas(64) std::uint32_t own[kPlaces + W];                    // hull that the point is on
    };
    struct Pairs {
        std::uint32_t place[kPlaces + 2 * W], hull[kPlaces + 2 * W]; // stores write W at once
        std::size_t count = 0;

        void add(unsigned chosen, Ints places, Ints hulls) {
            storeChosen(chosen, places, place + count), storeChosen(chosen, hulls, hull + count);
            count += static_cast<std::size_t>(std::popcount(chosen));
        }
    };

    // An entry for each, W at a time. No branch asks how long a list is: that is hard to tell in
    // advance.
    void step() {
        const Ints hullBits((1u << LampMap::kHullBits) - 1), firstOther(map_.shapes->firstOther);
        std::size_t kept = 0;
        for (std::size_t first = 0; first < walking_; first += W) {
            const unsigned lanes = walking_ - first < W ? (1u << (walking_ - first)) - 1 : kAll;
            const Ints place = Ints::load(walkers_.place + first),
                       at = Ints::load(walkers_.at + first), own = Ints::load(walkers_.own + first);
            const Ints entry = elementsAt(map_.lists.data(), at, lanes), hull = entry & hullBits;
            const unsigned on = lanes & bits(entry < elementsAt(reach_, place, lanes));
            storeChosen(on, place, walkers_.place + kept);
            storeChosen(on, at + Ints(1), walkers_.at + kept);
            storeChosen(on, own, walkers_.own + kept);
            kept += static_cast<std::size_t>(std::popcount(on));
            const unsigned met = on & ~bits(hull == own), ball = met & bits(hull < firstOther);
            balls_.add(ball, place, hull);
            if (met != ball) others_.add(met & ~ball, place, hull);
        }
        walking_ = kept;
    }

    // The first `count` pairs, in whose place come the others.
    template <bool kAreBalls> void meetSome(Pairs& pairs, std::size_t count) {
        for (std::size_t first = 0; first < count; first += W) {
            const std::size_t some = std::min<std::size_t>(W, count - first);
            std::uint32_t *const place = pairs.place + first, *const hull = pairs.hull + first;
            for (std::size_t i = some; i < W; ++i) place[i] = place[0], hull[i] = hull[0];
            take(kAreBalls ? meetBalls(place, hull) : meetOthers(place, hull), place,
                 (1u << some) - 1);
        }
        for (std::size_t i = count; i < pairs.count; ++i)
            pairs.place[i - count] = pairs.place[i], pairs.hull[i - count] = pairs.hull[i];
        pairs.count -= count;
    }

    Lines linesTo(const std::uint32_t* place) const {
        const float* row[W];
        for (int i = 0; i < W; ++i) row[i] = &lines_[place[i]].x;
        Floats a[4];
        loadRows(row, a);
        const Floats length2 = fma(a[0], a[0], fma(a[1], a[1], a[2] * a[2])), one(1.0f);
        const Floats length = sqrt(length2);
        return {{Floats(map_.lamp.x), Floats(map_.lamp.y), Floats(map_.lamp.z)},
                {a[0], a[1], a[2]},
                length,
                one / length,
                one / length2,
                Floats(map_.slack),
                Floats(0.0f),
                a[3]};
    }

    static BallLanes ballsOf(const float* const (&row)[W]) {
        Floats a[4];
        loadRows(row, a);
        return {{a[0], a[1], a[2]}, a[3], a[3] * Floats(MappedShapes::kInner)};
    }

    HiddenByMap meetBalls(const std::uint32_t* place, const std::uint32_t* hull) const {
        const float* row[W];
        for (int i = 0; i < W; ++i) row[i] = &hulls_[hull[i]].centre.x;
        const BallLanes ball = ballsOf(row);
        const Lines lines = linesTo(place);
        const Nearness near = nearBall<Answer::Any>(lines, ball);
        const auto& d = lines.dir;
        const Floats foot =
            fma(ball.centre[0] - lines.org[0], d[0],
                fma(ball.centre[1] - lines.org[1], d[1], (ball.centre[2] - lines.org[2]) * d[2])) *
            lines.perLength2;
        const Floats entry = fnma(ball.radius + lines.slack, lines.perLength, foot);
        return {near.may & near.certain, near.may & bits(notGreater(entry, lines.best))};
    }

    HiddenByMap meetOthers(const std::uint32_t* place, const std::uint32_t* hull) const {
        static_assert(offsetof(MappedShapes::Hull, axis) == 4 * sizeof(float) &&
                      offsetof(MappedShapes::Hull, halfLength) == 7 * sizeof(float));
        const float* row[W];
        for (int i = 0; i < W; ++i) row[i] = &hulls_[hull[i]].centre.x;
        BallLanes ball = ballsOf(row);
        for (const float*& from : row) from += 4;
        Floats a[4];
        loadRows(row, a);
        TubeLanes tube{{a[0], a[1], a[2]}, a[3]};
        const Lines lines = linesTo(place);
        const auto& cores = map_.shapes->cores;
        if (cores.empty()) return answerOf(nearTube<Answer::Any>(lines, ball, tube, kAll));
        alignas(64) float core[W];
        for (int i = 0; i < W; ++i) core[i] = cores[hull[i] - map_.shapes->firstOther];
        ball.innerRadius = Floats::load(core);
        tube.halfLength = select(a[3] > Floats(0.0f), a[3], Floats(kInfinityF)); // else a ball
        return answerOf(nearTube<Answer::Any, HullMix::WithCores>(lines, ball, tube, kAll));
    }

    static HiddenByMap answerOf(const Nearness& near) {
        return {near.may & near.certain, near.may};
    }

    void take(const HiddenByMap& met, const std::uint32_t* place, unsigned lanes) {
        for (unsigned rest = met.hidden & lanes; rest != 0; rest &= rest - 1) {
            const std::uint32_t at = place[std::countr_zero(rest)];
            answers_[at / LitBlock::kPoints].hidden |= 1u << at % LitBlock::kPoints;
            reach_[at] = 0; // its way ends here
        }
        for (unsigned rest = met.unsure & ~met.hidden & lanes; rest != 0; rest &= rest - 1) {
            const std::uint32_t at = place[std::countr_zero(rest)];
            answers_[at / LitBlock::kPoints].unsure |= 1u << at % LitBlock::kPoints;
        }
    }

    const LampMap& map_;
    const MappedShapes::Hull* hulls_;
    std::size_t walking_ = 0;
    HiddenByMap answers_[kBlocks];
    std::uint32_t reach_[kPlaces];
    alignas(64) Line lines_[kPlaces];
    Walkers walkers_;
    Pairs balls_, others_; // W of them are met together, the rest waits for others
};

void askLampMap(const LampMap& map, std::span<const LitBlock> blocks, std::span<LitByLamp> by) {
    PointsOnMap points(map);
    std::array<std::size_t, PointsOnMap::kBlocks> block;
    std::size_t slots = 0;
    const auto finish = [&] {
        points.run();
        for (std::size_t slot = 0; slot < slots; ++slot) {
            const HiddenByMap answer = points.answer(slot);
            by[block[slot]].lit &= ~answer.hidden;
            by[block[slot]].unsure = answer.unsure;
        }
        slots = 0;
    };
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const unsigned asked = std::exchange(by[b].unsure, 0);
        if (asked == 0) continue;
        points.add(slots, blocks[b], by[b], asked);
        block[slots] = b;
        if (++slots == PointsOnMap::kBlocks) finish();
    }
    finish();
}

LANES_END
