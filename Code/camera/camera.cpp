#include "camera/camera.h"

#include "camera/camera_in_lanes.h"

#include <cmath>
#include <utility>

Camera::Camera(CameraParams params)
    : params_(std::move(params)), aperture_(params_.apertureBlades, params_.apertureRotationRad),
      atRest_(axesOf(params_.worldFromCamera.at(0))) {
    using Fit = CameraParams::SensorFit;
    const CameraParams& p = params_;
    const double sideX = p.width * p.pixelAspect.x, sideY = p.height * p.pixelAspect.y;
    const bool fitsX = p.sensorFit == Fit::Auto ? sideX > sideY : p.sensorFit == Fit::Horizontal;
    const double sensorMm = p.sensorFit == Fit::Vertical ? p.sensorHeightMm : p.sensorWidthMm;
    const double fitted = fitsX ? sideX : sideY;
    const double scale =
        p.kind == CameraParams::Kind::Perspective ? sensorMm / p.lensMm : p.orthoScale;
    optics_ = {p.kind == CameraParams::Kind::Perspective,
               p.apertureRadius > 0,
               Vec2d{p.shiftX - 0.5 * sideX / fitted, p.shiftY + 0.5 * sideY / fitted} * scale,
               Vec2d{p.pixelAspect.x / fitted, p.pixelAspect.y / fitted} * scale,
               p.focusDistance,
               p.apertureRadius,
               p.apertureRatio,
               p.clipStart,
               aperture_.blades(),
               nullptr};
}

Camera::Optics Camera::optics() const {
    Optics out = optics_;
    out.corners = aperture_.corners();
    return out;
}

Camera::Axes Camera::axesOf(const Transform& worldFromCamera) {
    return {normalize(worldFromCamera.column(0)), normalize(worldFromCamera.column(1)),
            -normalize(worldFromCamera.column(2)), worldFromCamera.translation()};
}

Ray Camera::ray(Vec2d pixel, Vec2 lens, float time) const {
    using namespace kernels::one;
    const CameraRayLanes one =
        raysThrough(optics(), forAll(axesAt(time)), pixel.x, pixel.y, lens.x, lens.y);
    Ray ray;
    ray.org = {one.org.x.v, one.org.y.v, one.org.z.v};
    ray.dir = {one.dir.x.v, one.dir.y.v, one.dir.z.v};
    ray.tMin = one.tMin.v;
    ray.time = time;
    return ray;
}

RayCone Camera::cone(Vec3 dir, float time) const {
    const double side = std::sqrt(std::fabs(optics_.step.x * optics_.step.y));
    if (!optics_.isPerspective) return {static_cast<float>(side), 0};
    // A pixel is farther away and seen askew.
    const double cosine = dot(toDouble(dir), axesAt(time).forward);
    return {0, static_cast<float>(side * cosine * cosine)};
}

Camera::Line Camera::line(Vec2d pixel) const {
    using namespace kernels::one;
    const CameraLines one = linesThrough(optics_, forAll(atRest_), pixel.x, pixel.y);
    return {{one.org.x.v, one.org.y.v, one.org.z.v}, {one.dir.x.v, one.dir.y.v, one.dir.z.v}};
}
