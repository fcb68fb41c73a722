#include "read/json/plane.h"

#include <cmath>

namespace {

Rows fromColumns(Vec3d x, Vec3d y, Vec3d z, Vec3d origin) {
    return {x.x, y.x, z.x, origin.x, x.y, y.y, z.y, origin.y, x.z, y.z, z.z, origin.z};
}

} // namespace

Rows planeRows(Vec3d point, Vec3d normal) {
    // For a floor +X is x; for a wall it is horizontal, so that +Y is up.
    const bool isFloor = std::fabs(normal.y) > 0.5;
    const Vec3d x =
        normalize(isFloor ? Vec3d{1, 0, 0} - normal * normal.x : cross(Vec3d{0, 1, 0}, normal));
    return fromColumns(x, cross(normal, x), normal, point);
}

// Below, the shear would stretch by more than 1e6, and float could not tell the squares apart.
bool isVerticalPlane(Vec3d normal) { return std::fabs(normal.y) < 1e-6; }

Rows checkerboardRows(Vec3d point, Vec3d normal) {
    const double alongX = -normal.x / normal.y, alongZ = -normal.z / normal.y;
    const double height = dot(normal, point) / normal.y;
    // The cross product of X and Y is -normal / normal.y: for a floor the map mirrors, and still
    // takes the normal +Z to `normal`, as normals go by the inverse transpose.
    return fromColumns({1, alongX, 0}, {0, alongZ, 1}, normal, {0, height, 0});
}
