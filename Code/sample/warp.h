// Maps from the unit square to the shapes that distribution ray tracing draws from.
// All are area-preserving (or have the stated density), so stratified input stays stratified.
#pragma once

#include "base/vec.h"

#include <vector>

// Uniform on the unit disk, concentric (Shirley and Chiu 1997): square rings become circles.
Vec2 diskFromSquare(Vec2 u);

// Uniform on a regular polygon with its corners on the unit circle; blades >= 3, the first corner
// at rotationRad from +x. For fewer blades the disk.
class Polygon {
public:
    Polygon(int blades, double rotationRad);
    Vec2 fromSquare(Vec2 u) const;
    int blades() const { return blades_; } // 0: the disk
    // Cosine and sine of each corner, the first one again at the end.
    const double* corners() const { return corners_.data(); }

private:
    int blades_;
    std::vector<double> corners_;
};

// Unit directions. The cone has its axis on +z and a half angle with the given cosine, in [-1,1];
// density 1 / (2 pi (1 - cosHalfAngle)) per steradian. Narrow cones: give the half angle by
// oneMinusCos = 1 - cos(halfAngle) = 2 sin^2(halfAngle/2), which does not cancel.
Vec3 coneFromSquare(Vec2 u, double oneMinusCos);
Vec3 sphereFromSquare(Vec2 u);           // density 1 / (4 pi)
Vec3 cosineHemisphereFromSquare(Vec2 u); // about +z, density cos / pi
// About +z with density (n+1)/(2 pi) cos^n: the half vector of a Blinn lobe, exponent n >= 0.
Vec3 cosinePowerFromSquare(Vec2 u, float exponent);

// Three perpendicular unit vectors, right-handed: x cross y = z (Duff et al. 2017, no branch).
struct Frame {
    Vec3 x, y, z;
    constexpr Vec3 toWorld(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
    constexpr Vec3 toLocal(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
};
Frame frameAround(Vec3 unitZ);
