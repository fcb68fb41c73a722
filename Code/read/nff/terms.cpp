#include "read/nff/terms.h"

#include "base/math.h"
#include "base/transform.h"

#include <algorithm>
#include <cmath>

namespace {

Vec3d unit(Vec3d v) { return normalize(v / maxAbs(v)); } // squares neither over- nor underflow
Rgbd scaled(Rgbd c, double s) { return {c.r * s, c.g * s, c.b * s}; }
Rgbd grey(double value) { return {value, value, value}; }

constexpr double kCountedOnly = 1e-12; // of the light

// -1 to 1 along z becomes `from` to `to`; x and y keep their length.
Rows axisRows(Vec3d from, Vec3d to) {
    const Vec3d half = to * 0.5 - from * 0.5, middle = to * 0.5 + from * 0.5, z = unit(half);
    const double ax = std::fabs(z.x), ay = std::fabs(z.y), az = std::fabs(z.z);
    // Of the axes the one that is farthest from z, so that the cross product is not small.
    const Vec3d other = ax <= ay && ax <= az ? Vec3d{1, 0, 0}
                        : ay <= az           ? Vec3d{0, 1, 0}
                                             : Vec3d{0, 0, 1};
    const Vec3d x = unit(cross(other, z)), y = cross(z, x);
    return {x.x, y.x, half.x, middle.x, x.y, y.y, half.y, middle.y, x.z, y.z, half.z, middle.z};
}

} // namespace

double nffIntensity(std::size_t lightCount) {
    const auto n = static_cast<double>(lightCount);
    return lightCount == 0 ? 0 : std::sqrt(n) / (2 * n);
}

// The standard adds per light intensity * (Kd * color * cos + Ks * cosR^Shine), without a 1/pi and
// without fall-off; our diffuse term has the 1/pi, and a light is pi times as strong (nffLight).
MaterialDesc nffMaterial(const NffFill& fill) {
    MaterialDesc material;
    material.diffuse = scaled(fill.color, fill.diffuse);
    material.specular = grey(fill.specular * kInvPi);
    material.specularModel = MaterialDesc::SpecularModel::Phong;
    material.exponent = fill.shine;
    material.mirror = grey(fill.specular);
    // "All rays hitting only reflective and transmitting objects spawn reflection rays": what
    // transmits does so without Ks too. They add less than a float has digits for, and are counted.
    if (fill.transmittance > 0) material.mirror = grey(std::max(fill.specular, kCountedOnly));
    material.transmission = grey(fill.transmittance);
    material.ior = fill.ior > 0 ? fill.ior : 1;
    return material;
}

LightDesc nffLight(Vec3d position, Rgbd intensity) {
    LightDesc light;
    light.worldFromLight = Transform::translate(position).rows();
    light.color = scaled(intensity, kPi);
    light.attenuation = {0, 0, 1};
    return light;
}

CameraDesc nffCamera(const NffView& view, bool angleToEdges) {
    CameraDesc camera;
    camera.worldFromCamera = {Transform::lookAt(view.from, view.at, view.up).rows()};
    double halfHeight = exact::tan(radians(view.angleDeg) / 2);
    // "From the center of top pixel row to bottom pixel row": h rows have h - 1 steps between them.
    if (!angleToEdges && view.height > 1) halfHeight *= view.height / (view.height - 1.0);
    camera.sensorFit = CameraDesc::SensorFit::Vertical;
    camera.lensMm = camera.sensorHeightMm / (2 * halfHeight);
    return camera;
}

bool isAlong(Vec3d a, Vec3d b) {
    return maxAbs(a) == 0 || maxAbs(b) == 0 || !(length(cross(unit(a), unit(b))) > 1e-10);
}

std::optional<ObjectDesc> nffCone(Vec3d base, double baseRadius, Vec3d apex, double apexRadius) {
    if (maxAbs(apex - base) == 0 || (baseRadius == 0 && apexRadius == 0)) return {};
    ObjectDesc object;
    object.kind = baseRadius == apexRadius ? ObjectDesc::Kind::Cylinder : ObjectDesc::Kind::Cone;
    object.worldFromObject = {axisRows(base, apex)};
    object.radius = baseRadius;
    if (object.kind == ObjectDesc::Kind::Cone) object.topRadius = apexRadius;
    object.caps = false;
    return object;
}

ObjectDesc::Sides nffSides(const NffFill& fill, bool insideOnly) {
    return insideOnly && !(fill.transmittance > 0) ? ObjectDesc::Sides::Back
                                                   : ObjectDesc::Sides::Both;
}

// Newell's normal, which has twice the area as its length, against the size of the polygon. The
// bound is what rounding makes of points on a line.
bool hasArea(std::span<const Vec3d> corners) {
    Vec3d normal{};
    double size = 0;
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        const Vec3d a = corners[i] - corners[0], b = corners[i + 1] - corners[0];
        normal = normal + cross(a, b);
        size = max(size, max(maxAbs(a), maxAbs(b)));
    }
    return length(normal) > 1e-14 * size * size;
}
