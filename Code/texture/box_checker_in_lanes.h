// The exact means of checkerboards over footprints, in lanes: what part of them has the odd colour.
#pragma once

#include "base/transform.h"
#include "simd/lanes.h"
#include "texture/footprint_in_lanes.h"
#include "texture/picture_lanes.h"

#include <cstddef>

LANES_BEGIN

// The mean over [x - w / 2, x + w / 2] of a wave that is 1 on [0, 1), -1 on [1, 2), and so on; its
// integral is a triangle of the same period. Beyond a cell the mean is at most 1 / w.
inline Doubles boxOfSquareWave(const Doubles& x, const Doubles& w) {
    const Doubles zero(0.0), half(0.5), one(1.0), two(2.0);
    const auto inPeriod = [&](const Doubles& at) { return at - two * floor(at * half); };
    const auto integral = [&](const Doubles& at) {
        const Doubles f = inPeriod(at);
        return min(f, two - f);
    };
    const Doubles near = inPeriod(x), reach = w * half; // far away its digits are the cell's number
    const Doubles mean = (integral(near + reach) - integral(near - reach)) / w;
    return select(zero < w, mean, select(near < one, one, Doubles(-1.0)));
}

// The parts of footprints around places u, v where floor(u) + floor(v) is odd. A long footprint is
// taken as up to sixteen boxes along it.
inline Doubles oddParts(const Doubles& u, const Doubles& v, const FootprintLanes& footprints) {
    const Doubles zero(0.0), half(0.5), one(1.0), most(16.0);
    const Doubles alongU(footprints.along.u), alongV(footprints.along.v),
        acrossU(footprints.across.u), acrossV(footprints.across.v);
    const auto lengthOf = [](const Doubles& x, const Doubles& y) { return sqrt(x * x + y * y); };
    const Doubles ratio = lengthOf(alongU, alongV) / lengthOf(acrossU, acrossV), // NaN of points
        whole = floor(ratio);
    const Doubles boxes = max(min(select(whole < ratio, whole + one, whole), most), one);
    const Doubles widthU = lengthOf(alongU / boxes, acrossU),
                  widthV = lengthOf(alongV / boxes, acrossV);
    Doubles sum = zero;
    for (double i = 0; const unsigned lanes = less(Doubles(i), boxes); ++i) {
        const Doubles at = Doubles(2 * i + 1) / boxes * half - half;
        const Doubles box = boxOfSquareWave(u + at * alongU, widthU) *
                            boxOfSquareWave(v + at * alongV, widthV);
        sum = select(maskOf(lanes), sum + box, sum);
    }
    return min(max(half * (one - sum / boxes), zero), one);
}

inline void findOddParts(const AffineRows& objectFromWorld, CheckerBlock& block,
                         std::size_t count) {
    for (std::size_t first = 0; first < count; first += W) {
        const auto in = [&](const float* lane) { return Doubles(Floats::load(lane + first)); };
        const Doubles t = in(block.t[0]) + in(block.t[1]);
        const auto placeOn = [&](std::size_t row) {
            const double* const m = objectFromWorld.data() + 4 * row;
            const auto under = [&](const FootprintBlock::Lane(&v)[3]) {
                return Doubles(m[0]) * in(v[0]) + Doubles(m[1]) * in(v[1]) +
                       Doubles(m[2]) * in(v[2]);
            };
            return under(block.org) + Doubles(m[3]) + under(block.dir) * t;
        };
        oddParts(placeOn(0), placeOn(1), footprintsOf(block, first))
            .toFloats()
            .store(block.odd + first);
    }
}

LANES_END
