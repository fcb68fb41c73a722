// Maps of one place or direction: what warps.h has for lanes, at one lane.
#pragma once

#include "base/vec.h"

#include <vector>

// Uniform on the unit disk, concentric: square rings become circles.
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

// Unit vector about +z, density cos / pi per steradian.
Vec3 cosineHemisphereFromSquare(Vec2 u);

// Three perpendicular unit vectors, right-handed: x cross y = z.
struct Frame {
    Vec3 x, y, z;
    constexpr Vec3 toWorld(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
    constexpr Vec3 toLocal(Vec3 v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
};
Frame frameAround(Vec3 unitZ);
