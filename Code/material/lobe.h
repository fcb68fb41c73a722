// Lobe: one way in which a surface scatters light. A lobe is a struct of numbers in lanes; it says
// what part of the light it sends where (eval), how likely it samples a direction (pdf), and
// samples one (sample). Each lobe is one file in lobes/ and one word in the list of lobes.h.
//
// All directions are unit vectors that point away from the surface, in the shading frame: z is the
// shading normal on the side of the eye, so that toEye.z > 0. A toLight with z < 0 is behind the
// surface: light that is transmitted.
#pragma once

#include "sample/warps.h"
#include "simd/vectors3.h"

#include <array>
#include <cstddef>
#include <cstdint>

// What is written in a scene for a number of a lobe: `count` 1 (a number) or 3 (a colour).
struct LobeField {
    const char* name;
    int count;
    float start[3];    // the value if it isn't written
    float least, most; // of each component
};

enum LobeFlags : std::uint32_t {
    kReflects = 1,      // to the side of the eye
    kTransmits = 2,     // to the other side
    kAnswersLights = 4, // eval() is not 0 everywhere
    kSpawnsRays = 8,    // sample() does
    kDiffuse = 16,      // a diffuse bounce by the depth limits; else glossy, or transmission
    kHasSides = 32,     // asks for `eta`
    kHasTangent = 64,   // looks at x and y of the frame: dp/du is along x
};

// The most numbers that a lobe has, and the most lobes of a material.
inline constexpr std::size_t kLobeNumbers = 12, kMostLobes = 8;

LANES_BEGIN

// Where a lobe's numbers come from: number i of W points that follow each other. `eta`: index of
// refraction on the side of the eye over that on the other side. `leastAlpha`: facets are at least
// as wide as this along both axes.
struct LobeNumbers {
    const float* columns; // number i of point k is columns[i * step + k]
    std::size_t step;
    Floats eta;
    Floats leastAlpha{0.0f};

    Floats operator[](std::size_t i) const { return Floats::load(columns + i * step); }
    Floats3 rgb(std::size_t i) const { return {(*this)[i], (*this)[i + 1], (*this)[i + 2]}; }
};

// A sampled direction. `weight` is eval() / pdf. Where `single` holds the lobe sends light in
// single directions (its roughness is 0): eval() and pdf() are 0 there, `weight` is the part of the
// light that goes there over the probability of the choice, which `pdf` is. pdf is 0 where nothing
// was sampled.
struct LobeSample {
    Floats3 toLight;
    Floats3 weight;
    Floats pdf;
    Mask single;
};

// What a lobe L has:
//   static constexpr const char* kName;                 its word in scenes
//   static constexpr LobeField kFields[];               its numbers, in order, at most kLobeNumbers
//   static constexpr std::uint32_t kFlags;              LobeFlags
//   explicit L(const LobeNumbers&);                     the numbers of W points
//   Floats3 below(toEye) const;                         what part of the light it lets through to
//                                                       lobes that it lies on, there and back
//   Floats3 albedo(toEye) const;                        the part of the light that it sends on, or
//                                                       near it: lobes are chosen by it
//   Floats3 eval(toEye, toLight) const;                 f |cos|: radiance per irradiance of a
//                                                       surface that faces the light
//   Floats pdf(toEye, toLight) const;                   per steradian, with which sample() gives it
//   LobeSample sample(toEye, Floats pick, u, v) const;  by three numbers in [0,1)
// Lobes that spawn no rays have neither sample nor pdf. Lobes that reflect and transmit have, for
// integrators that follow both,
//   LobeSample branch(toEye, bool transmits, u, v) const;  whose weight isn't over a choice, and
//   Floats branchPdf(toEye, toLight) const;                its density

inline Floats3 rgbOf(Floats v) { return {v, v, v}; }
inline Floats3 rgbOf(float v) { return rgbOf(Floats(v)); }
inline Floats maxOf(const Floats3& c) { return max(max(c.x, c.y), c.z); }

LANES_END
