// Places of samples by the density of a pixel filter: Filter::sample() is the one lane of it.
#pragma once

#include "sample/filter.h"
#include "simd/lanes.h"

LANES_BEGIN

// Returns the offset from the centre along one axis, in pixels, for u in [0,1).
inline Floats offsetOf(const Filter::Spread& filter, Floats u) {
    const Doubles one(1.0), place = Doubles(2.0) * Doubles(u) - one, size = abs(place);
    Doubles radii = size;
    switch (filter.kind) {
    case FilterKind::Box: break;
    case FilterKind::Tent: radii = size / (one + sqrt(one - size)); break; // 1 - sqrt(1 - size)
    case FilterKind::Gaussian:
    case FilterKind::BlackmanHarris:
        const Doubles at = sqrt(one - size) * Doubles(Filter::kSteps);
        const Doubles step = min(floor(at), Doubles(Filter::kSteps - 1)), across = at - step;
        alignas(64) std::uint32_t entry[W];
        wholeOf(step).store(entry);
        Floats here(0.0f), next(0.0f);
        loadPairs([&](std::size_t i) { return filter.inverse + entry[i]; }, here, next);
        radii = Doubles(here) * (one - across) + Doubles(next) * across;
        break;
    }
    return withSign(radii * Doubles(filter.radius), place).toFloats();
}

LANES_END
