#include "render/frame.h"

#include "base/motion.h"

#include <cmath>
#include <vector>

namespace {

BoundsD objectBox(const ObjectDesc& object, const std::vector<BoundsD>& meshBoxes) {
    const double r = object.radius;
    switch (object.kind) {
    case ObjectDesc::Kind::Sphere: return {{-r, -r, -r}, {r, r, r}};
    case ObjectDesc::Kind::Cube: return {{-1, -1, -1}, {1, 1, 1}};
    case ObjectDesc::Kind::Disk: return {{-r, -r, 0}, {r, r, 0}};
    case ObjectDesc::Kind::Cylinder: return {{-r, -r, -1}, {r, r, 1}};
    case ObjectDesc::Kind::Cone: {
        const double wide = max(r, object.topRadius);
        return {{-wide, -wide, -1}, {wide, wide, 1}};
    }
    case ObjectDesc::Kind::Plane: {
        BoundsD box;
        for (const Vec3d corner : object.corners) box.extend(corner);
        return box;
    }
    case ObjectDesc::Kind::Mesh: return meshBoxes[static_cast<std::size_t>(object.mesh)];
    case ObjectDesc::Kind::InfinitePlane: break;
    }
    return {};
}

BoundsD boxOf(const MeshDesc& mesh) {
    BoundsD box;
    for (const Vec3d p : mesh.points) box.extend(p);
    return box;
}

SceneFrame frameOf(const BoundsD& box) {
    if (box.isEmpty() || !box.isFinite()) return {};
    SceneFrame frame;
    frame.centre = box.centre();
    const double extent = maxAbs(box.size());
    if (extent > 0) frame.scale = std::ldexp(1.0, -std::ilogb(extent));
    return frame;
}

} // namespace

Transform SceneFrame::placed(const Rows& worldFromObject) const {
    Rows rows = worldFromObject;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column) rows[4 * row + column] *= scale;
        rows[4 * row + 3] = (rows[4 * row + 3] - centre[row]) * scale;
    }
    return Transform::fromRows(rows);
}

SceneFrame frameOf(const SceneDesc& desc) {
    std::vector<BoundsD> meshBoxes;
    for (const MeshDesc& mesh : desc.meshes) meshBoxes.push_back(boxOf(mesh));
    BoundsD box;
    for (const ObjectDesc& object : desc.objects) {
        const BoundsD local = objectBox(object, meshBoxes);
        if (local.isEmpty()) continue;
        for (const Rows& key : object.worldFromObject)
            box.extend(Transform::fromRows(key).bounds(local));
    }
    if (box.isEmpty()) {
        for (const CameraDesc& camera : desc.cameras)
            for (const Rows& key : camera.worldFromCamera)
                box.extend(Vec3d{key[3], key[7], key[11]});
        for (const LightDesc& light : desc.lights)
            box.extend(Transform::fromRows(light.worldFromLight).translation());
    }
    return frameOf(box);
}

SceneFrame frameOf(const MeshDesc& mesh) { return frameOf(boxOf(mesh)); }
