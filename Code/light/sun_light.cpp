#include "light/sun_light.h"

#include "base/math.h"
#include "sample/warp.h"

SunLight::SunLight(Vec3 direction, Rgb irradiance, double halfAngleRad, bool castsShadows)
    : Light(castsShadows, irradiance), sun_{-direction, irradiance,
                                            2 * sqr(exact::sin(halfAngleRad / 2)),
                                            halfAngleRad < kHalfPi
                                                ? static_cast<float>(exact::sin(halfAngleRad))
                                                : 1} {}

LightSample SunLight::centre(Vec3) const { return {sun_.toSun, kInfinityF, sun_.irradiance}; }

LightSample SunLight::sample(Vec3 point, Vec2 u) const {
    if (sun_.oneMinusCos == 0) return centre(point);
    const Vec3 toLight = frameAround(sun_.toSun).toWorld(coneFromSquare(u, sun_.oneMinusCos));
    return {normalize(toLight), kInfinityF, sun_.ofSample()};
}

// Directions of the tiniest suns are close to the smallest floats.
std::optional<LampEmission> SunLight::lampEmission(bool inCentre) const {
    if (inCentre) return ParallelEmission{sun_.toSun, sun_.irradiance, sun_.sinHalfAngle};
    return sun_.oneMinusCos > 0x1p-60 ? std::optional<LampEmission>(sun_) : std::nullopt;
}

// The mean of the disk's directions is its middle times (1 + cos h) / 2: what sample() divides by.
std::optional<LightSample> SunLight::whole(Vec3 point, Vec3 n, Vec3 horizon) const {
    const float height = sun_.sinHalfAngle + kHorizonSlack;
    const bool isAbove =
        sun_.oneMinusCos < 1 && dot(n, sun_.toSun) >= height && dot(horizon, sun_.toSun) >= height;
    return isAbove ? centre(point) : std::optional<LightSample>();
}

// The highest place of the disk rises sin(angle between the sun and the horizon) by at most the
// sine of its radius.
bool SunLight::cannotReach(Vec3, Vec3 n) const {
    return dot(n, sun_.toSun) < -(sun_.sinHalfAngle + kHorizonSlack);
}

Bounds SunLight::sourcesFor(const Bounds& points, float reach) const {
    const float away = 4 * (1 + reach + max(maxAbs(points.lo), maxAbs(points.hi)));
    const Vec3 way = sun_.toSun * away;
    // The chord between the middle of the disk and its edge is at most twice the sine.
    return Bounds{points.lo + way, points.hi + way}.padded(2 * sun_.sinHalfAngle * away);
}
