// Integrator: the light that camera samples receive. One file per integrator beside this one; they
// share the samples, the scratch memory and the record of the first hit.
#pragma once

#include "base/raw_vector.h"
#include "render/batch.h"
#include "render/lamp_map/lamp_map.h"
#include "render/lens_lanes.h"
#include "render/material_table.h"
#include "render/occluders.h"
#include "render/path/path_memory.h"
#include "render/point_columns.h"
#include "render/point_lists.h"
#include "render/query.h"
#include "render/sample_numbers.h"
#include "render/shading.h"
#include "render/waves/bounce_lanes.h"
#include "render/waves/lamp_lanes.h"
#include "render/waves/picture_lanes.h"
#include "render/waves/shade_lanes.h"
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
    std::optional<PointEmission> emission; // as it is in its centre
    std::optional<LampEmission> all;       // as its samples are, or as the same
    // Ask many points at once, in its centre or at its samples; null: one by one.
    LightByLampFn inLanes = nullptr;
    LightBySamplesFn bySamples = nullptr;
    PairSeedsFn seeds = nullptr;           // of what bySamples draws
    HiddenPointsFn hiddenPoints = nullptr; // of what bySamples asks, if it is round
    WholeLightFn wholeLight = nullptr;     // the same
    bool asksWhole = false; // casts no shadows, and its closed form is quicker than its samples
    std::optional<LampBall> ball{}; // set if points that nothing hides from it get the closed form
    std::shared_ptr<const LampMap> map{}; // of what inLanes asks, if there is one
    AskLampMapFn askMap = nullptr;
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
    // Lamps that give light, in the order of the scene: with shadows, and without.
    std::vector<Lamp> shadingLamps, openLamps;
    Occluders occluders;
    float cutoff; // rays with less weight are not traced
    Steps steps;  // of the waves
    bool wantsFirstHits;
    SurfaceNeeds surfaceNeeds;
    SurfaceLanes surfaceLanes;
    ShadeLanes shadeLanes;
    TextureColorsFn textureColors;         // null: one by one
    EnvironmentColorsFn environmentColors; // the same
    BounceLanes bounceLanes;               // the same
    PairSeedsFn pairSeeds;                 // the same; of Sobol numbers, there are no others
    StillsInLanes stillsInLanes;
    Sampler skySampler;                // of ambient light
    std::vector<Sampler> lampSamplers; // of scene.pathLights(), by number
    MaterialTable materials;
    MediumTree media; // what camera rays start in, and room for what rays enter
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

// What the points of a block are made of.
struct PaintedBlock {
    const Material* all = nullptr;  // the numbers of all of them; null: they differ
    bool isTextured = false;        // some are; else a bit for each point that
    std::uint16_t answersLamps = 0; // has such a material,
    std::uint16_t mirrors = 0;      // or such a one
};

// The points that the rays of a wave have met; element k of every array is point k.
struct PointBatch {
    std::size_t count = 0;             // the arrays may be longer
    std::vector<std::uint32_t> ray;    // ascending
    std::vector<std::uint32_t> missed; // rays that have met nothing, ascending
    std::size_t missedCount = 0;
    std::vector<std::uint32_t> slot;  // of its sample
    std::vector<std::uint32_t> shape; // that it is on
    PointColumns at;
    std::vector<const Material*> material; // numbers at this point
    std::vector<PaintedBlock> painted;     // by block
    RawVector<Material> textured;          // those with textures applied
    std::vector<Rgb> weight;               // of what the surface sends to the eye

    // Makes room for `most` points; lanes may look at whole blocks.
    void clear(std::size_t most) {
        count = missedCount = 0;
        if (most == 0 || ray.size() >= most) return;
        at.resize(most);
        const std::size_t room = at.size();
        ray.resize(room), missed.resize(room), slot.resize(room), shape.resize(room),
            material.resize(room), textured.resize(room), weight.resize(room);
        painted.resize(room / PointColumns::kPoints);
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

// Light that a lamp sends by way of a point.
struct Arrival {
    std::uint32_t point;
    Rgb light;
};

// Light of a lamp's sample that waits for a ray, or behind one that does.
struct WaitingLight {
    static constexpr std::uint32_t kNoRay = 0xffffffffu;
    std::uint32_t place, ray; // among those that answer lamps; of memory.shadowRays
    Rgb light;
};

// Points of a wave that lie on one shape.
struct PointGroup {
    static constexpr std::size_t kMost = 4; // of a wave
    std::uint32_t shape;
    bool inside; // lamps are seen from the inside of the shape
    Bounds box;
    bool mayBeHidden = true; // from the lamp that is looked at
};

// What lamps ask of a point, in one piece.
struct LitPoint {
    std::uint32_t point;
    Vec3 p, n, ng; // on the side that is lit
    Vec3 ns, lift; // where it is lifted, ns has a say
    Vec3 toEye;
    float error, rayError;
    Rgb weight;
    const Material* material;
};

// Shadow rays of point lamps: most of what they are made of is the same for all.
struct LampRays {
    RayBatch rays;
    std::size_t ready = 0; // so many have it
};

// Scratch memory of one worker, kept between chunks.
struct WaveMemory {
    PathBatch rays, next;
    std::vector<Hit> hits;
    PointBatch points;
    PointLists pointLists;
    TexturedPoints texturedPoints;
    MediumTree media;
    RawVector<Rgb> backgrounds;         // that missed rays see
    RawVector<std::uint32_t> answering; // points that answer lamps
    std::vector<LitBlock> litBlocks;    // these, if lamps want blocks
    std::vector<PointGroup> groups;     // of these
    // By block of sixteen of them: a bit for each that is in the group.
    std::vector<std::array<std::uint16_t, PointGroup::kMost>> inGroups;
    RayBatch shadowRays; // of one lamp; their samples are points
    LampRays lampRays;
    std::vector<LitByLamp> byLamp;    // by block
    std::vector<LightSums> lightSums; // the same
    std::vector<std::uint8_t> hidden;
    std::vector<Rgb> transmittance;
    std::vector<WaitingLight> waiting; // to be added to these
    std::vector<Rgb> lampLight;        // of a lamp with a size that lanes don't do, by point
    std::vector<Arrival> arrivals, arrivalsInOrder;
    std::vector<std::uint32_t> arrivalStarts;
    PathMemory path;
};

void integrateWhitted(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                      RayCounts& counts, std::uint64_t& cameraHits);
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
