#include "camera/camera.h"

#include "sample/warp.h"

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
        const Vec2 place = aperture_.fromSquare(lens);
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

Camera::Lens Camera::lensAtRest() const {
    const CameraParams& p = params_;
    return {atRest_.right,   atRest_.up,  atRest_.forward,    atRest_.eye,
            topLeft_,        step_,       p.focusDistance,    p.apertureRadius,
            p.apertureRatio, p.clipStart, aperture_.blades(), aperture_.corners()};
}

std::optional<Camera::Lens> Camera::lens() const {
    if (params_.kind != CameraParams::Kind::Perspective || isMoving() || !hasLens()) return {};
    return lensAtRest();
}

std::optional<Camera::Lens> Camera::pinhole() const {
    if (!hasSharedOrigin()) return {};
    return lensAtRest();
}

// Two places at a time in registers of the compiler's, in the steps of lineFrom() and normalize().
void Camera::pinholeRays(std::span<const double> px, std::span<const double> py,
                         std::span<Vec3> dir, std::span<float> tMin) const {
    using Two __attribute__((vector_size(16))) = double;
    using Twice = Vec3T<Two>;
    const auto both = [](double a, double b) {
        const Two pair = {a, b};
        return pair;
    };
    const auto twice = [&](Vec3d v) {
        return Twice{both(v.x, v.x), both(v.y, v.y), both(v.z, v.z)};
    };
    const Axes axes = atRest_;
    const Twice right = twice(axes.right), up = twice(axes.up), forward = twice(axes.forward);
    std::size_t i = 0;
    for (; i + 2 <= px.size(); i += 2) {
        const Two x = both(px[i], px[i + 1]), y = both(py[i], py[i + 1]);
        const Twice across = right * (topLeft_.x + x * step_.x) + up * (topLeft_.y - y * step_.y);
        const Twice line = across + forward;
        const Two length2 = dot(line, line);
        const Twice d = line / both(std::sqrt(length2[0]), std::sqrt(length2[1]));
        // A division by what is positive would change no zero.
        const Two clip = params_.clipStart == 0 ? Two{} : params_.clipStart / dot(d, forward);
        for (std::size_t k = 0; k < 2; ++k) {
            dir[i + k] = toFloat({d.x[k], d.y[k], d.z[k]});
            tMin[i + k] = static_cast<float>(clip[k]);
        }
    }
    for (; i < px.size(); ++i) {
        const Vec3d d = normalize(lineFrom(axes, {px[i], py[i]}).dir);
        dir[i] = toFloat(d);
        tMin[i] = clipDepth(d, axes);
    }
}

Camera::View Camera::view(float time) const {
    const Axes axes = axesAt(time);
    return {axes.eye, axes.forward};
}
