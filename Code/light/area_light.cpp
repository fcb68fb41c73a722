#include "light/area_light.h"

#include "base/math.h"
#include "sample/warp.h"

FlatLight::FlatLight(Outline outline, Vec3 centre, Vec3 halfX, Vec3 halfY, Vec3 normal,
                     Rgb radiance, double spreadHalfRad, bool castsShadows)
    : Light(castsShadows, radiance), radiance_(radiance) {
    flat_.isEllipse = outline == Outline::Ellipse;
    flat_.centre = centre, flat_.halfX = halfX, flat_.halfY = halfY, flat_.normal = normal;
    const float area = length(halfX) * length(halfY) *
                       (outline == Outline::Rectangle ? 4.0f : static_cast<float>(kPi));
    flat_.power = radiance * area;
    flat_.spreads = spreadHalfRad < kHalfPi * 0.9999;
    if (flat_.spreads) {
        const double tangent = exact::tan(spreadHalfRad);
        flat_.tanSpread = static_cast<float>(tangent);
        flat_.spreadNorm = static_cast<float>(1 / (tangent - spreadHalfRad));
    }
}

LightSample FlatLight::from(Vec3 place, Vec3 point) const {
    const Vec3 d = place - point;
    const float distance2 = dot(d, d);
    if (!(distance2 > 0)) return {};
    const float distance = std::sqrt(distance2);
    const Vec3 toLight = d / distance;
    const float cosAtLight = -dot(toLight, flat_.normal);
    if (!(cosAtLight > 0)) return {};
    const float spread = flat_.spreadAt(cosAtLight);
    return {toLight, distance, flat_.power * (spread * cosAtLight / distance2)};
}

float FlatLight::slackAt(Vec3 point) const {
    return kHorizonSlack *
           (maxAbs(point) + maxAbs(flat_.centre) + maxAbs(flat_.halfX) + maxAbs(flat_.halfY));
}

// Both planes are asked of the corner of the outline's rectangle that is nearest to their light.
bool FlatLight::cannotReach(Vec3 point, Vec3 n) const {
    const Vec3 d = flat_.centre - point;
    const float slack = slackAt(point);
    if (dot(n, d) + std::fabs(dot(n, flat_.halfX)) + std::fabs(dot(n, flat_.halfY)) < -slack)
        return true;
    return dot(flat_.normal, d) > slack; // the point is behind the lamp
}

Bounds FlatLight::sourcesFor(const Bounds&, float) const {
    Vec3 half;
    for (std::size_t axis = 0; axis < 3; ++axis)
        half[axis] = std::fabs(flat_.halfX[axis]) + std::fabs(flat_.halfY[axis]);
    return {flat_.centre - half, flat_.centre + half};
}

LightSample FlatLight::centre(Vec3 point) const { return from(flat_.centre, point); }

LightSample FlatLight::sample(Vec3 point, Vec2 u) const {
    const Vec2 place = flat_.isEllipse ? diskFromSquare(u) : Vec2{2 * u.x - 1, 2 * u.y - 1};
    return from(flat_.centre + flat_.halfX * place.x + flat_.halfY * place.y, point);
}

// Half the sum over the edges, of the angle that each fills times the normal of its plane through
// the point: the light's vector, whose product with any normal above whose horizon the lamp is is
// the irradiance. Each term is off by some 2^-52; they cancel, so little that is left of them is
// not to be trusted.
std::optional<LightSample> FlatLight::whole(Vec3 point, Vec3 n, Vec3 horizon) const {
    if (flat_.isEllipse || flat_.spreads) return {};
    const Vec3 toCentre = flat_.centre - point;
    const float slack = slackAt(point);
    const auto isAbove = [&](Vec3 up) {
        return dot(up, toCentre) >=
               std::fabs(dot(up, flat_.halfX)) + std::fabs(dot(up, flat_.halfY)) + slack;
    };
    if (!(dot(flat_.normal, toCentre) < -slack) || !isAbove(n) || !isAbove(horizon)) return {};
    const Vec3d d = toDouble(toCentre), x = toDouble(flat_.halfX), y = toDouble(flat_.halfY);
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
    : Light(castsShadows, radiance), sphere_{centre, radius, radiance} {}

LightSample SphereLight::centre(Vec3 point) const {
    const Vec3 d = sphere_.centre - point;
    const float distance2 = dot(d, d);
    if (!(distance2 > sphere_.radius * sphere_.radius)) return sample(point, {0.5f, 0.5f});
    const float distance = std::sqrt(distance2);
    const float factor = static_cast<float>(kPi) * sphere_.radius * sphere_.radius / distance2;
    return {d / distance, distance - sphere_.radius, sphere_.radiance * factor};
}

std::optional<LightSample> SphereLight::whole(Vec3 point, Vec3 n, Vec3 horizon) const {
    const Vec3 d = sphere_.centre - point;
    const float height = sphere_.radius + kHorizonSlack * (maxAbs(d) + sphere_.radius);
    const bool isAbove = dot(n, d) >= height && dot(horizon, d) >= height;
    return isAbove && dot(d, d) > sphere_.radius * sphere_.radius ? centre(point)
                                                                  : std::optional<LightSample>();
}

bool SphereLight::cannotReach(Vec3 point, Vec3 n) const {
    const Vec3 d = sphere_.centre - point;
    return dot(n, d) + sphere_.radius < -kHorizonSlack * (maxAbs(d) + sphere_.radius);
}

Bounds SphereLight::sourcesFor(const Bounds&, float) const {
    return Bounds{sphere_.centre, sphere_.centre}.padded(sphere_.radius);
}

LightSample SphereLight::sample(Vec3 point, Vec2 u) const {
    const Vec3d d = toDouble(sphere_.centre) - toDouble(point);
    const double r2 = sqr(static_cast<double>(sphere_.radius)), d2 = dot(d, d);
    if (!(d2 > r2)) { // inside: light from everywhere
        const Vec3 toLight = sphereFromSquare(u);
        const double along = dot(toDouble(toLight), d);
        const double distance = along + std::sqrt(max(along * along - d2 + r2, 0.0));
        return {toLight, static_cast<float>(distance),
                sphere_.radiance * static_cast<float>(4 * kPi)};
    }
    const double sin2 = r2 / d2;
    const double oneMinusCos = sin2 / (1 + std::sqrt(1 - sin2));
    const Frame frame = frameAround(toFloat(normalize(d)));
    const Vec3 toLight = normalize(frame.toWorld(coneFromSquare(u, oneMinusCos)));
    const double along = dot(toDouble(toLight), d);
    const double distance = along - std::sqrt(max(along * along - d2 + r2, 0.0));
    return {toLight, static_cast<float>(distance),
            sphere_.radiance * static_cast<float>(kTwoPi * oneMinusCos)};
}
