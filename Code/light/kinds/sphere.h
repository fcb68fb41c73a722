// SphereEmitter: a sphere of constant radiance. From outside of it the directions in the cone that
// it fills are equally likely (Shirley and Wang 1996), inside all directions are.
#pragma once

#include "light/light_lanes.h"

struct SphereRow {
    Vec3 centre;
    float radius = 0;
    Rgb radiance;
};

LANES_BEGIN

class SphereEmitter {
public:
    using Row = SphereRow;
    static constexpr const char* kName = "sphere";
    explicit SphereEmitter(const LightNumbers& n)
        : centre_(n.vector(0)), radius_(n[3]), radiance_(n.vector(4)) {}

    SampledLight sample(const Floats3& p, Floats u, Floats v) const {
        const Floats zero(0.0f), one(1.0f);
        const Seen seen = seenFrom(p);
        const Floats3 axis = Floats3::of(seen.d / sqrt(seen.d2));
        const ShadingFrame frame =
            frameAroundZ(select(dot(axis, axis) > zero, axis, {zero, zero, one}));
        const Floats3 toLight = normalize(frame.toWorld(coneFromSquare(u, v, seen.oneMinusCos)));
        const Floats solidAngle = Floats(static_cast<float>(kTwoPi)) * seen.oneMinusCos;
        return where(solidAngle > zero, toLight, seen.distance(toLight), radiance_ * solidAngle,
                     one / solidAngle, noLanes());
    }
    SampledLight centre(const Floats3& p) const {
        const Seen seen = seenFrom(p);
        const Doubles distance = sqrt(seen.d2);
        const Floats factor = (Doubles(kPi) * (seen.r2 / seen.d2)).toFloats();
        const SampledLight outside = where(radius_ > Floats(0.0f), Floats3::of(seen.d / distance),
                                           (distance - Doubles(radius_)).toFloats(),
                                           radiance_ * factor, 0.0f, maskOf(kAllLanes));
        if (bits(seen.isOutside) == kAllLanes) return outside;
        SampledLight inside = sample(p, 0.5f, 0.5f);
        inside.pdf = 0.0f, inside.single = maskOf(kAllLanes);
        return select(seen.isOutside, outside, inside);
    }
    Floats pdf(const Floats3& p, const Floats3& toLight) const {
        const Seen seen = seenFrom(p);
        const Floats zero(0.0f), pdf = Floats(static_cast<float>(kInvTwoPi)) / seen.oneMinusCos;
        return select(seen.isMet(toLight) & (pdf < Floats(kInfinityF)), pdf, zero);
    }
    LightMeeting meet(const Floats3& org, const Floats3& dir) const {
        const Seen seen = seenFrom(org);
        return meetingWhere(seen.isMet(dir) & (radius_ > Floats(0.0f)), seen.distance(dir),
                            radiance_);
    }

private:
    struct Seen {
        Doubles3 d; // to the centre
        Doubles d2, r2;
        Mask isOutside;
        Floats oneMinusCos; // of the half angle of the cone; 2 inside

        // The root's argument in the form that keeps its digits: of the distance between the centre
        // and the ray.
        Doubles under(const Floats3& dir) const {
            const Doubles3 way = doublesOf(dir), off = way * (dot(way, d) / dot(way, way)) - d;
            return r2 - dot(off, off);
        }
        Mask isMet(const Floats3& dir) const {
            const Doubles zero(0.0), one(1.0);
            const Doubles ahead = select(isOutside, dot(doublesOf(dir), d), one);
            return (zero < ahead) & maskOf(atMost(zero, select(isOutside, under(dir), one)));
        }
        Floats distance(const Floats3& dir) const {
            const Doubles zero(0.0), half = sqrt(max(under(dir), zero));
            const Doubles along = dot(doublesOf(dir), d);
            return max(select(isOutside, along - half, along + half), zero).toFloats();
        }
    };
    Seen seenFrom(const Floats3& p) const {
        const Doubles one(1.0), radius(radius_), r2 = radius * radius;
        const Doubles3 d = differenceOf(centre_, p);
        const Doubles d2 = dot(d, d), sin2 = r2 / d2;
        const Doubles oneMinusCos = sin2 / (one + sqrt(max(one - sin2, Doubles(0.0))));
        const Mask isOutside = r2 < d2;
        return {d, d2, r2, isOutside,
                select(isOutside, oneMinusCos,
                       select(radius_ > Floats(0.0f), Doubles(2.0), Doubles(0.0)))
                    .toFloats()};
    }

    Floats3 centre_;
    Floats radius_;
    Floats3 radiance_;
};

LANES_END
