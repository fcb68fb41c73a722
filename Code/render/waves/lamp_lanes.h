// Light of a lamp at many points of a wave, a register of points, or of places on the lamp,
// at a time: what forEachLampSample() gives and the shadow rays, operation by operation and so bit
// by bit. Knows numbers only; render/waves/lamps.h brings them here and takes them away.
#pragma once

#include "accel/kernels/kernels.h"
#include "light/lamp_emission.h"
#include "material/material.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

// Points of a wave that answer lamps, component by component.
struct alignas(64) LitBlock {
    static constexpr std::size_t kPoints = 16;
    static constexpr std::size_t kModels = 3; // of SpecularModel
    float p[3][kPoints], lift[3][kPoints], n[3][kPoints], ng[3][kPoints];
    float weight[3][kPoints], diffuse[3][kPoints], error[kPoints], rayError[kPoints];
    float ns[3][kPoints];                                             // of the lifted ones
    float toEye[3][kPoints], specular[3][kPoints], exponent[kPoints]; // of the shiny ones
    std::uint32_t point[kPoints], shape[kPoints];                     // the shape that it is on
    // One bit for each point.
    unsigned used = 0;
    unsigned lifted = 0;          // the horizon of ns has a say
    unsigned inside = 0;          // lamps are seen from the inside of the shape
    unsigned shiny[kModels] = {}; // has a highlight of this model
};

// What a lamp does to the points of a block; only what belongs to a bit is written.
struct alignas(64) LitByLamp {
    float light[3][LitBlock::kPoints]; // what the sample gets if nothing is in between
    float dir[3][LitBlock::kPoints], tMax[LitBlock::kPoints]; // the ray from the lamp
    unsigned lit = 0;
    unsigned unsure = 0; // of these: only a ray can tell whether something hides the lamp
};

// Some samples of a lamp, for every point of a block: the numbers of the pairs that say where, and
// what they are shuffled and scrambled by (Sampler::PairSeeds). A sun in its middle has one.
struct SamplesOnLamp {
    std::size_t count = 0;
    float share = 1;     // of each sample in the light
    unsigned points = 0; // that are asked: a bit for each
    std::uint32_t first[LitBlock::kPoints] = {}, index[LitBlock::kPoints] = {},
                  x[LitBlock::kPoints] = {}, y[LitBlock::kPoints] = {};
};

// What is known without samples of the light that the points of a block get of a lamp that has a
// size.
struct alignas(64) WholeLight {
    float light[3][LitBlock::kPoints]; // black where it isn't
    unsigned known = 0;                // a bit for each point
};

// Rays from points to places on a lamp, as arrays with room for some registers more; `sum`: a
// number of the point that the light is for.
struct ShadowRayPlaces {
    Vec3 *org, *dir;
    float* tMax;
    std::uint32_t* sum;
    Rgb* weight;
};

// What they do: their light is added to the sum of a point. Of points that something may hide from
// the lamp, nobody knows what, samples become rays instead. Where that is known, and it takes a ray
// to know whether it hides one of them, the point waits: then its sum stays, and these samples and
// all later ones are listed. Sample s of point k is element s * kPoints + k.
struct alignas(64) LitBySamples {
    static constexpr std::size_t kMost = 16; // samples at a time
    static constexpr std::size_t kRoom = LitBlock::kPoints * kMost;
    float sum[3][LitBlock::kPoints] = {};
    float light[3][kRoom], dir[3][kRoom], tMax[kRoom]; // the ray from the point
    std::array<std::uint16_t, kMost> lit, unsure;      // a bit for each point
    unsigned waiting = 0;
    ShadowRayPlaces to{}; // of the next ray
    std::size_t rays = 0;
    std::uint32_t firstSum = 0; // number of the first point
    std::uint64_t shining = 0;  // how many samples would light their points
    bool isLit(std::size_t s, std::size_t k) const { return lit[s] >> k & 1; }
    bool isUnsure(std::size_t s, std::size_t k) const { return unsure[s] >> k & 1; }
};

// Rays are made for the lit points of `withRays`.
using LightByLampFn = void (*)(const PointEmission& lamp, const LitBlock& block, unsigned withRays,
                               LitByLamp& out);

// The points of a block that something may hide from a place on the lamp, and those of them that
// something hides from all of it; and which points each shape may hide.
class Occluders;
struct alignas(64) HiddenPoints {
    static constexpr std::size_t kMostShapes = 16;
    float room[LitBlock::kPoints]; // for rounding, about the lines to the lamp
    std::array<std::uint16_t, kMostShapes> byShape;
    unsigned maybe = 0, surely = 0;
    bool areShapesKnown = false;
};
using HiddenPointsFn = HiddenPoints (*)(const Occluders& occluders, const LitBlock& block,
                                        const LampBall& lamp);
using LightBySamplesFn = void (*)(const LampEmission& lamp, const LitBlock& block,
                                  const SamplesOnLamp& samples, const Occluders& occluders,
                                  const HiddenPoints& hidden, LitBySamples& out);

// Of `points`: those that the lamp can't reach, and those of `unhidden` that have a closed form.
using WholeLightFn = void (*)(const PointEmission& lamp, const LitBlock& block, unsigned points,
                              unsigned unhidden, WholeLight& out);

// Looks for the points of blocks that are `unsure`: those that something hides from the lamp are no
// longer lit, and unsure are those of which only a ray can tell.
struct LampMap; // render/lamp_map/lamp_map.h
using AskLampMapFn = void (*)(const LampMap& map, std::span<const LitBlock> blocks,
                              std::span<LitByLamp> out);

struct LampLanes {
    LightByLampFn byLamp = nullptr;
    LightBySamplesFn bySamples = nullptr;
    WholeLightFn wholeLight = nullptr;
    HiddenPointsFn hiddenPoints = nullptr;
    AskLampMapFn askMap = nullptr;
};
