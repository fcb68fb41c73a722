// Barycentrics of W hits.
#pragma once

#include "simd/lanes.h"

LANES_BEGIN

struct Weights {
    Floats u, v;
};

// barycentrics() of shape/triangle_queries.h, operation by operation, from the x and y of
// ShearedTriangle.
inline Weights barycentrics(const Floats (&x)[3], const Floats (&y)[3]) {
    const auto edge = [&](int a, int b) {
        return Doubles(x[a]) * Doubles(y[b]) - Doubles(y[a]) * Doubles(x[b]);
    };
    const Doubles e0 = edge(2, 1), e1 = edge(0, 2), e2 = edge(1, 0);
    const Doubles sum = e0 + e1 + e2;
    return {(e1 / sum).toFloats(), (e2 / sum).toFloats()};
}

LANES_END
