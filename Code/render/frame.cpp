#include "render/frame.h"

#include "desc/scene_bounds.h"

#include <cmath>

namespace {

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

SceneFrame frameOf(const SceneDesc& desc, int threads) {
    BoundsD box = boundsOf(desc, threads);
    if (box.isEmpty()) {
        for (const CameraDesc& camera : desc.cameras)
            for (const Rows& key : camera.worldFromCamera)
                box.extend(Vec3d{key[3], key[7], key[11]});
        for (const LightDesc& light : desc.lights)
            box.extend(Transform::fromRows(light.worldFromLight).translation());
    }
    return frameOf(box);
}

SceneFrame frameOf(const MeshDesc& mesh) { return frameOf(boundsOf(mesh)); }
