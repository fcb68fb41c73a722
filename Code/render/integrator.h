// Integrator: the light that camera samples receive. One file per integrator beside this one; they
// share the samples, the scratch memory and the record of the first hit.
#pragma once

#include "render/batch.h"
#include "render/occluders.h"
#include "render/query.h"
#include "render/shading.h"
#include "render/waves/bounce_lanes.h"
#include "render/waves/lamp_lanes.h"
#include "render/waves/steps.h"
#include "render/waves/texture_points.h"
#include "sample/dimensions.h"
#include "sample/hash.h"
#include "sample/sampler.h"

#include <array>
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

// A light of the scene, and how the picture asks it.
struct Lamp {
    const Light& light;
    bool isSoft; // sampled at `samples` random places; else in its centre
    int samples;
    Sampler sampler;
    std::optional<Vec3> origin; // where its shadow rays start; none: at the point that is lit
    std::optional<PointEmission> emission;
    // Ask many points at once, in its centre or at its samples; null: one by one.
    LightByLampFn inLanes = nullptr;
    LightBySamplesFn bySamples = nullptr;
    HiddenPointsFn hiddenPoints = nullptr; // of what bySamples asks
};

// A shape whose surfaces lanes find, to be looked up without touching it.
struct RoundShape {
    const StillShape* shape = nullptr; // null: it is none
    std::uint32_t part = 0;
    StillShape::Round kind{};
};

// Choices that hold for a whole picture, made once.
struct IntegratorContext {
    const Scene& scene;
    const RenderSettings& settings;
    Sampler sampler;
    // Lamps that give light, in the order of the scene: with shadows, and without.
    std::vector<Lamp> shadingLamps, openLamps;
    Occluders occluders;
    float cutoff; // rays with less weight are not traced
    Steps steps;  // of the waves
    bool wantsFirstHits;
    SurfaceNeeds surfaceNeeds;
    SurfaceLanes surfaceLanes;
    TextureColorsFn textureColors;       // null: one by one
    BouncesFn bouncesInLanes;            // null: one by one
    std::vector<RoundShape> roundShapes; // by shape; empty: lanes do none
    MediumTree media;                    // what camera rays start in, and room for what rays enter
    MediumTree::Inside cameraMedium;

    IntegratorContext(const Scene& scene, const RenderSettings& settings);
};

// The samples of one chunk of a tile, and what comes out of them; slot i is sample i everywhere.
struct SampleChunk {
    std::vector<SampleId> ids;
    std::vector<std::uint32_t> pixels; // of the ids, where each has one sample
    std::vector<Vec2d> places;         // in the picture, in pixels
    std::vector<Vec2> offsets;         // of these from the middle of their pixel
    std::vector<Vec2> onLens;          // numbers for places on the lens, if there is one
    PathBatch cameraRays;
    std::size_t raysWithConstants = 0; // see CameraRays::make()
    std::vector<Rgb> radiance;
    std::vector<FirstHit> first; // filled only if the context wants it
};

// The points that the rays of a wave have met; element k of every array is point k.
struct PointBatch {
    std::size_t count = 0;          // the arrays may be longer
    std::vector<std::uint32_t> ray; // ascending
    std::vector<ShadedPoint> at;
    std::vector<const Material*> material; // numbers at this point
    std::vector<Material> textured;        // those with textures applied
    std::vector<Rgb> weight;               // of what the surface sends to the eye

    // Makes room for `most` points.
    void clear(std::size_t most) {
        count = 0;
        if (ray.size() >= most) return;
        ray.resize(most), at.resize(most), material.resize(most), textured.resize(most);
        weight.resize(most);
    }
};

// Some of them, whose surfaces are found together, and their rays.
struct PointsToDescribe {
    std::vector<std::uint32_t> rays, points;
    std::vector<const StillShape*> shapes; // of those for lanes
    void clear() { rays.clear(), points.clear(), shapes.clear(); }
    void push(std::uint32_t ray, std::uint32_t point) {
        rays.push_back(ray), points.push_back(point);
    }
};

// Light that a lamp sends by way of a point.
struct Arrival {
    std::uint32_t point;
    Rgb light;
};

// Light of a lamp's sample that waits for a ray, or behind one that does.
struct WaitingLight {
    static constexpr std::uint32_t kNoRay = 0xffffffffu;
    std::uint32_t point, ray; // of memory.shadowRays
    Rgb light;
};

// Points of a wave that lie on one shape.
struct PointGroup {
    std::uint32_t shape;
    bool inside; // lamps are seen from the inside of the shape
    Bounds box;
    bool mayBeHidden = true; // from the lamp that is looked at
};

// What lamps ask of a point, in one piece.
struct LitPoint {
    std::uint32_t point;
    bool isLifted; // ns of its surface has a say
    Vec3 p, n, ng, toEye;
    Rgb weight;
    const Material* material;
};

// Scratch memory of one worker, kept between chunks.
struct WaveMemory {
    PathBatch rays, next;
    std::vector<Hit> hits;
    PointBatch points;
    std::array<PointsToDescribe, StillShape::kRounds> onRound;
    PointsToDescribe onOthers;
    TexturedPoints texturedPoints;
    MediumTree media;
    std::vector<std::uint32_t> answering; // points that answer lamps
    std::vector<LitBlock> litBlocks;      // these, if lamps want blocks
    std::vector<PointGroup> groups;       // of these, and which of them each is in
    std::vector<std::uint8_t> groupOf;
    RayBatch shadowRays; // of one lamp; their samples are points
    std::vector<std::uint8_t> hidden;
    std::vector<Rgb> transmittance;
    std::vector<Rgb> lampLight;        // of a lamp with a size, by point
    std::vector<WaitingLight> waiting; // to be added to it
    std::vector<Arrival> arrivals, arrivalsInOrder;
    std::vector<std::uint32_t> arrivalStarts;
};

void integrateWhitted(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                      RayCounts& counts, std::uint64_t& cameraHits);
// Ambient occlusion: the part of the cosine-weighted sky that the first hit sees.
void integrateAo(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                 RayCounts& counts, std::uint64_t& cameraHits);
// normal, depth, albedo, id, uv: shows the first hit.
void integrateFirstHit(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                       RayCounts& counts, std::uint64_t& cameraHits);

FirstHit describeFirstHit(const Scene& scene, const Ray& ray, const ShadedPoint& at);
// A colour per object number that neighbours in number do not share.
Rgb objectColor(std::uint32_t object);
