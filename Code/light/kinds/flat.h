// What rectangles and ellipses of constant radiance have in common: they shine to one side.
#pragma once

#include "light/light_lanes.h"

struct FlatRow {
    Vec3 centre, halfX, halfY, normal;   // half axes, perpendicular; unit normal of the bright side
    Rgb radiance;                        // straight ahead
    float tanSpread = 0, spreadNorm = 0; // setSpread()
};
// Narrows the emission as Cycles' grid does; a right angle is all of the side.
void setSpread(FlatRow& row, double spreadHalfRad);

LANES_BEGIN

class FlatNumbers {
public:
    explicit FlatNumbers(const LightNumbers& n)
        : centre(n.vector(0)), halfX(n.vector(3)), halfY(n.vector(6)), normal(n.vector(9)),
          radiance(n.vector(12)), tanSpread_(n[15]), spreadNorm_(n[16]), x2(dot(halfX, halfX)),
          y2(dot(halfY, halfY)) {}

    Floats3 centre, halfX, halfY, normal, radiance;

private:
    Floats tanSpread_, spreadNorm_;

public:
    Floats x2, y2; // squares of the half axes

    // The part of the radiance that leaves at an angle of this cosine to the normal.
    Floats spreadAt(Floats cosAtLight) const {
        const Floats zero(0.0f), one(1.0f);
        const Floats tangent = sqrt(max(one - cosAtLight * cosAtLight, zero)) / cosAtLight;
        const Floats part = max((tanSpread_ - tangent) * spreadNorm_, zero);
        return select(cosAtLight > zero, select(spreadNorm_ > zero, part, one), zero);
    }

    // How far a point is in front of the lamp's plane.
    Floats heightOver(const Floats3& p) const {
        return (Doubles(0.0) - dot(differenceOf(centre, p), doublesOf(normal))).toFloats();
    }

    // The light from one place, of a lamp of this area.
    SampledLight from(const Floats3& p, const Floats3& place, Floats area, Mask single) const {
        const Floats zero(0.0f);
        const Floats3 d = place - p;
        const Floats distance2 = dot(d, d), distance = sqrt(distance2);
        const Floats3 toLight = d / distance;
        // All places are as high above the point: rounding shows where the lamp is seen edge-on.
        const Floats cosAtLight = heightOver(p) / distance;
        const Floats3 irradiance =
            radiance * area * (spreadAt(cosAtLight) * cosAtLight / distance2);
        const Floats pdf = select(single, zero, distance2 / (area * cosAtLight));
        return where((cosAtLight > zero) & (area > zero), toLight, distance, irradiance, pdf,
                     single);
    }

    // Where a ray that goes against the normal meets the lamp's plane: x and y in half axes.
    struct Place {
        Doubles x, y, distance;
        Floats cosAtLight;
        Mask isAhead;
    };
    Place placeOn(const Floats3& p, const Floats3& dir) const {
        const Doubles zero(0.0);
        const Doubles3 c = differenceOf(centre, p), way = doublesOf(dir), n = doublesOf(normal);
        const Doubles cosine = zero - dot(way, n), height = zero - dot(c, n);
        const Doubles distance = height / cosine;
        const Doubles3 at = way * distance - c;
        return {dot(at, doublesOf(halfX)) / Doubles(x2), dot(at, doublesOf(halfY)) / Doubles(y2),
                distance, cosine.toFloats(),
                (zero < cosine) & (zero < height) & (x2 > Floats(0.0f)) & (y2 > Floats(0.0f))};
    }
};

LANES_END
