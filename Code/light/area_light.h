// Lamps with an area: flat ones (rectangle, disk, ellipse) and spheres, of constant radiance.
#pragma once

#include "light/light.h"

class FlatLight final : public Light {
public:
    enum class Outline { Rectangle, Ellipse };
    // Half axes from the centre, perpendicular to each other; the light goes to the side of
    // `normal` (unit). spreadHalfRad < pi/2 narrows the emission as Cycles' grid does.
    FlatLight(Outline outline, Vec3 centre, Vec3 halfX, Vec3 halfY, Vec3 normal, Rgb radiance,
              double spreadHalfRad, bool castsShadows);
    bool isSoft() const override { return true; }
    LightSample sample(Vec3 point, Vec2 u) const override;
    LightSample centre(Vec3 point) const override;
    // Of rectangles that light all sides (Lambert 1760).
    std::optional<LightSample> whole(Vec3 point, Vec3 n, Vec3 horizon) const override;
    bool cannotReach(Vec3 point, Vec3 n) const override;
    Bounds sourcesFor(const Bounds& points, float reach) const override;
    std::optional<LampEmission> lampEmission(bool inCentre) const override {
        return inCentre ? std::nullopt : std::optional<LampEmission>(flat_);
    }

private:
    LightSample from(Vec3 place, Vec3 point) const;
    float slackAt(Vec3 point) const; // what rounding takes of heights above planes

    FlatEmission flat_;
    Rgb radiance_;
};

class SphereLight final : public Light {
public:
    SphereLight(Vec3 centre, float radius, Rgb radiance, bool castsShadows);
    bool isSoft() const override { return true; }
    // Uniform in the cone of directions that the sphere fills (Shirley and Wang 1996).
    LightSample sample(Vec3 point, Vec2 u) const override;
    LightSample centre(Vec3 point) const override;
    std::optional<LightSample> whole(Vec3 point, Vec3 n, Vec3 horizon) const override;
    bool cannotReach(Vec3 point, Vec3 n) const override;
    Bounds sourcesFor(const Bounds& points, float reach) const override;
    std::optional<LampEmission> lampEmission(bool inCentre) const override {
        return inCentre ? std::nullopt : std::optional<LampEmission>(sphere_);
    }

private:
    SphereEmission sphere_;
};
