// The same scene at another size or place, made from its description.
#pragma once

#include "desc/scene_desc.h"

namespace placed {

// All lengths times `factor`; intensities so that the light stays the same.
inline SceneDesc scaled(SceneDesc desc, double factor) {
    const auto scale = [&](Rows& rows) {
        for (double& number : rows) number *= factor;
    };
    for (CameraDesc& c : desc.cameras) {
        for (Rows& rows : c.worldFromCamera) scale(rows); // scale in it is ignored
        c.orthoScale *= factor;
        c.clipStart *= factor;
        c.apertureRadius *= factor;
        c.focusDistance *= factor;
    }
    for (ObjectDesc& o : desc.objects)
        for (Rows& rows : o.worldFromObject) scale(rows);
    for (LightDesc& l : desc.lights) {
        scale(l.worldFromLight); // with it the sizes of rectangles, disks and spheres
        if (l.kind != LightDesc::Kind::Point && l.kind != LightDesc::Kind::Spot) continue;
        l.radius *= factor;
        const double f2 = factor * factor;
        l.color = {l.color.r * f2, l.color.g * f2, l.color.b * f2};
    }
    for (MaterialDesc& m : desc.materials) m.bumpDistance *= factor;
    return desc;
}

inline SceneDesc moved(SceneDesc desc, Vec3d by) {
    const auto move = [&](Rows& rows) { rows[3] += by.x, rows[7] += by.y, rows[11] += by.z; };
    for (CameraDesc& c : desc.cameras)
        for (Rows& rows : c.worldFromCamera) move(rows);
    for (ObjectDesc& o : desc.objects)
        for (Rows& rows : o.worldFromObject) move(rows);
    for (LightDesc& l : desc.lights) move(l.worldFromLight);
    return desc;
}

} // namespace placed
