// Where a line meets a shape with a formula, in 113 bits: every surface of the shape is met on its
// own and the points that are not on the shape are thrown away. The shapes themselves cut intervals
// out of the line, so the two have nothing in common but the definition in scene_desc.h.
#pragma once

#include "base/ray.h"
#include "base/transform.h"
#include "desc/scene_desc.h"
#include "verify/binary128.h"

#include <vector>

namespace battery {

struct ExactHit {
    Wide t = 0;
    Vec3w normal; // outward, of any length; in the world
};

class ExactShape {
public:
    // Any kind but Mesh, with the map as its numbers say.
    ExactShape(ObjectDesc object, const Transform& worldFromObject);

    // All hits with t > 0, nearest first. The ray's floats are taken as exact.
    std::vector<ExactHit> hits(const Ray& ray) const;

private:
    struct Line {
        Vec3w org, dir;
        Vec3w at(Wide t) const { return org + dir * t; }
    };
    void meetPlane(const Line& line, Vec3w point, Vec3w normal, std::vector<ExactHit>& found) const;
    void meetRound(const Line& line, std::vector<ExactHit>& found) const;
    void addIfOn(Wide t, Vec3w p, Vec3w normal, std::vector<ExactHit>& found) const;
    Wide radiusAt(Wide z) const;
    bool isInside(Vec3w p, Vec3w normal) const;

    ObjectDesc object_;
    Vec3w cofactors_[3]; // rows of the cofactor matrix
    Vec3w origin_;
    Wide determinant_ = 1;
};

} // namespace battery
