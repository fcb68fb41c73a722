// Which keys count, as KeyRange of shape/triangle_queries.h says it of t = 1 / (key dz): t > tMin
// is key < keyBelow(), t < tMax is key > keyAbove(). Both roundings of t are monotone, so there is
// such a key; it is a few floats from 1 / (t dz).
#pragma once

#include "base/math.h"
#include "simd/lanes.h"

#include <limits>

LANES_BEGIN

// The neighbours of a positive float: 0.53 to 1.06 units of its last place rounds to one.
inline Floats nextUp(Floats x) { return x + x * Floats(0x1.1p-24f); }
inline Floats nextDown(Floats x) { return x - x * Floats(0x1.1p-24f); }

inline constexpr int kMostSteps = 16; // 3 are the most that random rays took

// The largest key with t >= tMax; 0 for rays without an end, infinite for those that end at once.
inline Floats keyAbove(Floats tMax, Floats dz) {
    const Floats one(1.0f), most(std::numeric_limits<float>::max());
    const Mask endless = tMax == Floats(kInfinityF);
    if (bits(endless) == (1u << W) - 1) return Floats(0.0f);
    const auto isFar = [&](Floats key) { return tMax <= one / (key * dz); };
    Floats key = min(one / (tMax * dz), most);
    for (int i = 0; i < kMostSteps; ++i) {
        const Mask far = isFar(key);
        if (bits(far) == (1u << W) - 1) break;
        key = select(far, key, nextDown(key));
    }
    for (int i = 0; i < kMostSteps; ++i) {
        const Floats next = nextUp(key);
        const unsigned far = bits(isFar(next)) & ~bits(endless);
        if (far == 0) break;
        key = select(maskOf(far), next, key);
    }
    key = select(endless, Floats(0.0f), key);
    return select(tMax <= Floats(0.0f), Floats(kInfinityF), key);
}

// The smallest key with t <= tMin; infinite for rays that count from their start.
inline Floats keyBelow(Floats tMin, Floats dz) {
    const Floats zero(0.0f);
    const Mask late = tMin > zero;
    if (bits(late) == 0) return Floats(kInfinityF);
    const Floats one(1.0f), most(std::numeric_limits<float>::max());
    const auto isNear = [&](Floats key) { return one / (key * dz) <= tMin; };
    Floats key = min(one / (tMin * dz), most);
    for (int i = 0; i < kMostSteps; ++i) {
        const unsigned open = bits(late) & ~bits(isNear(key));
        if (open == 0) break;
        key = select(maskOf(open), nextUp(key), key);
    }
    for (int i = 0; i < kMostSteps; ++i) {
        const Floats next = nextDown(key);
        const unsigned near = bits(late) & bits(isNear(next));
        if (near == 0) break;
        key = select(maskOf(near), next, key);
    }
    return select(late, key, Floats(kInfinityF));
}

LANES_END
