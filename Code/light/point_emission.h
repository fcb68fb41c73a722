// PointEmission: all there is to know of a lamp that shines from a point, in all directions or in a
// cone.
#pragma once

#include "base/vec.h"

#include <optional>

// Light at distance d is the intensity over this polynomial of d: d^2 for all real lamps, others
// for scenes whose lamps fade less or not at all.
struct Attenuation {
    float quadratic = 1, linear = 0, constant = 0;
    float at(float distance, float distance2) const {
        return quadratic * distance2 + linear * distance + constant;
    }
    bool isInverseSquare() const { return linear == 0 && constant == 0; }
    bool isConstant() const { return quadratic == 0 && linear == 0; }
};

// Cone of a spot: full light inside, none outside, smoothstep between (Blender since 3.5).
struct SpotCone {
    Vec3 axis;                  // unit, the way the light shines
    float cosHalfAngle = -1;    // outside of it is dark
    float blend = 0;            // part of 1 - cosHalfAngle that is soft
    bool cosineFalloff = false; // times the cosine to the axis (Blender up to 3.4)
    float attenuation(Vec3 fromLight) const;
};

// All places on a lamp are in it.
struct LampBall {
    Vec3 centre;
    float radius;
};

struct PointEmission {
    Vec3 position;
    Rgb intensity;
    Attenuation attenuation;
    float radius = 0; // of the lamp's body, when it is asked for its centre alone
    std::optional<SpotCone> cone{};
    LampBall ball() const { return {position, radius}; }
};
