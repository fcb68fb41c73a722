// Integrator: the light that camera samples receive. Whitted and path are in path/, the others in
// first_hit.cpp; they share the samples, the scratch memory and the record of the first hit.
#pragma once

#include "base/raw_vector.h"
#include "render/batch.h"
#include "render/lens_lanes.h"
#include "render/path/path_memory.h"
#include "render/point_columns.h"
#include "render/point_lists.h"
#include "render/query.h"
#include "render/sample_numbers.h"
#include "render/shading.h"
#include "render/waves/picture_lanes.h"
#include "sample/dimensions.h"
#include "sample/hash.h"
#include "sample/sampler.h"

#include <cstdint>
#include <span>
#include <vector>

// What the camera ray met, for --aov and the integrators that show it. World units.
struct FirstHit {
    bool hit = false;
    float depth = 0; // along the view axis
    Vec3 normal, position;
    Rgb albedo;
    std::uint32_t object = 0; // index + 1; 0 is nothing
    Vec2 uv;
};

// Shapes whose surfaces lanes find, to be looked up without touching them.
struct StillsInLanes {
    struct One {
        const StillShape* shape = nullptr; // null: it is none
        std::uint8_t parts = 0;
        std::uint8_t caps = 0;
        StillShape::Kind kind{};
        bool wantsUv = false;
        StillShape::Kind kindOf(std::uint32_t part) const {
            return caps >> part & 1 ? StillShape::Kind::Cap : kind;
        }
    };
    std::vector<One> shapes; // by number; empty: lanes do none
};

// Choices that hold for a whole picture, made once.
struct IntegratorContext {
    const Scene& scene;
    const RenderSettings& settings;
    Sampler sampler;
    float cutoff; // rays with less weight are not traced
    bool wantsFirstHits;
    SurfaceNeeds surfaceNeeds;
    SurfaceLanes surfaceLanes;
    TextureColorsFn textureColors;         // null: one by one
    EnvironmentColorsFn environmentColors; // the same
    StillsInLanes stillsInLanes;
    Sampler skySampler;                // of ambient light
    std::vector<Sampler> lampSamplers; // of scene.pathLights(), by number
    MediumTree media;                  // what camera rays start in, and room for what rays enter
    MediumTree::Inside cameraMedium;

    IntegratorContext(const Scene& scene, const RenderSettings& settings);
};

// The samples of one chunk of a tile, and what comes out of them; slot i is sample i everywhere.
struct SampleChunk {
    SampleNumbers sampleNumber;        // in its pixel
    std::vector<PlaceBlock> places;    // slot after slot; those on the lens, if there is one
    std::vector<Vec2> numbers;         // for who draws them without lanes
    PathBatch cameraRays;              // `stream` is the number of the pixel in the whole picture
    std::size_t raysWithConstants = 0; // see CameraRays::make()
    std::vector<Rgb> radiance;
    std::vector<FirstHit> first; // filled only if the context wants it
};

// The points that the rays of a wave have met; element k of every array is point k.
struct PointBatch {
    std::size_t count = 0;             // the arrays may be longer
    std::vector<std::uint32_t> ray;    // ascending
    std::vector<std::uint32_t> missed; // rays that have met nothing, ascending
    std::size_t missedCount = 0;
    std::vector<std::uint32_t> slot; // of its sample
    PointColumns at;
    std::vector<Rgb> weight; // of what the surface sends to the eye

    // Makes room for `most` points; lanes may look at whole blocks.
    void clear(std::size_t most) {
        count = missedCount = 0;
        if (most == 0 || ray.size() >= most) return;
        at.resize(most);
        const std::size_t room = at.size();
        ray.resize(room), missed.resize(room), slot.resize(room), weight.resize(room);
    }
    std::size_t blocks() const {
        return (count + PointColumns::kPoints - 1) / PointColumns::kPoints;
    }
    // How many points of a block there are, and a bit for each.
    std::size_t sizeOf(std::size_t block) const {
        return std::min(count - block * PointColumns::kPoints, PointColumns::kPoints);
    }
    unsigned usedOf(std::size_t block) const { return (1u << sizeOf(block)) - 1; }
};

// Scratch memory of one worker, kept between chunks.
struct WaveMemory {
    PathBatch rays, next;
    std::vector<Hit> hits;
    PointBatch points;
    PointLists pointLists;
    MediumTree media;
    RawVector<Rgb> backgrounds; // that missed rays see
    RayBatch shadowRays;
    std::vector<std::uint8_t> hidden;
    std::vector<Rgb> transmittance;
    PathMemory path;
};

// Ambient occlusion: the part of the cosine-weighted sky that the first hit sees.
void integrateAo(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                 RayCounts& counts, std::uint64_t& cameraHits);
// normal, depth, albedo, id, uv: shows the first hit.
void integrateFirstHit(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                       RayCounts& counts, std::uint64_t& cameraHits);

struct Wave;
// The points of a wave of camera rays, into chunk.first.
void describeFirstHits(const Wave& wave);
// A colour per object number that neighbours in number do not share.
Rgb objectColor(std::uint32_t object);
