// Affine maps as their twelve numbers, for readers and checks of many of them: what needs no
// inverse. transform.h has the maps that things are placed with.
#pragma once

#include "base/bounds.h"
#include "base/ray.h"
#include "base/vec.h"

#include <array>

// Row-major 3x4, as Transform::Rows.
using AffineRows = std::array<double, 12>;

inline Vec3d vectorUnder(const AffineRows& m, Vec3d v) {
    return {m[0] * v.x + m[1] * v.y + m[2] * v.z, m[4] * v.x + m[5] * v.y + m[6] * v.z,
            m[8] * v.x + m[9] * v.y + m[10] * v.z};
}
inline Vec3d pointUnder(const AffineRows& m, Vec3d p) {
    return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3],
            m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
            m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
}
// First b, then a.
AffineRows product(const AffineRows& a, const AffineRows& b);
// A box around the mapped box; includes the rounding of Transform::point().
BoundsD boundsOf(const AffineRows& rows, const BoundsD& box);

// Transform: an affine map in double together with its inverse.
// Names carry the frames: worldFromObject.point(p) takes an object point to the world.

class Transform {
public:
    // Row-major 3x4: x' = r[0] x + r[1] y + r[2] z + r[3], then y' from r[4].., z' from r[8]..
    using Rows = AffineRows;

    Transform() = default; // the identity

    static Transform fromRows(const Rows& rows);
    // What fromRows(rows) would be, for who needs no inverse.
    enum class Orientation { Kept, Mirrored, Lost }; // lost: singular
    static Orientation orientationOf(const Rows& rows);
    static Transform translate(Vec3d offset);
    // Right-handed turn about an axis through the origin; the axis has any length but zero.
    static Transform rotate(Vec3d axis, double angleRad);
    static Transform scale(Vec3d factors);
    static Transform scale(double factor) { return scale({factor, factor, factor}); }
    // worldFromCamera for a camera as in Blender: it looks along its -z, +y is up, +x is right.
    // If `up` is along the view (or zero), another axis of the world stands in for it.
    static Transform lookAt(Vec3d eye, Vec3d target, Vec3d up);

    const Rows& rows() const { return rows_; }
    // Those of inverse().
    const Rows& inverseRows() const { return inverse_; }
    Vec3d column(int i) const { // 0, 1, 2: images of the axes; 3: image of the origin
        const auto c = static_cast<std::size_t>(i);
        return {rows_[c], rows_[4 + c], rows_[8 + c]};
    }
    Vec3d translation() const { return column(3); }

    Vec3d point(Vec3d p) const { return pointUnder(rows_, p); }
    Vec3d vector(Vec3d v) const { return vectorUnder(rows_, v); }
    // The normal of the mapped surface, not normalised: by the inverse transpose, the cofactor
    // matrix over the determinant. So an outward normal stays outward under mirrors too. (The cross
    // product of two mapped edges does NOT: it flips when mirrors() is true.) Singular maps take
    // the cofactor matrix alone: what was flattened to a plane gets the plane's normal.
    Vec3d normal(Vec3d n) const {
        if (singular_) return normalOfFlattened(n);
        const Rows& m = inverse_; // transposed
        return {m[0] * n.x + m[4] * n.y + m[8] * n.z, m[1] * n.x + m[5] * n.y + m[9] * n.z,
                m[2] * n.x + m[6] * n.y + m[10] * n.z};
    }
    // dir is not normalised, so t stays the same number on both rays.
    RayD ray(const RayD& r) const { return {point(r.org), vector(r.dir)}; }
    Ray ray(const Ray& r) const; // rounded to float; tMin, tMax, time are kept
    // A box around the mapped box; includes the rounding of point().
    BoundsD bounds(const BoundsD& box) const;

    // Of a singular map: the zero map (ask isSingular() when the map comes from a file).
    Transform inverse() const;
    // True when the determinant cannot be told from zero in double, or a number is not finite.
    bool isSingular() const { return singular_; }
    double determinant() const;               // of the linear part
    bool mirrors() const { return mirrors_; } // the determinant is negative
    bool isIdentity() const { return rows_ == kIdentity; }

    // Two maps are equal when they map alike; how they were built does not matter.
    bool operator==(const Transform& other) const { return rows_ == other.rows_; }
    // (aFromB * bFromC).point(p) = aFromB.point(bFromC.point(p))
    friend Transform operator*(const Transform& aFromB, const Transform& bFromC);

private:
    static constexpr Rows kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

    Transform(const Rows& rows, const Rows& inverse, bool mirrors, bool singular)
        : rows_(rows), inverse_(inverse), mirrors_(mirrors), singular_(singular) {}

    Vec3d normalOfFlattened(Vec3d n) const;

    Rows rows_ = kIdentity, inverse_ = kIdentity;
    bool mirrors_ = false, singular_ = false;
};
