// IntegratorContext: what holds for all of a picture.
#pragma once

#include "accel/kernels/surface_lanes.h"
#include "accel/still_shape.h"
#include "integrate/checkers.h"
#include "sample/sampler.h"
#include "scene/medium_tree.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "shape/shape.h"
#include "texture/picture_lanes.h"

#include <cstdint>
#include <vector>

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
    bool raysMeetLight; // rays that lobes send may meet something that shines
    SurfaceNeeds surfaceNeeds;
    SurfaceLanes surfaceLanes;
    const PictureLanes& pictures;
    std::vector<Checker> checkers; // empty: squares are seen as points
    // What part of a pixel's width a sample stands for; 0: pictures are looked up at points.
    float footprintScale;
    // The part of all directions that one sample of a pixel stands for.
    float inverseSamples;
    StillsInLanes stillsInLanes;
    Sampler skySampler;                // of ambient light
    std::vector<Sampler> lampSamplers; // of scene.pathLights(), by number
    MediumTree media;                  // what camera rays start in, and room for what rays enter
    MediumTree::Inside cameraMedium;

    bool filtersTextures() const { return footprintScale > 0; }

    IntegratorContext(const Scene& scene, const RenderSettings& settings);
};
