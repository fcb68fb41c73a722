// Lamps that shine from a point, in all directions or in a cone. With a radius, light comes from a
// disk about the point that always faces the receiver: E = I * mean over the disk of cosAtDisk /
// distance^2, as Cycles has it.
#pragma once

#include "light/light_lanes.h"

struct PointRow {
    Vec3 position;
    Rgb intensity;             // W/sr
    Vec3 attenuation{1, 0, 0}; // irradiance is the intensity over x d^2 + y d + z
    float radius = 0;
};
struct SpotRow {
    PointRow point;
    Vec3 axis;               // unit, the way the light shines
    float cosHalfAngle = -1; // outside of it is dark
    float blend = 0;         // part of 1 - cosHalfAngle that is soft
    float cosineFalloff = 0; // 1: times the cosine to the axis (Blender up to 3.4)
};

LANES_BEGIN

// Cone of a spot: full light inside, none outside, smoothstep between (Blender since 3.5).
class Cone {
public:
    Cone(const LightNumbers& n, std::size_t i)
        : axis_(n.vector(i)), edge_(n[i + 3]), soft_((Floats(1.0f) - edge_) * n[i + 4]),
          falls_(n[i + 5] > Floats(0.0f)) {}
    // What part of the light goes the way to a point that sees the lamp in this direction.
    Floats towards(const Floats3& toLight) const {
        const Floats zero(0.0f), one(1.0f), c = zero - dot(axis_, toLight);
        const Floats x = select(soft_ > zero, min((c - edge_) / soft_, one), one);
        const Floats smooth = x * x * (Floats(3.0f) - Floats(2.0f) * x);
        return select(c > edge_, select(falls_, smooth * max(c, zero), smooth), zero);
    }

private:
    Floats3 axis_;
    Floats edge_, soft_;
    Mask falls_;
};
struct AllDirections {
    AllDirections(const LightNumbers&, std::size_t) {}
    Floats towards(const Floats3&) const { return 1.0f; }
};

template <class Shine> class RoundEmitter {
public:
    explicit RoundEmitter(const LightNumbers& n)
        : position_(n.vector(0)), intensity_(n.vector(3)), fade_(n.vector(6)), radius_(n[9]),
          shine_(n, 10) {
        const Floats zero(0.0f);
        hasSize_ = (radius_ > zero) & (fade_.x > zero) & (fade_.y == zero) & (fade_.z == zero);
    }

    SampledLight sample(const Floats3& p, Floats u, Floats v) const {
        const Floats zero(0.0f), one(1.0f);
        const Floats3 toCentre = position_ - p;
        const Floats far2 = dot(toCentre, toCentre);
        const Mask isApart = far2 > zero;
        const ShadingFrame frame =
            frameAroundZ(select(isApart, toCentre / sqrt(far2), {zero, zero, one}));
        const Floats2 disk = diskFromSquare(u, v);
        const Floats3 d = toCentre + frame.x * (disk.x * radius_) + frame.y * (disk.y * radius_);
        const Floats distance2 = dot(d, d), distance = sqrt(distance2);
        const Floats3 toLight = d / distance;
        const Floats cosAtDisk = select(radius_ > zero, dot(toLight, frame.z), one);
        const Floats3 irradiance =
            intensity_ * (shine_.towards(toLight) * cosAtDisk / faded(distance, distance2));
        const Floats pdf = select(hasSize_, distance2 / (area() * cosAtDisk), zero);
        return where(isApart & (cosAtDisk > zero), toLight, distance, irradiance, pdf, isSingle());
    }

    SampledLight centre(const Floats3& p) const {
        const Floats3 d = position_ - p;
        const Floats distance2 = dot(d, d), distance = sqrt(distance2);
        const Floats3 toLight = d / distance;
        return where(distance2 > Floats(0.0f), toLight, distance,
                     intensity_ * (shine_.towards(toLight) / faded(distance, distance2)), 0.0f,
                     maskOf(kAllLanes));
    }

    Floats pdf(const Floats3& p, const Floats3& toLight) const {
        const Place at = onDisk(p, toLight);
        return select(at.isMet, at.distance * at.distance / (area() * at.cosAtDisk), Floats(0.0f));
    }

    LightMeeting meet(const Floats3& org, const Floats3& dir) const {
        const Place at = onDisk(org, dir);
        return meetingWhere(at.isMet, at.distance,
                            intensity_ * (shine_.towards(dir) / (area() * fade_.x)));
    }

private:
    struct Place {
        Mask isMet;
        Floats distance, cosAtDisk;
    };
    Place onDisk(const Floats3& p, const Floats3& dir) const {
        const Doubles3 c = differenceOf(position_, p), way = doublesOf(dir);
        const Doubles far2 = dot(c, c), along = dot(way, c), distance = far2 / along;
        const Doubles3 off = way * distance - c;
        const Doubles radius(radius_);
        const Mask isOutside = radius * radius < dot(off, off);
        const Floats cosAtDisk = (along / sqrt(far2)).toFloats();
        const Mask isMet = select(isOutside, Floats(0.0f), cosAtDisk) > Floats(0.0f);
        return {isMet & hasSize_, distance.toFloats(), cosAtDisk};
    }
    Floats faded(Floats distance, Floats distance2) const {
        return fade_.x * distance2 + fade_.y * distance + fade_.z;
    }
    Floats area() const { return Floats(static_cast<float>(kPi)) * radius_ * radius_; }
    Mask isSingle() const { return select(hasSize_, Floats(0.0f), Floats(1.0f)) > Floats(0.0f); }

    Floats3 position_, intensity_, fade_;
    Floats radius_;
    Shine shine_;
    Mask hasSize_; // its light is that of a disk of some radiance
};

struct PointEmitter : RoundEmitter<AllDirections> {
    using Row = PointRow;
    static constexpr const char* kName = "point";
    using RoundEmitter::RoundEmitter;
};
struct SpotEmitter : RoundEmitter<Cone> {
    using Row = SpotRow;
    static constexpr const char* kName = "spot";
    using RoundEmitter::RoundEmitter;
};

LANES_END
