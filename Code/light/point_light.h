// Point lights and spots, with a radius for soft shadows.
#pragma once

#include "light/light.h"

class PointLight final : public Light {
public:
    // Intensity in W/sr. With a radius, light comes from a disk about the centre that always faces
    // the receiver: E = I * mean over the disk of cosAtDisk / distance^2, as Cycles has it.
    PointLight(Vec3 position, Rgb intensity, Attenuation attenuation, float radius,
               std::optional<SpotCone> cone, bool castsShadows);
    bool isSoft() const override { return radius_ > 0; }
    LightSample sample(Vec3 point, Vec2 u) const override;
    LightSample centre(Vec3 point) const override;
    std::optional<LightSample> whole(Vec3 point, Vec3 n, Vec3 horizon) const override;
    bool cannotReach(Vec3 point, Vec3 n) const override;
    bool shine(Vec3 point, Vec3 n, LightSample& sample) const override;
    Bounds sourcesFor(const Bounds& points, float reach) const override;
    std::optional<Vec3> origin() const override { return position_; }
    std::optional<PointEmission> emission() const override {
        return PointEmission{position_, intensity_, attenuation_, radius_, cone_};
    }
    std::optional<LampEmission> lampEmission(bool inCentre) const override {
        return isSoft() && !inCentre ? std::optional<LampEmission>(*emission()) : std::nullopt;
    }

private:
    Vec3 position_;
    Rgb intensity_;
    Attenuation attenuation_;
    float radius_;
    std::optional<SpotCone> cone_;
};
