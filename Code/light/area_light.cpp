#include "light/area_light.h"

#include "base/math.h"
#include "sample/warp.h"

FlatLight::FlatLight(Outline outline, Vec3 centre, Vec3 halfX, Vec3 halfY, Vec3 normal,
                     Rgb radiance, double spreadHalfRad, bool castsShadows)
    : Light(castsShadows, radiance), outline_(outline), centre_(centre), halfX_(halfX),
      halfY_(halfY), normal_(normal), radiance_(radiance),
      spreads_(spreadHalfRad < kHalfPi * 0.9999) {
    const float area = length(halfX) * length(halfY) *
                       (outline == Outline::Rectangle ? 4.0f : static_cast<float>(kPi));
    power_ = radiance * area;
    if (spreads_) {
        const double tangent = exact::tan(spreadHalfRad);
        tanSpread_ = static_cast<float>(tangent);
        spreadNorm_ = static_cast<float>(1 / (tangent - spreadHalfRad));
    }
}

LightSample FlatLight::from(Vec3 place, Vec3 point) const {
    const Vec3 d = place - point;
    const float distance2 = dot(d, d);
    if (!(distance2 > 0)) return {};
    const float distance = std::sqrt(distance2);
    const Vec3 toLight = d / distance;
    const float cosAtLight = -dot(toLight, normal_);
    if (!(cosAtLight > 0)) return {};
    float spread = 1;
    if (spreads_) {
        const float tangent = std::sqrt(max(1 - cosAtLight * cosAtLight, 0.0f)) / cosAtLight;
        spread = max((tanSpread_ - tangent) * spreadNorm_, 0.0f);
    }
    return {toLight, distance, power_ * (spread * cosAtLight / distance2)};
}

float FlatLight::slackAt(Vec3 point) const {
    return kHorizonSlack * (maxAbs(point) + maxAbs(centre_) + maxAbs(halfX_) + maxAbs(halfY_));
}

// Both planes are asked of the corner of the outline's rectangle that is nearest to their light.
bool FlatLight::cannotReach(Vec3 point, Vec3 n) const {
    const Vec3 d = centre_ - point;
    const float slack = slackAt(point);
    if (dot(n, d) + std::fabs(dot(n, halfX_)) + std::fabs(dot(n, halfY_)) < -slack) return true;
    return dot(normal_, d) > slack; // the point is behind the lamp
}

Bounds FlatLight::sourcesFor(const Bounds&) const {
    Vec3 half;
    for (std::size_t axis = 0; axis < 3; ++axis)
        half[axis] = std::fabs(halfX_[axis]) + std::fabs(halfY_[axis]);
    return {centre_ - half, centre_ + half};
}

LightSample FlatLight::centre(Vec3 point) const { return from(centre_, point); }

LightSample FlatLight::sample(Vec3 point, Vec2 u) const {
    const Vec2 place =
        outline_ == Outline::Rectangle ? Vec2{2 * u.x - 1, 2 * u.y - 1} : diskFromSquare(u);
    return from(centre_ + halfX_ * place.x + halfY_ * place.y, point);
}

// Half the sum over the edges, of the angle that each fills times the normal of its plane through
// the point: the light's vector, whose product with any normal above whose horizon the lamp is is
// the irradiance. Each term is off by some 2^-52; they cancel, so little that is left of them is
// not to be trusted.
std::optional<LightSample> FlatLight::whole(Vec3 point, Vec3 n, Vec3 horizon) const {
    if (outline_ != Outline::Rectangle || spreads_) return {};
    const Vec3 toCentre = centre_ - point;
    const float slack = slackAt(point);
    const auto isAbove = [&](Vec3 up) {
        return dot(up, toCentre) >= std::fabs(dot(up, halfX_)) + std::fabs(dot(up, halfY_)) + slack;
    };
    if (!(dot(normal_, toCentre) < -slack) || !isAbove(n) || !isAbove(horizon)) return {};
    const Vec3d d = toDouble(toCentre), x = toDouble(halfX_), y = toDouble(halfY_);
    const Vec3d corners[] = {d - x - y, d + x - y, d + x + y, d - x + y};
    Vec3d sum;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3d a = corners[i], b = corners[(i + 1) % 4], across = cross(a, b);
        const double sine = length(across);
        if (sine > 0) sum += across * (exact::atan2(sine, dot(a, b)) / sine);
    }
    const double twice = length(sum);
    if (!(twice > 1e-6)) return {};
    const double side = dot(sum, d) < 0 ? -1 : 1; // the way the corners go round
    return LightSample{toFloat(sum * (side / twice)), length(toCentre),
                       radiance_ * static_cast<float>(twice / 2)};
}

SphereLight::SphereLight(Vec3 centre, float radius, Rgb radiance, bool castsShadows)
    : Light(castsShadows, radiance), centre_(centre), radius_(radius), radiance_(radiance) {}

LightSample SphereLight::centre(Vec3 point) const {
    const Vec3 d = centre_ - point;
    const float distance2 = dot(d, d);
    if (!(distance2 > radius_ * radius_)) return sample(point, {0.5f, 0.5f});
    const float distance = std::sqrt(distance2);
    const float factor = static_cast<float>(kPi) * radius_ * radius_ / distance2;
    return {d / distance, distance - radius_, radiance_ * factor};
}

std::optional<LightSample> SphereLight::whole(Vec3 point, Vec3 n, Vec3 horizon) const {
    const Vec3 d = centre_ - point;
    const float height = radius_ + kHorizonSlack * (maxAbs(d) + radius_);
    const bool isAbove = dot(n, d) >= height && dot(horizon, d) >= height;
    return isAbove && dot(d, d) > radius_ * radius_ ? centre(point) : std::optional<LightSample>();
}

bool SphereLight::cannotReach(Vec3 point, Vec3 n) const {
    const Vec3 d = centre_ - point;
    return dot(n, d) + radius_ < -kHorizonSlack * (maxAbs(d) + radius_);
}

Bounds SphereLight::sourcesFor(const Bounds&) const {
    return Bounds{centre_, centre_}.padded(radius_);
}

LightSample SphereLight::sample(Vec3 point, Vec2 u) const {
    const Vec3d d = toDouble(centre_) - toDouble(point);
    const double r2 = sqr(static_cast<double>(radius_)), d2 = dot(d, d);
    if (!(d2 > r2)) { // inside: light from everywhere
        const Vec3 toLight = sphereFromSquare(u);
        const double along = dot(toDouble(toLight), d);
        const double distance = along + std::sqrt(max(along * along - d2 + r2, 0.0));
        return {toLight, static_cast<float>(distance), radiance_ * static_cast<float>(4 * kPi)};
    }
    const double sin2 = r2 / d2;
    const double oneMinusCos = sin2 / (1 + std::sqrt(1 - sin2));
    const Frame frame = frameAround(toFloat(normalize(d)));
    const Vec3 toLight = normalize(frame.toWorld(coneFromSquare(u, oneMinusCos)));
    const double along = dot(toDouble(toLight), d);
    const double distance = along - std::sqrt(max(along * along - d2 + r2, 0.0));
    return {toLight, static_cast<float>(distance),
            radiance_ * static_cast<float>(kTwoPi * oneMinusCos)};
}
