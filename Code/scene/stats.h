// Counters of one render. Every worker has its own; they are summed at the end.
#pragma once

#include "scene/settings.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// Work that a picture would need if nothing were known before it is done. It is counted by the tile,
// the wave or the block of points, and by the ray only where one is left out.
struct SkippedWork {
    std::uint64_t emptyTileRays = 0; // camera rays through tiles that show no shape
    std::uint64_t rayNumbers = 0;    // random numbers that make camera rays, of sharp and still pictures
    std::uint64_t unlitSamples = 0;  // of lamps: behind the horizon, out of reach, or not reflected
    std::uint64_t unshadedPoints = 0; // on what only shines or is black, and at the ends of paths
    std::uint64_t weakRays = 0;       // with less weight than the cutoff
    std::uint64_t endedPaths = 0;     // by Russian roulette
    std::uint64_t sharedRays = 0;     // of two lobes that send the same ray

    SkippedWork& operator+=(const SkippedWork& o) {
        emptyTileRays += o.emptyTileRays, rayNumbers += o.rayNumbers;
        unlitSamples += o.unlitSamples, unshadedPoints += o.unshadedPoints;
        weakRays += o.weakRays, endedPaths += o.endedPaths, sharedRays += o.sharedRays;
        return *this;
    }
};

struct RayCounts {
    // Camera rays are samples of the picture, those of empty tiles included.
    std::uint64_t camera = 0, reflect = 0, refract = 0, indirect = 0;
    // Samples of lamps that would light a point if nothing is in between.
    std::uint64_t shadow = 0;
    std::uint64_t tracedShadow = 0; // those of lamps that cast shadows
    std::uint64_t points = 0;       // that rays have met
    SkippedWork skipped;
    // All that were traced.
    std::uint64_t total() const {
        return camera - skipped.emptyTileRays + tracedShadow + reflect + refract + indirect;
    }
    RayCounts& operator+=(const RayCounts& o) {
        camera += o.camera, shadow += o.shadow, reflect += o.reflect, refract += o.refract;
        indirect += o.indirect, tracedShadow += o.tracedShadow, points += o.points;
        skipped += o.skipped;
        return *this;
    }
};

struct AccelStats {
    std::string kind;
    std::uint64_t nodes = 0, leaves = 0, bytes = 0, primitives = 0;
    std::uint64_t triangles = 0, meshBytes = 0; // points, indices and trees of the meshes
    double sah = 0; // surface-area-heuristic cost of the top tree and its meshes
};

// What a picture with a refinement has come to.
struct ErrorStats {
    std::optional<double> goal;
    ErrorUnit unit = ErrorUnit::Display;
    bool ofWorstBlock = false;
    double estimate = 0; // the upper bound of the RMSE, right in 95 % of all cases
    int passes = 0;
    int mostSamples = 0;            // that a pixel may have
    std::uint64_t cappedPixels = 0; // have as many, and an error above the goal
    std::uint64_t unsureBlocks = 0; // one sample is a tenth of their light or more
};

struct Stats {
    double parseSeconds = 0, buildSeconds = 0, renderSeconds = 0, writeSeconds = 0,
           totalSeconds = 0;
    RayCounts rays;
    std::uint64_t cameraHits = 0;
    AccelStats accel;
    std::uint64_t peakBytes = 0;
    std::uint64_t mipBytes = 0; // smaller copies of pictures, made while they were looked up
    std::uint64_t unmadeMipBytes = 0;     // those that were not looked up
    std::uint64_t unreadPictureBytes = 0; // files of pictures that nothing shows
    std::uint64_t readPictureBytes = 0;   // the others
    int threads = 1;
    std::string kernel;
    std::vector<std::string> featuresNeeded,
        featuresSkipped; // skipped: "dof: aperture_radius is 0"
    double samplesMin = 0, samplesMean = 0, samplesMax = 0;
    std::optional<ErrorStats> error;        // with --error, --time, --passes
    std::optional<double> denoisedError;    // with --denoise: RMSE of what is left, if the noise is known
    std::uint64_t nanSamples = 0;           // samples dropped because a value was not finite
    std::uint64_t degeneratePrimitives = 0; // triangles without area, left out of the trees
};
