// LampEmission: all there is to know of what a lamp's samples, or its centre, give, for who asks
// for many points at once.
#pragma once

#include "base/math.h"
#include "light/point_emission.h"

#include <cmath>
#include <variant>

// A disk in the sky.
struct SunEmission {
    Vec3 toSun;             // unit vector to its middle
    Rgb irradiance;         // of a surface that faces it
    double oneMinusCos = 0; // of its half angle
    float sinHalfAngle = 0; // 1 from a right angle on

    // Radiance E / (pi sin^2 h) times the solid angle 2 pi (1 - cos h).
    Rgb ofSample() const { return irradiance * static_cast<float>(2 / (2 - oneMinusCos)); }
};

// A sun asked in its middle.
struct ParallelEmission {
    Vec3 toSun;
    Rgb irradiance;
    float sinHalfAngle = 0;
};

// A rectangle or an ellipse that shines to one side.
struct FlatEmission {
    bool isEllipse = false;
    Vec3 centre, halfX, halfY, normal; // half axes; unit normal of the bright side
    Rgb power;                         // radiance times area
    bool spreads = false;              // less than to all sides, as Cycles' grid does
    float tanSpread = 0, spreadNorm = 0;

    // Radiance straight ahead of a lamp that shines to all sides.
    Rgb radiance() const {
        return power *
               (1 / (length(halfX) * length(halfY) * (isEllipse ? static_cast<float>(kPi) : 4.0f)));
    }
    // The part of it that leaves at an angle of this cosine, above 0, to the normal.
    float spreadAt(float cosAtLight) const {
        if (!spreads) return 1;
        const float tangent = std::sqrt(max(1 - cosAtLight * cosAtLight, 0.0f)) / cosAtLight;
        return max((tanSpread - tangent) * spreadNorm, 0.0f);
    }
};

// A ball.
struct SphereEmission {
    Vec3 centre;
    float radius = 0;
    Rgb radiance;
};

using LampEmission =
    std::variant<PointEmission, SunEmission, ParallelEmission, FlatEmission, SphereEmission>;
