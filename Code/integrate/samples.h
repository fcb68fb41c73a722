// SampleChunk: the samples of one chunk of a tile, from their camera rays to the light that they
// receive.
#pragma once

#include "camera/camera_lanes.h"
#include "integrate/batch.h"

#include <cstdint>
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

// The samples of one chunk of a tile, and what comes out of them; slot i is sample i everywhere.
struct SampleChunk {
    SampleNumbers sampleNumber;        // in its pixel
    std::vector<PlaceBlock> places;    // slot after slot; those on the lens, if there is one
    PathBatch cameraRays;              // `stream` is the number of the pixel in the whole picture
    std::size_t raysWithConstants = 0; // see CameraRays::make()
    std::vector<Rgb> radiance;
    std::vector<FirstHit> first; // filled only if the context wants it
};
