#include "verify/specimens.h"

#include "base/math.h"
#include "base/text.h"
#include "desc/enum_tables.h"
#include "scene/make_shape.h"
#include "verify/shape_kinds.h"

#include <array>

namespace battery {

using meshes::Random;
using Kind = ObjectDesc::Kind;
using kit::onCircle;

namespace {

constexpr std::uint32_t kOneMaterial[] = {0};

Vec3d inCircle(Random& random, double radius, double z) {
    return onCircle(random, radius * std::sqrt(random.unit()), z);
}

std::string numbersOf(Vec3d v) {
    return cat(shortest(v.x), " ", shortest(v.y), " ", shortest(v.z));
}

} // namespace

Specimen::Specimen(const ObjectDesc& what, const Transform& worldFromObject)
    : object(what), place(worldFromObject), shape(makeShape(what, place, kOneMaterial, 0)),
      exact(what, worldFromObject) {}

Vec3d Specimen::surfacePoint(Random& random, double nearest) const {
    const double r = object.radius;
    switch (object.kind) {
    case Kind::Sphere: return place.point(random.direction() * r);
    case Kind::Cube: {
        Vec3d p = random.inBox(1);
        p[random.below(3)] = random.chance(0.5) ? 1 : -1;
        return place.point(p);
    }
    case Kind::Disk: return place.point(inCircle(random, r, 0));
    case Kind::InfinitePlane: return place.point(onCircle(random, random.uniform(0, 3), 0));
    case Kind::Plane: {
        const auto& c = *object.corners;
        const double u = random.unit();
        const Vec3d from = lerp(c[0], c[1], u), to = lerp(c[3], c[2], u);
        return place.point(lerp(from, to, random.unit()));
    }
    case Kind::Cylinder:
    case Kind::Cone: {
        const double top = object.kind == Kind::Cone ? object.topRadius : r;
        const bool atTop = top >= nearest && random.chance(0.5);
        if (object.caps && random.chance(0.3))
            return place.point(atTop ? inCircle(random, top, 1) : inCircle(random, r, -1));
        const bool nearTip = object.kind == Kind::Cone && random.chance(0.5);
        const double fromTop =
            nearTip ? random.logUniform(min(nearest, 1.0), 2) : random.uniform(0, 2);
        return place.point(onCircle(random, top + (r - top) * fromTop / 2, 1 - fromTop));
    }
    case Kind::Mesh: break;
    }
    return {};
}

bool Specimen::isNearTip(const Ray& ray, Wide t, double nearest) const {
    if (object.kind != Kind::Cone) return false;
    const Vec3d p = place.inverse().point(toDouble(toWide(ray.org) + toWide(ray.dir) * t));
    return p.x * p.x + p.y * p.y < sqr(nearest * object.radius);
}

std::string Specimen::text() const {
    std::string rows;
    for (const double x : place.rows()) rows += " " + shortest(x);
    return cat(nameOf(object.kind), " radii ", shortest(object.radius), " ",
               shortest(object.topRadius), object.caps ? "" : " open", " at", rows);
}

ObjectDesc someShape(Random& random) {
    constexpr std::array kKinds = {Kind::Sphere, Kind::Cube,     Kind::Plane, Kind::InfinitePlane,
                                   Kind::Disk,   Kind::Cylinder, Kind::Cone,  Kind::Cone};
    ObjectDesc object;
    object.kind = kKinds[random.below(kKinds.size())];
    object.caps = random.chance(0.7);
    // Slim to flat; the top from a tip to nearly as wide as the base.
    if (object.kind == Kind::Cone) object.radius = random.logUniform(0.1, 10);
    if (object.kind == Kind::Cone && random.chance(0.5))
        object.topRadius = object.radius * random.logUniform(1e-6, 0.99);
    if (object.kind == Kind::Plane)
        object.corners = {Vec3d{-1, -1, 0.25}, Vec3d{1, -0.5, 0.25}, Vec3d{0.75, 1, 0.25},
                          Vec3d{-0.5, 0.75, 0.25}};
    return object;
}

Transform somePlace(Random& random, double size, Vec3d centre) {
    const std::uint32_t form = random.below(3);
    Vec3d factors{size, size, size};
    for (std::size_t i = 0; i < 3 && form == 2; ++i)
        factors[i] *= random.logUniform(0.25, 4) * (random.chance(0.25) ? -1 : 1);
    Transform place = Transform::scale(factors);
    const Vec3d axis = random.direction(), otherAxis = random.direction();
    const double angle = random.uniform(0, kTwoPi), otherAngle = random.uniform(0, kTwoPi);
    if (form > 0)
        place = Transform::rotate(axis, angle) * place * Transform::rotate(otherAxis, otherAngle);
    return Transform::translate(centre) * place;
}

std::string textOf(const Ray& ray) {
    return cat("from ", numbersOf(toDouble(ray.org)), " along ", numbersOf(toDouble(ray.dir)));
}

} // namespace battery
