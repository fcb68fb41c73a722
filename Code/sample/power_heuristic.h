// The weight of one of two ways to sample the same light (Veach 1997).
#pragma once

#include "simd/lanes.h"

LANES_BEGIN

// Returns pdf^2 / (pdf^2 + other^2), by the ratio of both, as squares may be infinite: 0 where
// `pdf` is 0 or `other` is infinite, 1 where `other` is 0.
inline Floats powerHeuristic(Floats pdf, Floats other) {
    const Floats one(1.0f), ratio = other / pdf;
    return select(pdf > Floats(0.0f), one / (one + ratio * ratio), Floats(0.0f));
}

LANES_END
