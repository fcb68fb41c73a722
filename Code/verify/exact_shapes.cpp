#include "verify/exact_shapes.h"

#include <algorithm>
#include <utility>

namespace battery {

namespace {

using Kind = ObjectDesc::Kind;

bool isRound(Kind kind) {
    return kind == Kind::Sphere || kind == Kind::Cylinder || kind == Kind::Cone;
}
bool isWithin(Wide x, Wide limit) { return magnitude(x) <= limit; }
bool isInCircle(Vec3w p, Wide radius) { return p.x * p.x + p.y * p.y <= radius * radius; }

} // namespace

ExactShape::ExactShape(ObjectDesc object, const Transform& worldFromObject)
    : object_(std::move(object)) {
    const auto& m = worldFromObject.rows();
    const Vec3w rows[3] = {toWide(Vec3d{m[0], m[1], m[2]}), toWide(Vec3d{m[4], m[5], m[6]}),
                           toWide(Vec3d{m[8], m[9], m[10]})};
    for (std::size_t i = 0; i < 3; ++i) cofactors_[i] = cross(rows[(i + 1) % 3], rows[(i + 2) % 3]);
    determinant_ = dot(rows[0], cofactors_[0]);
    origin_ = toWide(Vec3d{m[3], m[7], m[11]});
}

// Of the cone; a cylinder is the one with equal ends.
Wide ExactShape::radiusAt(Wide z) const {
    const Wide bottom = object_.radius;
    if (object_.kind == Kind::Cylinder) return bottom;
    return bottom + (static_cast<Wide>(object_.topRadius) - bottom) / 2 * (z + 1);
}

// Is a point of one of the shape's surfaces, whose normal it is, one of the shape?
bool ExactShape::isInside(Vec3w p, Vec3w normal) const {
    const bool isFlat = normal.x == 0 && normal.y == 0;
    switch (object_.kind) {
    case Kind::Sphere:
    case Kind::InfinitePlane: return true;
    case Kind::Disk: return isInCircle(p, object_.radius);
    case Kind::Cylinder:
    case Kind::Cone: {
        if (!isFlat) return isWithin(p.z, 1);
        return object_.caps && isInCircle(p, radiusAt(normal.z));
    }
    case Kind::Cube:
        return (normal.x != 0 || isWithin(p.x, 1)) && (normal.y != 0 || isWithin(p.y, 1)) &&
               (normal.z != 0 || isWithin(p.z, 1));
    case Kind::Plane:
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec3w from = toWide((*object_.corners)[i]),
                        to = toWide((*object_.corners)[(i + 1) % 4]);
            if (dot(cross(to - from, p - from), normal) < 0) return false;
        }
        return true;
    case Kind::Mesh: break;
    }
    return false;
}

void ExactShape::addIfOn(Wide t, Vec3w p, Vec3w normal, std::vector<ExactHit>& found) const {
    if (!(t > 0) || !isInside(p, normal)) return;
    Vec3w world; // by the inverse transpose, which is the cofactors over the determinant
    for (std::size_t i = 0; i < 3; ++i) world[i] = dot(cofactors_[i], normal) / determinant_;
    found.push_back({t, world});
}

void ExactShape::meetPlane(const Line& line, Vec3w point, Vec3w normal,
                           std::vector<ExactHit>& found) const {
    const Wide slope = dot(normal, line.dir);
    if (slope == 0) return;
    const Wide t = dot(normal, point - line.org) / slope;
    addIfOn(t, line.at(t), normal, found);
}

// a t^2 + 2 b t + c = 0 of x^2 + y^2 (+ z^2) = radius(z)^2.
void ExactShape::meetRound(const Line& line, std::vector<ExactHit>& found) const {
    const Vec3w o = line.org, d = line.dir;
    const bool isSphere = object_.kind == Kind::Sphere;
    const Wide w = isSphere ? static_cast<Wide>(object_.radius) : radiusAt(o.z);
    const Wide slope = isSphere ? static_cast<Wide>(0) : radiusAt(1) - radiusAt(0);
    const Wide dw = slope * d.z;
    Wide a = d.x * d.x + d.y * d.y - dw * dw, b = o.x * d.x + o.y * d.y - w * dw,
         c = o.x * o.x + o.y * o.y - w * w;
    if (isSphere) a += d.z * d.z, b += o.z * d.z, c += o.z * o.z;
    const auto add = [&](Wide t) {
        const Vec3w p = line.at(t);
        addIfOn(t, p, {p.x, p.y, isSphere ? p.z : -slope * radiusAt(p.z)}, found);
    };
    if (a == 0) {
        if (b != 0) add(-c / (2 * b));
        return;
    }
    const Wide discriminant = b * b - a * c;
    if (discriminant < 0) return;
    const Wide root = squareRoot(discriminant), q = b < 0 ? root - b : -(root + b);
    add(q / a);
    if (q != 0) add(c / q);
}

std::vector<ExactHit> ExactShape::hits(const Ray& ray) const {
    const Vec3w org = toWide(ray.org) - origin_, dir = toWide(ray.dir);
    Line line;
    for (std::size_t i = 0; i < 3; ++i) { // by the transpose of the cofactors
        const Vec3w column{cofactors_[0][i], cofactors_[1][i], cofactors_[2][i]};
        line.org[i] = dot(column, org) / determinant_;
        line.dir[i] = dot(column, dir) / determinant_;
    }
    std::vector<ExactHit> found;
    if (isRound(object_.kind)) meetRound(line, found);
    const bool hasEnds = object_.kind == Kind::Cylinder || object_.kind == Kind::Cone;
    for (std::size_t axis = object_.kind == Kind::Cube ? 0 : 2; axis < 3; ++axis) {
        if (object_.kind != Kind::Cube && !hasEnds) break;
        for (const int side : {-1, 1}) {
            Vec3w normal;
            normal[axis] = side;
            meetPlane(line, normal, normal, found);
        }
    }
    if (object_.kind == Kind::Disk || object_.kind == Kind::InfinitePlane)
        meetPlane(line, {}, {0, 0, 1}, found);
    if (object_.kind == Kind::Plane) {
        Vec3w c[4];
        for (std::size_t i = 0; i < 4; ++i) c[i] = toWide((*object_.corners)[i]);
        meetPlane(line, c[0], cross(c[2] - c[0], c[3] - c[1]), found);
    }
    std::sort(found.begin(), found.end(),
              [](const ExactHit& a, const ExactHit& b) { return a.t < b.t; });
    return found;
}

} // namespace battery
