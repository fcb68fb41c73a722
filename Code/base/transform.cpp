#include "base/transform.h"

#include <bit>

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

namespace {

using Rows = Transform::Rows;

// The cofactor matrix of the linear part, row-major 3x3: row i is the cross product of the two
// other rows. Sums of products with the error of two rounded products.
std::array<double, 9> cofactors(const Rows& m) {
    const Vec3d r0{m[0], m[1], m[2]}, r1{m[4], m[5], m[6]}, r2{m[8], m[9], m[10]};
    const Vec3d c0 = cross(r1, r2), c1 = cross(r2, r0), c2 = cross(r0, r1);
    return {c0.x, c0.y, c0.z, c1.x, c1.y, c1.z, c2.x, c2.y, c2.z};
}

double largestLinear(const Rows& m) {
    double largest = 0;
    for (const std::size_t i : {0u, 1u, 2u, 4u, 5u, 6u, 8u, 9u, 10u})
        largest = max(largest, std::fabs(m[i]));
    return largest;
}

// Without a branch per number: what is infinite or NaN gives NaN.
bool isFinite(const Rows& m) {
    double zero = 0;
    for (const double x : m) zero += x * 0;
    return zero == 0;
}

// Multiplies by the power of two that brings `largest` into [0.5, 1).
class PowerOfTwo {
public:
    explicit PowerOfTwo(double largest) {
        const auto biased = static_cast<int>(std::bit_cast<std::uint64_t>(largest) >> 52);
        exponent_ = biased - 1022;
        if (biased == 0) std::frexp(largest, &exponent_);
        // By multiplication where the power is a normal number: ldexp() is a call each time.
        isNormal_ = std::abs(exponent_) <= 1000;
        if (isNormal_)
            power_ = std::bit_cast<double>(static_cast<std::uint64_t>(1023 - exponent_) << 52);
    }
    double operator()(double x) const { return isNormal_ ? x * power_ : std::ldexp(x, -exponent_); }

private:
    int exponent_ = 0;
    bool isNormal_ = false;
    double power_ = 0;
};

// Of a linear part that is scaled to about 1 by a power of two: that is exact, and products of
// three stay in range.
struct Determinant {
    Determinant(const Rows& rows, const PowerOfTwo& scaled) {
        Rows m = rows;
        for (double& x : m) x = scaled(x);
        cofactor = cofactors(m);
        value = m[0] * cofactor[0] + m[1] * cofactor[1] + m[2] * cofactor[2];
        products = std::fabs(m[0] * m[5] * m[10]) + std::fabs(m[0] * m[6] * m[9]) +
                   std::fabs(m[1] * m[6] * m[8]) + std::fabs(m[1] * m[4] * m[10]) +
                   std::fabs(m[2] * m[4] * m[9]) + std::fabs(m[2] * m[5] * m[8]);
    }
    // Rounding errs by at most 5 u times the sum of the sizes of all six products.
    bool isCertain() const { return std::fabs(value) > 8 * 0x1p-53 * products; }

    std::array<double, 9> cofactor;
    double value = 0, products = 0;
};

// Most things are moved and scaled along the axes and no more: zeros beside the diagonal, none of
// them negative, and numbers above zero on it.
bool isScaling(const Rows& m) {
    std::uint64_t others = 0;
    for (const std::size_t i : {1u, 2u, 4u, 6u, 8u, 9u})
        others |= std::bit_cast<std::uint64_t>(m[i]);
    return others == 0 && m[0] > 0 && m[5] > 0 && m[10] > 0;
}

// The Determinant of such a map, in the same bits: products with its zeros add nothing.
struct ScalingDeterminant {
    ScalingDeterminant(const Rows& m, const PowerOfTwo& scaled) {
        const double x = scaled(m[0]), y = scaled(m[5]), z = scaled(m[10]);
        cofactor = {y * z, z * x, x * y};
        value = x * cofactor.x;
        products = x * y * z;
    }
    bool isCertain() const { return value > 8 * 0x1p-53 * products; }

    Vec3d cofactor; // those of the diagonal
    double value = 0, products = 0;
};

Vec3d unit(Vec3d v) {
    const double size = maxAbs(v); // first, so that squares neither overflow nor underflow
    return normalize(v / size);
}

} // namespace

Transform Transform::fromRows(const Rows& rows) {
    const auto singular = [&] { return Transform(rows, Rows{}, false, true); };
    if (!isFinite(rows)) return singular();
    const double largest = largestLinear(rows);
    if (largest == 0) return singular();
    const PowerOfTwo scaled(largest);
    Rows inverse{};
    bool mirrors = false;
    if (isScaling(rows)) {
        const ScalingDeterminant d(rows, scaled);
        if (!d.isCertain()) return singular();
        for (std::size_t i = 0; i < 3; ++i) inverse[5 * i] = scaled(d.cofactor[i] / d.value);
    } else {
        const Determinant d(rows, scaled);
        if (!d.isCertain()) return singular();
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                inverse[4 * k + i] = scaled(d.cofactor[3 * i + k] / d.value);
        mirrors = d.value < 0;
    }
    for (const std::size_t i : {0u, 4u, 8u})
        inverse[i + 3] =
            -(inverse[i] * rows[3] + inverse[i + 1] * rows[7] + inverse[i + 2] * rows[11]);
    if (!isFinite(inverse)) return singular();
    return {rows, inverse, mirrors, false};
}

