// What lights in lanes have in common. A light is a struct of numbers in lanes; it gives samples of
// the light that arrives at a point (sample), says how likely they are (pdf), and what a ray meets
// of it (meet). Each kind is one file in kinds/ and one word in the list of lights.h.
//
// Lights know positions and radiometry, never materials, shapes or what is in between. Directions
// are unit vectors in the normalised space of the scene, away from the point.
#pragma once

#include "base/math.h"
#include "sample/warps.h"
#include "simd/vectors3.h"

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

// The most numbers that a light has.
inline constexpr std::size_t kLightNumbers = 20;

LANES_BEGIN

// Where a light's numbers come from. With a step of 1, number i is columns[i], for all points.
// Else every lane may have another light of the kind: number i of point k is
// columns[i * step + k], and `columns` is aligned as registers are, and so is `step`.
struct LightNumbers {
    const float* columns;
    std::size_t step;

    Floats operator[](std::size_t i) const {
        return step == 1 ? Floats(columns[i]) : Floats::load(columns + i * step);
    }
    Floats3 vector(std::size_t i) const { return {(*this)[i], (*this)[i + 1], (*this)[i + 2]}; }
};

// Light that arrives at a point from one place of a lamp. All numbers are finite, but for the
// distance of suns and skies.
struct SampledLight {
    Floats3 toLight;    // unit vector from the point
    Floats distance;    // to the lamp's surface
    Floats3 irradiance; // radiance / pdf, of a surface that faces it; black: no light
    Floats pdf;         // per steradian; 0 for single directions, and where there is no light
    Mask single;        // no other direction has light, and no ray meets the lamp
};

// What a ray meets of a lamp that is no shape.
struct LightMeeting {
    Floats distance;  // infinite if it meets nothing, and of suns and skies
    Floats3 radiance; // black if it meets nothing
};

// What a light L has:
//   using Row;                                     its numbers by name, all of them floats
//   static constexpr const char* kName;            of the kind
//   explicit L(const LightNumbers&);               the lights of W points
//   SampledLight sample(p, Floats u, v) const;     by two numbers in [0,1): the mean of irradiance
//                                                  times a response is what all of the lamp gives
//   SampledLight centre(p) const;                  the lamp as if it sat in its centre: hard
//   shadows
//                                                  of the same brightness from afar. Always single
//   Floats pdf(p, toLight) const;                  per steradian, with which sample() gives it
//   LightMeeting meet(org, dir) const;             along dir, whatever is in between

// The directions of a lamp smaller than this, in radians, count as one.
inline constexpr float kLeastHalfAngle = 0x1p-18f;

inline Doubles3 differenceOf(const Floats3& a, const Floats3& b) {
    return Doubles3::of(a.x, a.y, a.z) - Doubles3::of(b.x, b.y, b.z);
}
inline Doubles3 doublesOf(const Floats3& a) { return Doubles3::of(a.x, a.y, a.z); }
inline Floats widest(const Floats3& a) { return max(max(abs(a.x), abs(a.y)), abs(a.z)); }

// Returns the sample where there is light, and black, with some direction, elsewhere: where the
// mask is not set, and where a number left the range of floats.
inline SampledLight where(Mask lit, const Floats3& toLight, Floats distance,
                          const Floats3& irradiance, Floats pdf, Mask single) {
    const Floats zero(0.0f), end(kInfinityF);
    // Comparisons with NaN are false.
    lit = lit & (irradiance.x < end) & (irradiance.y < end) & (irradiance.z < end) & (pdf < end) &
          (abs(toLight.x) < end) & (abs(toLight.y) < end) & (abs(toLight.z) < end) &
          (distance >= zero);
    return {select(lit, toLight, {zero, zero, Floats(1.0f)}), select(lit, distance, zero),
            select(lit, irradiance, {zero, zero, zero}), select(lit, pdf, zero), single};
}
inline LightMeeting meetingWhere(Mask met, Floats distance, const Floats3& radiance) {
    const Floats zero(0.0f), end(kInfinityF);
    met = met & (distance >= zero) & (radiance.x < end) & (radiance.y < end) & (radiance.z < end);
    return {select(met, distance, end), select(met, radiance, {zero, zero, zero})};
}
// Combines samples of the lanes that are set with those of the others.
inline SampledLight select(Mask m, const SampledLight& a, const SampledLight& b) {
    const Floats one(1.0f), zero(0.0f);
    return {select(m, a.toLight, b.toLight), select(m, a.distance, b.distance),
            select(m, a.irradiance, b.irradiance), select(m, a.pdf, b.pdf),
            select(m, select(a.single, one, zero), select(b.single, one, zero)) == one};
}
inline constexpr unsigned kAllLanes = (1u << W) - 1;
inline Mask noLanes() { return maskOf(0); }

LANES_END
