// Slopes of the rays of a bundle, W to a packet: their ranges, and the gaps in them.
#pragma once

#include "base/math.h"
#include "simd/lanes.h"

#include <bit>

LANES_BEGIN

struct SlopeRange {
    float lo, hi;
};

// Of slopes, lane by lane.
struct SlopeExtent {
    Floats lo{kInfinityF}, hi{-kInfinityF};

    void extend(Floats s, Mask lanes) {
        lo = min(lo, select(lanes, s, Floats(kInfinityF)));
        hi = max(hi, select(lanes, s, Floats(-kInfinityF)));
    }
    SlopeRange range() const { return {smallest(lo), largest(hi)}; }
};

// Shadow rays of a tile end on surfaces far apart: while nearly half of the rectangle is an
// empty stretch, the rays on the far side of it wait for the next round. x and y are the ranges of
// the chosen rays, before and after.
inline void cutGaps(const float (*slopesX)[W], const float (*slopesY)[W], int packets,
                    unsigned* chosen, SlopeRange& x, SlopeRange& y) {
    constexpr float kGap = 0.45f;
    for (int round = 0; round < 6; ++round) {
        const float middleX = 0.5f * (x.lo + x.hi), middleY = 0.5f * (y.lo + y.hi);
        SlopeExtent left, right, under, over;
        for (int p = 0; p < packets; ++p) {
            const Mask m = maskOf(chosen[p]);
            const Floats sx = Floats::load(slopesX[p]), sy = Floats::load(slopesY[p]);
            const Mask toRight = m & (sx > Floats(middleX)), up = m & (sy > Floats(middleY));
            right.lo = min(right.lo, select(toRight, sx, Floats(kInfinityF)));
            over.lo = min(over.lo, select(up, sy, Floats(kInfinityF)));
            left.hi = max(left.hi, select(m & (sx <= Floats(middleX)), sx, Floats(-kInfinityF)));
            under.hi = max(under.hi, select(m & (sy <= Floats(middleY)), sy, Floats(-kInfinityF)));
        }
        const auto gap = [&](const SlopeExtent& before, const SlopeExtent& behind,
                             SlopeRange whole) {
            const float width = smallest(behind.lo) - largest(before.hi);
            return width < kInfinityF && width > kGap * (whole.hi - whole.lo) ? width : 0.0f;
        };
        const float gapX = gap(left, right, x), gapY = gap(under, over, y);
        if (gapX == 0 && gapY == 0) return;
        const auto* raw = gapX > gapY ? slopesX : slopesY;
        const float middle = gapX > gapY ? middleX : middleY;
        int first = 0;
        while (chosen[first] == 0) ++first;
        const bool keepUpper = raw[first][std::countr_zero(chosen[first])] > middle;
        SlopeExtent xs, ys;
        for (int p = 0; p < packets; ++p) {
            const unsigned upper = bits(Floats::load(raw[p]) > Floats(middle));
            chosen[p] &= keepUpper ? upper : ~upper;
            const Mask m = maskOf(chosen[p]);
            xs.extend(Floats::load(slopesX[p]), m), ys.extend(Floats::load(slopesY[p]), m);
        }
        x = xs.range(), y = ys.range();
    }
}

LANES_END
