// PointEmission: all there is to know of a lamp that shines from a point alike in all directions.
#pragma once

#include "base/vec.h"

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
    LampBall ball() const { return {position, radius}; }
};
