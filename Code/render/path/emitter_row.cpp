#include "render/path/emitter_row.h"

#include "base/math.h"
#include "light/kinds/disk.h"
#include "light/kinds/rectangle.h"
#include "light/kinds/sphere.h"
#include "render/to_float.h"

namespace {

// Whether a map turns, shifts and has one scale, to a millionth.
bool keepsForm(const Vec3d& x, const Vec3d& y, const Vec3d& z) {
    const double most = dot(x, x) * 1e-6;
    const auto areAlike = [&](const Vec3d& a, const Vec3d& b) {
        return std::fabs(dot(a, b)) <= most && std::fabs(dot(b, b) - dot(a, a)) <= most;
    };
    return areAlike(x, y) && areAlike(y, z) && areAlike(x, z);
}

} // namespace

std::optional<LightRow> makeEmitterRow(const ObjectDesc& desc, const Transform& place, Rgb radiance,
                                       bool back) {
    const Vec3d x = place.vector({1, 0, 0}), y = place.vector({0, 1, 0}),
                z = place.vector({0, 0, 1});
    if (desc.kind == ObjectDesc::Kind::Sphere && keepsForm(x, y, z) && !back)
        return lightRow(
            SphereRow{toFloat(place.point({})), toFloat(desc.radius * length(x)), radiance});
    const auto flat = [&](auto row, const Vec3d& centre, const Vec3d& halfX, const Vec3d& halfY) {
        static_cast<FlatRow&>(row) = {toFloat(centre), toFloat(halfX), toFloat(halfY),
                                      toFloat(normalize(cross(halfX, halfY)) * (back ? -1.0 : 1.0)),
                                      radiance};
        return lightRow(row);
    };
    const auto arePerpendicular = [](const Vec3d& a, const Vec3d& b) {
        return std::fabs(dot(a, b)) <= 1e-6 * length(a) * length(b);
    };
    if (desc.kind == ObjectDesc::Kind::Disk && arePerpendicular(x, y))
        return flat(DiskRow{}, place.point({}), x * desc.radius, y * desc.radius);
    if (desc.kind == ObjectDesc::Kind::Plane) {
        const auto& corners = *desc.corners;
        const Vec3d a = place.point(corners[0]), b = place.point(corners[1]),
                    c = place.point(corners[2]), d = place.point(corners[3]);
        const Vec3d off = (a + c) - (b + d); // 0 of a parallelogram
        if (length(off) <= 1e-6 * length(b - a) && arePerpendicular(b - a, d - a))
            return flat(RectangleRow{}, (a + c) * 0.5, (b - a) * 0.5, (d - a) * 0.5);
    }
    return {};
}
