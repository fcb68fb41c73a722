#include "verify/scene_trials.h"

#include "scene/scene.h"
#include "sample/hash.h"

#include <algorithm>
#include <bit>

namespace scenes {

SceneDesc scaled(SceneDesc desc, double factor) {
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
        if (l.attenuation == Vec3d{1, 0, 0})
            l.color = {l.color.r * f2, l.color.g * f2, l.color.b * f2};
        else // color / (x d^2 + y d + z)
            l.attenuation = {l.attenuation.x / f2, l.attenuation.y / factor, l.attenuation.z};
    }
    for (MaterialDesc& m : desc.materials) m.bumpDistance *= factor;
    return desc;
}

SceneDesc moved(SceneDesc desc, Vec3d by) {
    const auto move = [&](Rows& rows) { rows[3] += by.x, rows[7] += by.y, rows[11] += by.z; };
    for (CameraDesc& c : desc.cameras)
        for (Rows& rows : c.worldFromCamera) move(rows);
    for (ObjectDesc& o : desc.objects) {
        if (o.kind == ObjectDesc::Kind::Mesh && o.worldFromObject == Keys{kIdentityRows})
            for (Vec3d& point : desc.meshes[static_cast<std::size_t>(o.mesh)].points) point += by;
        else
            for (Rows& rows : o.worldFromObject) move(rows);
    }
    for (LightDesc& l : desc.lights) move(l.worldFromLight);
    return desc;
}

Picture render(const SceneDesc& desc, Tweak tweak) {
    RenderSettings settings;
    settings.picture = desc.settings;
    if (tweak) tweak(settings);
    const Scene scene(desc, {"scene", ""}, settings);
    Stats stats;
    return ::render(scene, settings, {}, stats);
}

std::uint64_t hashOf(const Picture& picture) {
    std::uint64_t sum = 0;
    const auto add = [&](const Image& image) {
        for (const Rgb& p : image.pixels())
            for (const float value : {p.r, p.g, p.b})
                sum = mixBits(sum ^ (kHashStep + std::bit_cast<std::uint32_t>(value)));
    };
    add(picture.color);
    for (const AovImage& aov : picture.aovs) add(aov.image);
    return sum;
}

double largest(const Image& image) {
    float out = 0;
    for (const Rgb& p : image.pixels()) out = std::max({out, p.r, p.g, p.b});
    return out;
}

} // namespace scenes
