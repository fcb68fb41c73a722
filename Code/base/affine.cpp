#include "base/affine.h"

AffineRows product(const AffineRows& a, const AffineRows& b) {
    AffineRows out;
    for (std::size_t i = 0; i < 12; i += 4)
        for (std::size_t j = 0; j < 4; ++j)
            out[i + j] =
                a[i] * b[j] + a[i + 1] * b[4 + j] + a[i + 2] * b[8 + j] + (j == 3 ? a[i + 3] : 0);
    return out;
}

// Arvo, Graphics Gems 1990: each entry of the matrix takes the side that is smaller or larger.
BoundsD boundsOf(const AffineRows& rows, const BoundsD& box) {
    if (box.isEmpty()) return {};
    BoundsD out;
    for (std::size_t i = 0; i < 3; ++i) {
        double lo = rows[4 * i + 3], hi = lo, size = std::fabs(lo);
        for (std::size_t j = 0; j < 3; ++j) {
            const double factor = rows[4 * i + j];
            if (factor == 0) continue; // also where the box is infinite
            const double a = factor * box.lo[j], b = factor * box.hi[j];
            lo += min(a, b);
            hi += max(a, b);
            size += max(std::fabs(a), std::fabs(b));
        }
        // Rounding here and in point(): four products and sums each.
        const double pad = size < kInfinity ? 2 * roundingBoundD(5) * size : 0;
        out.lo[i] = lo - pad;
        out.hi[i] = hi + pad;
    }
    return out;
}
