#include "light/seen_light.h"

#include "base/math.h"

#include <variant>

namespace {

// The disk of the lamp's radius that faces the ray.
Rgb seen(const PointEmission& lamp, Vec3 dir) {
    const float area = static_cast<float>(kPi) * sqr(lamp.radius) * lamp.attenuation.quadratic;
    if (!(area > 0)) return {};
    return lamp.intensity * ((lamp.cone ? lamp.cone->attenuation(-dir) : 1) / area);
}

// 2 (1 - cos) of the angle between two directions is the square of their distance, which keeps its
// digits where the cosine of small suns has none left.
Rgb seen(const SunEmission& sun, Vec3 dir) {
    const Vec3d away = toDouble(dir) - toDouble(sun.toSun);
    if (dot(away, away) > 2 * sun.oneMinusCos) return {};
    const double sin2 = sun.oneMinusCos * (2 - sun.oneMinusCos);
    return sun.irradiance * static_cast<float>(1 / (kPi * sin2));
}

Rgb seen(const ParallelEmission&, Vec3) { return {}; }

Rgb seen(const FlatEmission& lamp, Vec3 dir) {
    const float cosAtLight = -dot(dir, lamp.normal);
    return cosAtLight > 0 ? lamp.radiance() * lamp.spreadAt(cosAtLight) : Rgb{};
}

Rgb seen(const SphereEmission& lamp, Vec3) { return lamp.radiance; }

} // namespace

Rgb seenLight(const Light& light, Vec3 dir) {
    const auto lamp = light.lampEmission(false);
    return lamp ? std::visit([&](const auto& of) { return seen(of, dir); }, *lamp) : Rgb{};
}
