#include "scene/frame.h"

#include "desc/validate.h"

#include <cmath>

static double powerOfTwoFor(double extent) {
    return extent > 0 ? std::ldexp(1.0, -std::ilogb(extent)) : 1;
}

SceneFrame frameAround(const BoundsD& box) {
    if (box.isEmpty() || !box.isFinite()) return {};
    return {box.centre(), powerOfTwoFor(maxAbs(box.size()))};
}

Transform SceneFrame::placed(const Rows& worldFromObject) const {
    Rows rows = worldFromObject;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column) rows[4 * row + column] *= scale;
        rows[4 * row + 3] = (rows[4 * row + 3] - centre[row]) * scale;
    }
    return Transform::fromRows(rows);
}

static BoundsD lightsAndCameras(const SceneDesc& desc) {
    BoundsD box;
    for (const CameraDesc& camera : desc.cameras)
        for (const Rows& key : camera.worldFromCamera) box.extend(Vec3d{key[3], key[7], key[11]});
    for (const LightDesc& light : desc.lights)
        box.extend(Transform::fromRows(light.worldFromLight).translation());
    return box;
}

SceneFrame frameOf(const SceneDesc& desc, const CameraDesc& camera, int threads) {
    constexpr double kFarTimes = 8, kMostTimes = 2 * kFarTimes, kDistantTimes = 0x1p16;
    const Rows& key = camera.worldFromCamera[camera.worldFromCamera.size() / 2];
    const Vec3d eye{key[3], key[7], key[11]};
    // Parallel rays see nothing larger for being near.
    const double least = camera.kind == CameraDesc::Kind::Orthographic ? camera.orthoScale : 0;
    const NearBounds bounds = boundsNear(desc, eye, kFarTimes, least, threads);
    if (bounds.near.isEmpty()) return frameAround(lightsAndCameras(desc));
    const double extent = maxAbs(bounds.near.size());
    SceneFrame frame = frameAround(bounds.near);
    if (extent > kMostTimes * bounds.nearest && bounds.nearest > 0)
        frame = {eye, powerOfTwoFor(kMostTimes * bounds.nearest)};
    // Coordinates and their squares are to stay floats.
    const double farthest =
        max(maxAbs(bounds.all.lo - frame.centre), maxAbs(bounds.all.hi - frame.centre));
    frame.scale = min(frame.scale, powerOfTwoFor(farthest) * 0x1p80);
    const double distantFrom = kDistantTimes * max(bounds.nearest * frame.scale, 1.0);
    if (farthest * frame.scale > distantFrom) frame.distantFrom = static_cast<float>(distantFrom);
    return frame;
}

SceneFrame frameOf(const MeshDesc& mesh) { return frameAround(boundsOf(mesh)); }
