
#include "light/point_light.h"
#include "base/math.h"
#include "light/log_ratio.h"
#include "sample/warp.h"

float SpotCone::attenuation(Vec3 fromLight) const {
    const float c = dot(axis, fromLight);
    if (c <= cosHalfAngle) return 0;
    const float soft = (1 - cosHalfAngle) * blend;
    const float x = soft > 0 ? min((c - cosHalfAngle) / soft, 1.0f) : 1.0f;
    const float smooth = x * x * (3 - 2 * x);
    return cosineFalloff ? smooth * max(c, 0.0f) : smooth;
}

PointLight::PointLight(Vec3 position, Rgb intensity, Attenuation attenuation, float radius,
                       std::optional<SpotCone> cone, bool castsShadows)
    : Light(castsShadows, intensity), position_(position), intensity_(intensity),
      attenuation_(attenuation), radius_(radius), cone_(cone) {}

LightSample PointLight::sample(Vec3 point, Vec2 u) const {
    const Vec3 toCentre = position_ - point;
    if (radius_ == 0 || !(dot(toCentre, toCentre) > 0)) return centre(point);
    const Frame frame = frameAround(normalize(toCentre));
    const Vec2 disk = diskFromSquare(u) * radius_;
    const Vec3 d = toCentre + frame.x * disk.x + frame.y * disk.y;
    const float distance2 = dot(d, d), distance = std::sqrt(distance2);
    const Vec3 toLight = d / distance;
    const float cosAtDisk = dot(toLight, frame.z);
    const float cone = cone_ ? cone_->attenuation(-toLight) : 1.0f;
    return {toLight, distance,
            intensity_ * (cone * cosAtDisk / attenuation_.at(distance, distance2))};
}

bool PointLight::cannotReach(Vec3 point, Vec3 n) const {
    const Vec3 d = position_ - point;
    const float distance2 = dot(d, d);
    // Squares, as roots cost more; the disk about the centre lies within its radius.
    const float behind = -dot(n, d) - radius_;
    if (behind > 0 && behind * behind > sqr(kHorizonSlack) * distance2) return true;
    if (!cone_ || radius_ > 0) return false;
    const float along = -dot(cone_->axis, d), limit = cone_->cosHalfAngle - kHorizonSlack;
    return limit > 0 && (!(along > 0) || along * along < limit * limit * distance2);
}

LightSample PointLight::centre(Vec3 point) const {
    const Vec3 d = position_ - point;
    const float distance2 = dot(d, d);
    if (!(distance2 > 0)) return {};
    const float distance = std::sqrt(distance2);
    const Vec3 toLight = d / distance;
    const float cone = cone_ ? cone_->attenuation(-toLight) : 1.0f;
    return {toLight, distance, intensity_ * (cone / attenuation_.at(distance, distance2))};
}

// The mean over the disk: with D the distance of its centre, d that of a place on it and f(d) the
// attenuation, the integrand is D^2 (cos + what is odd in the place) / (d^2 f(d)). Over the radius
// r its mean is cos / (D^2 + r^2) for f = d^2, and cos ln(1 + x) / x with x = r^2 / D^2 for f = 1.
// The disk is in the ball of radius r.
std::optional<LightSample> PointLight::whole(Vec3 point, Vec3 n, Vec3 horizon) const {
    if (cone_ || !(attenuation_.isInverseSquare() || attenuation_.isConstant())) return {};
    const Vec3 d = position_ - point;
    const float distance2 = dot(d, d);
    if (!(distance2 > 0)) return {};
    const float distance = std::sqrt(distance2), height = radius_ + kHorizonSlack * distance;
    if (!(dot(n, d) >= height && dot(horizon, d) >= height)) return {};
    const float radius2 = sqr(radius_);
    const float faded = attenuation_.isConstant()
                            ? attenuation_.constant / kernels::one::logRatio(radius2 / distance2)
                            : attenuation_.quadratic * (distance2 + radius2);
    return LightSample{d / distance, distance, intensity_ * (1 / faded)};
}

// As in the base class; here both are one function, and share what they begin with.
bool PointLight::shine(Vec3 point, Vec3 n, LightSample& sample) const {
    if (cannotReach(point, n)) return false;
    sample = centre(point);
    return true;
}

// The disk faces the point: all of it is in the ball.
Bounds PointLight::sourcesFor(const Bounds&, float) const {
    return Bounds{position_, position_}.padded(radius_);
}