Transform::Orientation Transform::orientationOf(const Rows& rows) {
    const double largest = largestLinear(rows);
    double farthest = 0; // NaN where a number is none
    for (const std::size_t i : {3u, 7u, 11u}) farthest += std::fabs(rows[i]);
    if (largest > 0x1p-250 && largest < 0x1p250 && farthest < 0x1p250) {
        constexpr double kLeast = 0x1p-80; // and no product is too small
        if (isScaling(rows) && largest < 0x1p80 && min(rows[0], min(rows[5], rows[10])) > kLeast)
            return Orientation::Kept;
        const Determinant d(rows, PowerOfTwo(largest));
        // Cofactors are below 2: so the inverse's numbers are below 2^501, its offsets finite.
        if (std::fabs(d.value) > 0x1p-250 && d.isCertain())
            return d.value < 0 ? Orientation::Mirrored : Orientation::Kept;
    }
    const Transform map = fromRows(rows);
    if (map.isSingular()) return Orientation::Lost;
    return map.mirrors() ? Orientation::Mirrored : Orientation::Kept;
}

Transform Transform::translate(Vec3d offset) {
    Rows rows = kIdentity, inverse = kIdentity;
    rows[3] = offset.x, rows[7] = offset.y, rows[11] = offset.z;
    inverse[3] = -offset.x, inverse[7] = -offset.y, inverse[11] = -offset.z;
    if (!isFinite(rows)) return {rows, Rows{}, false, true};
    return {rows, inverse, false, false};
}

// Rodrigues; the inverse of a rotation is its transpose.
Transform Transform::rotate(Vec3d axis, double angleRad) {
    const Vec3d a = unit(axis);
    const auto [s, c] = exact::sinCos(angleRad);
    // 1 - cos without cancellation.
    const double half = exact::sin(0.5 * angleRad), k = 2 * half * half;
    const double xy = k * a.x * a.y, yz = k * a.y * a.z, zx = k * a.z * a.x;
    const Rows rows{c + k * a.x * a.x, xy - s * a.z,      zx + s * a.y,      0,
                    xy + s * a.z,      c + k * a.y * a.y, yz - s * a.x,      0,
                    zx - s * a.y,      yz + s * a.x,      c + k * a.z * a.z, 0};
    const Rows inverse{rows[0], rows[4], rows[8], 0,       rows[1],  rows[5],
                       rows[9], 0,       rows[2], rows[6], rows[10], 0};
    if (!isFinite(rows)) return {rows, Rows{}, false, true};
    return {rows, inverse, false, false};
}

Transform Transform::scale(Vec3d f) {
    const Rows rows{f.x, 0, 0, 0, 0, f.y, 0, 0, 0, 0, f.z, 0};
    const Rows inverse{1 / f.x, 0, 0, 0, 0, 1 / f.y, 0, 0, 0, 0, 1 / f.z, 0};
    if (!isFinite(rows) || !isFinite(inverse)) return {rows, Rows{}, false, true};
    return {rows, inverse, (f.x < 0) != ((f.y < 0) != (f.z < 0)), false};
}

Transform Transform::lookAt(Vec3d eye, Vec3d target, Vec3d up) {
    const Vec3d back = eye - target;
    const Vec3d z = maxAbs(back) > 0 ? unit(back) : Vec3d{0, 0, 1};
    // Within 1e-10 radians of the view, the rounding of `up` would decide the roll.
    const auto side = [&](Vec3d upward) {
        const double size = maxAbs(upward);
        return size > 0 ? cross(upward / size, z) : Vec3d{};
    };
    Vec3d x = side(up);
    if (!(maxAbs(x) > 1e-10)) x = side(std::fabs(z.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{0, 0, 1});
    x = unit(x);
    const Vec3d y = cross(z, x);
    return translate(eye) * fromRows({x.x, y.x, z.x, 0, x.y, y.y, z.y, 0, x.z, y.z, z.z, 0});
}

Vec3d Transform::normalOfFlattened(Vec3d n) const {
    const std::array<double, 9> c = cofactors(rows_);
    return {c[0] * n.x + c[1] * n.y + c[2] * n.z, c[3] * n.x + c[4] * n.y + c[5] * n.z,
            c[6] * n.x + c[7] * n.y + c[8] * n.z};
}

Ray Transform::ray(const Ray& r) const {
    return {toFloat(point(toDouble(r.org))), toFloat(vector(toDouble(r.dir))), r.tMin, r.tMax,
            r.time};
}

BoundsD Transform::bounds(const BoundsD& box) const { return boundsOf(rows_, box); }

Transform Transform::inverse() const {
    return singular_ ? fromRows(Rows{}) : Transform(inverse_, rows_, mirrors_, false);
}

double Transform::determinant() const {
    const std::array<double, 9> c = cofactors(rows_);
    return rows_[0] * c[0] + rows_[1] * c[1] + rows_[2] * c[2];
}

Transform operator*(const Transform& aFromB, const Transform& bFromC) {
    const Rows rows = product(aFromB.rows_, bFromC.rows_);
    const Rows inverse = product(bFromC.inverse_, aFromB.inverse_);
    if (aFromB.singular_ || bFromC.singular_ || !isFinite(rows) || !isFinite(inverse))
        return {rows, Rows{}, false, true};
    return {rows, inverse, aFromB.mirrors_ != bFromC.mirrors_, false};
}
