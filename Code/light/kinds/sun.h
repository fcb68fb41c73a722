// SunEmitter: parallel light, or light from a disk in the sky when it has an angular size.
#pragma once

#include "light/light_lanes.h"

struct SunRow {
    Vec3 toSun;            // unit vector to its middle
    Rgb irradiance;        // of a surface that faces it
    float oneMinusCos = 0; // of its half angle, which is at most a right one; 0: parallel light
};

LANES_BEGIN

class SunEmitter {
public:
    using Row = SunRow;
    static constexpr const char* kName = "sun";
    explicit SunEmitter(const LightNumbers& n)
        : toSun_(n.vector(0)), irradiance_(n.vector(3)), oneMinusCos_(n[6]),
          hasSize_(oneMinusCos_ > Floats(kLeastHalfAngle * kLeastHalfAngle / 2)) {}

    SampledLight sample(const Floats3& p, Floats u, Floats v) const {
        if (bits(hasSize_) == 0) return centre(p);
        const Floats3 toLight =
            normalize(frameAroundZ(toSun_).toWorld(coneFromSquare(u, v, oneMinusCos_)));
        const Floats two(2.0f);
        const SampledLight disk =
            where(hasSize_, toLight, kInfinityF, irradiance_ * (two / (two - oneMinusCos_)),
                  density(), noLanes());
        return select(hasSize_, disk, centre(p));
    }
    SampledLight centre(const Floats3&) const {
        return where(maskOf(kAllLanes), toSun_, kInfinityF, irradiance_, 0.0f, maskOf(kAllLanes));
    }
    Floats pdf(const Floats3&, const Floats3& toLight) const {
        return select(isMet(toLight), density(), Floats(0.0f));
    }
    LightMeeting meet(const Floats3&, const Floats3& dir) const {
        const Floats sin2 = oneMinusCos_ * (Floats(2.0f) - oneMinusCos_);
        return meetingWhere(isMet(dir), kInfinityF,
                            irradiance_ / (Floats(static_cast<float>(kPi)) * sin2));
    }

private:
    // 2 (1 - cos) of the angle between two directions is the square of their distance, which keeps
    // its digits where the cosine of small suns has none left.
    Mask isMet(const Floats3& dir) const {
        const Floats3 away = dir - toSun_;
        return hasSize_ & (dot(away, away) <= Floats(2.0f) * oneMinusCos_);
    }
    Floats density() const { return Floats(static_cast<float>(kInvTwoPi)) / oneMinusCos_; }

    Floats3 toSun_, irradiance_;
    Floats oneMinusCos_;
    Mask hasSize_;
};

LANES_END
