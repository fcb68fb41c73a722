#include "light/sun_light.h"

#include "base/math.h"
#include "sample/warp.h"

SunLight::SunLight(Vec3 direction, Rgb irradiance, double halfAngleRad, bool castsShadows)
    : Light(castsShadows, irradiance), toSun_(-direction), irradiance_(irradiance),
      oneMinusCos_(2 * sqr(exact::sin(halfAngleRad / 2))),
      sinHalfAngle_(halfAngleRad < kHalfPi ? static_cast<float>(exact::sin(halfAngleRad)) : 1) {}

LightSample SunLight::centre(Vec3) const { return {toSun_, kInfinityF, irradiance_}; }

LightSample SunLight::sample(Vec3 point, Vec2 u) const {
    if (oneMinusCos_ == 0) return centre(point);
    const Vec3 toLight = frameAround(toSun_).toWorld(coneFromSquare(u, oneMinusCos_));
    // Radiance E / (pi sin^2 h) times the solid angle 2 pi (1 - cos h).
    const double weight = 2 / (2 - oneMinusCos_);
    return {normalize(toLight), kInfinityF, irradiance_ * static_cast<float>(weight)};
}

// The mean of the disk's directions is its middle times (1 + cos h) / 2: what sample() divides by.
std::optional<LightSample> SunLight::whole(Vec3 point, Vec3 n, Vec3 horizon) const {
    const float height = sinHalfAngle_ + kHorizonSlack;
    const bool isAbove =
        oneMinusCos_ < 1 && dot(n, toSun_) >= height && dot(horizon, toSun_) >= height;
    return isAbove ? centre(point) : std::optional<LightSample>();
}

// The highest place of the disk rises sin(angle between the sun and the horizon) by at most the
// sine of its radius.
bool SunLight::cannotReach(Vec3, Vec3 n) const {
    return dot(n, toSun_) < -(sinHalfAngle_ + kHorizonSlack);
}

Bounds SunLight::sourcesFor(const Bounds& points) const {
    const float away = 4 * (2 + max(maxAbs(points.lo), maxAbs(points.hi)));
    const Vec3 way = toSun_ * away;
    // The chord between the middle of the disk and its edge is at most twice the sine.
    return Bounds{points.lo + way, points.hi + way}.padded(2 * sinHalfAngle_ * away);
}
