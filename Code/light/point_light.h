// Point lights and spots, with a radius for soft shadows.
#pragma once

#include "light/light.h"

// Cone of a spot: full light inside, none outside, smoothstep between (Blender since 3.5).
struct SpotCone {
    Vec3 axis;                  // unit, the way the light shines
    float cosHalfAngle = -1;    // outside of it is dark
    float blend = 0;            // part of 1 - cosHalfAngle that is soft
    bool cosineFalloff = false; // times the cosine to the axis (Blender up to 3.4)
    float attenuation(Vec3 fromLight) const;
};

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
    Bounds sourcesFor(const Bounds& points) const override;
    std::optional<Vec3> origin() const override { return position_; }
    std::optional<PointEmission> emission() const override {
        if (cone_) return {};
        return PointEmission{position_, intensity_, attenuation_, radius_};
    }

private:
    Vec3 position_;
    Rgb intensity_;
    Attenuation attenuation_;
    float radius_;
    std::optional<SpotCone> cone_;
};
