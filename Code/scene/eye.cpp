#include "scene/eye.h"

double clearDepth(const ShapeSet& shapes, const Camera& camera) {
    if (!camera.hasSharedOrigin()) return 0;
    const Vec3 eye = camera.ray({0, 0}, {0.5f, 0.5f}, 0).org;
    // Some roundings of a coordinate. A plane that is as near as that crosses one of three lines.
    const float reach = 0x1p-20f * max(1.0f, maxAbs(eye));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        Vec3 along;
        along[axis] = 1;
        const Ray probe{eye - along * reach, along, 0, 2 * reach, 0};
        if (shapes.closest(probe).isHit()) return 4 * static_cast<double>(reach);
    }
    return 0;
}

std::optional<double> spacingInPixels(const ShapeSet& shapes, const Camera& camera, int width,
                                      int height) {
    const Vec2d middle{width / 2.0, height / 2.0};
    const Ray ray = camera.ray(middle, {0.5f, 0.5f}, 0.5f);
    const Hit hit = shapes.closest(ray);
    if (!hit.isHit()) return {};
    const double t = static_cast<double>(hit.t);
    // In double: beside each other, two rays of a long lens are the same floats.
    const auto placeAt = [&](Vec2d pixel) {
        const Camera::Line line = camera.line(pixel);
        return line.org + normalize(line.dir) * t;
    };
    const Vec3d target = placeAt(middle);
    const double pixel = length(placeAt({middle.x + 1, middle.y}) - target);
    return pixel > 0 ? maxAbs(target) * 0x1p-23 / pixel : kInfinity;
}
