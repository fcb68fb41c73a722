#include "camera/camera.h"

#include "sample/warp.h"

#include <utility>

Camera::Camera(CameraParams params)
    : params_(std::move(params)), atRest_(axesOf(params_.worldFromCamera.at(0))) {
    using Fit = CameraParams::SensorFit;
    const CameraParams& p = params_;
    const double sideX = p.width * p.pixelAspect.x, sideY = p.height * p.pixelAspect.y;
    const bool fitsX = p.sensorFit == Fit::Auto ? sideX > sideY : p.sensorFit == Fit::Horizontal;
    const double sensorMm = p.sensorFit == Fit::Vertical ? p.sensorHeightMm : p.sensorWidthMm;
    const double fitted = fitsX ? sideX : sideY;
    const double scale =
        p.kind == CameraParams::Kind::Perspective ? sensorMm / p.lensMm : p.orthoScale;
    topLeft_ = Vec2d{p.shiftX - 0.5 * sideX / fitted, p.shiftY + 0.5 * sideY / fitted} * scale;
    step_ = Vec2d{p.pixelAspect.x / fitted, p.pixelAspect.y / fitted} * scale;
}

Camera::Axes Camera::axesOf(const Transform& worldFromCamera) {
    return {normalize(worldFromCamera.column(0)), normalize(worldFromCamera.column(1)),
            -normalize(worldFromCamera.column(2)), worldFromCamera.translation()};
}

Ray Camera::ray(Vec2d pixel, Vec2 lens, float time) const {
    return isMoving() ? rayFrom(axesAt(time), pixel, lens, time)
                      : rayFrom(atRest_, pixel, lens, time);
}

Ray Camera::rayFrom(const Axes& axes, Vec2d pixel, Vec2 lens, float time) const {
    auto [org, dir] = lineFrom(axes, pixel);
    if (hasLens()) {
        // The depth of dir is 1 unless the camera's axes are skewed.
        const Vec3d sharp = org + dir * (params_.focusDistance / dot(dir, axes.forward));
        const Vec2 place =
            polygonFromSquare(lens, params_.apertureBlades, params_.apertureRotationRad);
        const double x = static_cast<double>(place.x) / params_.apertureRatio;
        const double y = static_cast<double>(place.y);
        org += (axes.right * x + axes.up * y) * params_.apertureRadius;
        // From the rounded origin, so that all rays of a pixel meet in the sharp plane.
        dir = sharp - toDouble(toFloat(org));
    }
    dir = normalize(dir);

    Ray ray;
    ray.org = toFloat(org);
    ray.dir = toFloat(dir);
    ray.tMin = clipDepth(dir, axes);
    ray.time = time;
    return ray;
}

void Camera::pinholeRays(std::span<const Vec2d> pixels, std::span<Vec3> dir,
                         std::span<float> tMin) const {
    const Axes axes = atRest_;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Vec3d d = normalize(lineFrom(axes, pixels[i]).dir);
        dir[i] = toFloat(d);
        tMin[i] = clipDepth(d, axes);
    }
}

Camera::View Camera::view(float time) const {
    const Axes axes = axesAt(time);
    return {axes.eye, axes.forward};
}
