#include "light/tree/light_tree.h"

#include "light/lights.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace {

double mean(Rgb c) {
    return (static_cast<double>(c.r) + static_cast<double>(c.g) + static_cast<double>(c.b)) / 3;
}

LightBounds bounds(const PointRow& row) {
    LightBounds out;
    out.cosSpread = -1, out.intensity = mean(row.intensity);
    const Vec3d a = toDouble(row.attenuation);
    if (a.y == 0 && a.z == 0 && a.x > 0) {
        out.box = Bounds{row.position, row.position}.padded(row.radius);
        out.intensity /= a.x;
    } else {
        out.isDistant = true, out.intensity /= a.x + a.y + a.z;
    }
    return out;
}

// Full light in the inner cone: that is the spread.
LightBounds bounds(const SpotRow& row) {
    LightBounds out = bounds(row.point);
    if (out.isDistant) return out;
    const auto edge = static_cast<double>(row.cosHalfAngle);
    out.axis = row.axis;
    out.cosSpread = min(edge + (1 - edge) * static_cast<double>(row.blend), 1.0);
    out.cosReach = exact::cos(exact::acos(edge) - exact::acos(out.cosSpread));
    // A cone wider than a half space, or a hard one, has no soft part that could be told from it.
    out.cosReach = min(out.cosReach, 1 - 1e-3);
    return out;
}

LightBounds bounds(const SunRow& row) {
    LightBounds out;
    out.axis = row.toSun, out.cosSpread = 1 - static_cast<double>(row.oneMinusCos);
    out.intensity = mean(row.irradiance), out.isDistant = true;
    return out;
}

LightBounds ofFlat(const FlatRow& row, double areaOfUnit) {
    LightBounds out;
    Vec3 half;
    for (std::size_t axis = 0; axis < 3; ++axis)
        half[axis] = std::fabs(row.halfX[axis]) + std::fabs(row.halfY[axis]);
    out.box = {row.centre - half, row.centre + half}, out.axis = row.normal;
    const Vec3d x = toDouble(row.halfX), y = toDouble(row.halfY);
    out.intensity = mean(row.radiance) * areaOfUnit * length(x) * length(y);
    if (row.spreadNorm > 0) {
        const auto tangent = static_cast<double>(row.tanSpread);
        out.intensity *= tangent * static_cast<double>(row.spreadNorm);
        out.cosReach = 1 / std::sqrt(1 + tangent * tangent);
    }
    return out;
}
LightBounds bounds(const RectangleRow& row) { return ofFlat(row, 4); }
LightBounds bounds(const DiskRow& row) { return ofFlat(row, kPi); }

LightBounds bounds(const SphereRow& row) {
    LightBounds out;
    out.box = Bounds{row.centre, row.centre}.padded(row.radius);
    out.cosSpread = -1;
    out.intensity = mean(row.radiance) * kPi * sqr(static_cast<double>(row.radius));
    return out;
}

LightBounds bounds(const TriangleRow& row) {
    LightBounds out;
    for (const Vec3 corner : {row.a, row.b, row.c}) out.box.extend(corner);
    const Vec3d across =
        cross(toDouble(row.b) - toDouble(row.a), toDouble(row.c) - toDouble(row.a));
    const double twice = length(across);
    if (twice > 0) out.axis = toFloat(across * (1 / twice));
    out.intensity = mean(row.radiance) * twice / 2;
    out.isTwoSided = row.isTwoSided > 0;
    return out;
}

} // namespace

LightBounds boundsOf(const LightRow& row) {
    LightBounds out;
    kernels::one::forLight(row.kind, [&]<class L>() {
        typename L::Row numbers;
        std::memcpy(static_cast<void*>(&numbers), row.numbers.data(), sizeof numbers);
        out = bounds(numbers);
    });
    return out;
}

LightBounds boundsOfSky(double irradiance) {
    LightBounds out;
    out.cosSpread = -1, out.intensity = irradiance, out.isDistant = true;
    return out;
}
