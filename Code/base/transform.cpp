#include "base/transform.h"

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
    for (const std::size_t i : {0u, 1u, 2u, 4u, 5u, 6u, 8u, 9u, 10u}) {
        if (!(std::fabs(m[i]) <= largest)) largest = std::fabs(m[i]);
        if (largest != largest) return largest;
    }
    return largest;
}

bool isFinite(const Rows& m) {
    for (const double x : m)
        if (!(std::fabs(x) < kInfinity)) return false;
    return true;
}

Vec3d unit(Vec3d v) {
    const double size = maxAbs(v); // first, so that squares neither overflow nor underflow
    return normalize(v / size);
}

} // namespace

Transform Transform::fromRows(const Rows& rows) {
    const Transform singular(rows, Rows{}, false, true);
    const double largest = largestLinear(rows);
    if (!isFinite(rows) || largest == 0) return singular;
    // Scaled to about 1 by a power of two: exact, and products of three stay in range.
    int exponent = 0;
    std::frexp(largest, &exponent);
    // By multiplication where the power is a normal number: ldexp() is a call each time.
    const bool isNormal = std::abs(exponent) <= 1000;
    const double power = isNormal ? std::ldexp(1.0, -exponent) : 0;
    const auto scaled = [&](double x) { return isNormal ? x * power : std::ldexp(x, -exponent); };
    Rows m = rows;
    for (double& x : m) x = scaled(x);
    const std::array<double, 9> c = cofactors(m);
    const double determinant = m[0] * c[0] + m[1] * c[1] + m[2] * c[2];
    // The sum of the sizes of all six products: rounding errs by at most 5 u times that.
    double products = 0;
    for (const auto& [i, j, k] : {std::array<std::size_t, 3>{0, 5, 10},
                                  {0, 6, 9},
                                  {1, 6, 8},
                                  {1, 4, 10},
                                  {2, 4, 9},
                                  {2, 5, 8}})
        products += std::fabs(m[i] * m[j] * m[k]);
    if (!(std::fabs(determinant) > 8 * 0x1p-53 * products)) return singular;
    const auto entry = [&](std::size_t i) { return scaled(c[i] / determinant); };
    Rows inverse{entry(0), entry(3), entry(6), 0,        entry(1), entry(4),
                 entry(7), 0,        entry(2), entry(5), entry(8), 0};
    for (const std::size_t i : {0u, 4u, 8u})
        inverse[i + 3] =
            -(inverse[i] * rows[3] + inverse[i + 1] * rows[7] + inverse[i + 2] * rows[11]);
    if (!isFinite(inverse)) return singular;
    return {rows, inverse, determinant < 0, false};
}

Transform Transform::translate(Vec3d offset) {
    Rows rows = kIdentity, inverse = kIdentity;
    rows[3] = offset.x, rows[7] = offset.y, rows[11] = offset.z;
    inverse[3] = -offset.x, inverse[7] = -offset.y, inverse[11] = -offset.z;
    return {rows, inverse, false, !isFinite(rows)};
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
    return {rows, inverse, false, !isFinite(rows)};
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

// Arvo, Graphics Gems 1990: each entry of the matrix takes the side that is smaller or larger.
BoundsD Transform::bounds(const BoundsD& box) const {
    if (box.isEmpty()) return {};
    BoundsD out;
    for (std::size_t i = 0; i < 3; ++i) {
        double lo = rows_[4 * i + 3], hi = lo, size = std::fabs(lo);
        for (std::size_t j = 0; j < 3; ++j) {
            const double factor = rows_[4 * i + j];
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

Transform Transform::inverse() const {
    return singular_ ? fromRows(Rows{}) : Transform(inverse_, rows_, mirrors_, false);
}

double Transform::determinant() const {
    const std::array<double, 9> c = cofactors(rows_);
    return rows_[0] * c[0] + rows_[1] * c[1] + rows_[2] * c[2];
}

Transform operator*(const Transform& aFromB, const Transform& bFromC) {
    const auto product = [](const Rows& a, const Rows& b) {
        Rows out;
        for (std::size_t i = 0; i < 12; i += 4)
            for (std::size_t j = 0; j < 4; ++j)
                out[i + j] = a[i] * b[j] + a[i + 1] * b[4 + j] + a[i + 2] * b[8 + j] +
                             (j == 3 ? a[i + 3] : 0);
        return out;
    };
    const Rows rows = product(aFromB.rows_, bFromC.rows_);
    const Rows inverse = product(bFromC.inverse_, aFromB.inverse_);
    if (aFromB.singular_ || bFromC.singular_ || !isFinite(rows) || !isFinite(inverse))
        return {rows, Rows{}, false, true};
    return {rows, inverse, aFromB.mirrors_ != bFromC.mirrors_, false};
}
