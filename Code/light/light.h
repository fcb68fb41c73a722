// Light: what reaches a point from a lamp, before anything is in the way.
// Lights know positions and radiometry; they never see materials or trace rays. Lengths are in the
// scene's normalised units, intensities scaled to them (render/make_light.cpp).
#pragma once

#include "base/bounds.h"
#include "base/vec.h"
#include "light/lamp_emission.h"

#include <optional>

// Light that arrives at a point from one place on a lamp.
struct LightSample {
    Vec3 toLight;       // unit vector from the point
    float distance = 0; // to the lamp's surface; infinite for a sun
    // Irradiance on a surface that faces the lamp; the mean over u in [0,1)^2 is what the whole
    // lamp gives when each direction is weighted with the receiver's response to it. Black: no
    // light.
    Rgb irradiance;
};

// How far, of a distance, rounding can take a lamp that is said to be behind a horizon: dot
// products of floats are off by less than 2^-20 of it.
inline constexpr float kHorizonSlack = 0x1p-16f;

class Light {
public:
    // `power`: black exactly if the lamp is.
    Light(bool castsShadows, Rgb power) : castsShadows_(castsShadows), isDark_(isBlack(power)) {}
    virtual ~Light() = default;

    // Whether sample() depends on u, that is whether shadows have soft edges.
    virtual bool isSoft() const = 0;
    virtual LightSample sample(Vec3 point, Vec2 u) const = 0;
    // The lamp as if it sat in its centre: hard shadows of the same brightness from afar.
    virtual LightSample centre(Vec3 point) const = 0;
    // The light of all of the lamp, if nothing is in between, as one sample: what answers by the
    // cosine to `n` gets from it what the mean over all of sample() gives. In closed form; not set
    // where there is none, or where part of the lamp may be behind the horizon of `n` or of
    // `horizon`.
    virtual std::optional<LightSample> whole(Vec3 /*point*/, Vec3 /*n*/, Vec3 /*horizon*/) const {
        return {};
    }
    // Set when shadow rays are defined as starting at this point: then all of a lamp can go as one
    // bundle (accel/kernels/bundle.h).
    virtual std::optional<Vec3> origin() const { return {}; }
    // Set when centre() is that of this point: for who asks many points at once.
    virtual std::optional<PointEmission> emission() const { return {}; }
    // Set when sample(), or centre(), is that of this lamp: for who asks many points at once.
    virtual std::optional<LampEmission> lampEmission(bool /*inCentre*/) const { return {}; }
    // True only if nothing at `point` with the unit normal n can get light, whatever sample() or
    // centre() is asked: the lamp is behind the horizon, or the point out of the lamp's cone. Costs
    // little beside those; false says nothing.
    virtual bool cannotReach(Vec3 point, Vec3 n) const = 0;
    // centre() for a point that it can reach, else false: both at once.
    virtual bool shine(Vec3 point, Vec3 n, LightSample& sample) const {
        if (cannotReach(point, n)) return false;
        sample = centre(point);
        return true;
    }
    // A box in which the lines end along which light comes to places in `points`; for lamps at
    // infinity they go on, outside of all that has coordinates up to `reach`.
    virtual Bounds sourcesFor(const Bounds& points, float reach) const = 0;
    virtual bool isAtInfinity() const { return false; }
    bool castsShadows() const { return castsShadows_; }
    bool isDark() const { return isDark_; }

private:
    bool castsShadows_, isDark_;
};
