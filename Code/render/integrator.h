// Integrator: the light that camera samples receive. One file per integrator beside this one; they
// share the samples, the scratch memory and the record of the first hit.
#pragma once

#include "render/batch.h"
#include "render/query.h"
#include "sample/sampler.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

// One camera sample: which random numbers are its own.
struct SampleId {
    std::uint32_t pixel = 0; // number of the pixel in the whole picture
    std::uint32_t index = 0; // of the sample in its pixel
};

// What the camera ray met, for --aov and the integrators that show it. World units.
struct FirstHit {
    bool hit = false;
    float depth = 0; // along the view axis
    Vec3 normal, position;
    Rgb albedo;
    std::uint32_t object = 0; // index + 1; 0 is nothing
    Vec2 uv;
};

// Choices that hold for a whole picture, made once.
struct IntegratorContext {
    const Scene& scene;
    const RenderSettings& settings;
    Sampler sampler;
    std::vector<Sampler> lightSamplers; // one stream per light
    bool wantsFirstHits;
    MediumTree media; // what camera rays start in, and room for what rays enter
    MediumTree::Inside cameraMedium;

    IntegratorContext(const Scene& scene, const RenderSettings& settings);
};

// The samples of one chunk of a tile, and what comes out of them; slot i is sample i everywhere.
struct SampleChunk {
    std::vector<SampleId> ids;
    PathBatch cameraRays;
    std::vector<Rgb> radiance;
    std::vector<FirstHit> first; // filled only if the context wants it
};

// Scratch memory of one worker, kept between chunks.
struct WaveMemory {
    PathBatch rays, next;
    MediumTree media;
    RayBatch shadowRays;
    std::vector<Hit> hits;
    std::vector<Rgb> transmittance;
};

void integrateWhitted(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                      RayCounts& counts, std::uint64_t& cameraHits);
// Ambient occlusion: the part of the cosine-weighted sky that the first hit sees.
void integrateAo(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                 RayCounts& counts, std::uint64_t& cameraHits);
// normal, depth, albedo, id, uv: shows the first hit.
void integrateFirstHit(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                       RayCounts& counts, std::uint64_t& cameraHits);

FirstHit describeFirstHit(const Scene& scene, const Ray& ray, const struct ShadedPoint& at);
// A colour per object number that neighbours in number do not share.
Rgb objectColor(std::uint32_t object);
