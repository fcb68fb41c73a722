// A sun: parallel light, or light from a disk in the sky when it has an angular size.
#pragma once

#include "light/light.h"

class SunLight final : public Light {
public:
    // `direction`: unit vector along which the light travels. Irradiance on a facing surface in
    // W/m^2; `halfAngleRad` of the disk in the sky, which has constant radiance.
    SunLight(Vec3 direction, Rgb irradiance, double halfAngleRad, bool castsShadows);
    bool isSoft() const override { return sun_.oneMinusCos > 0; }
    LightSample sample(Vec3 point, Vec2 u) const override;
    LightSample centre(Vec3 point) const override;
    std::optional<LightSample> whole(Vec3 point, Vec3 n, Vec3 horizon) const override;
    bool cannotReach(Vec3 point, Vec3 n) const override;
    bool isAtInfinity() const override { return true; }
    Bounds sourcesFor(const Bounds& points, float reach) const override;
    std::optional<LampEmission> lampEmission(bool inCentre) const override;

private:
    SunEmission sun_;
};
