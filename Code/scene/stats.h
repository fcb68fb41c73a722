// Counters of one render. Every worker has its own; they are summed at the end.
#pragma once

#include "scene/settings.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

struct RayCounts {
    std::uint64_t camera = 0, reflect = 0, refract = 0, indirect = 0;
    // Asked: one for every sample of a lamp that casts shadows and would light a point, however it
    // is known what is in between. Where no sample is drawn, all that a lamp has count at points
    // that are known to be in its shadow, none where the light is known in closed form.
    std::uint64_t shadow = 0;
    std::uint64_t tracedShadow = 0; // those of them for which a ray was traced
    // All that were traced.
    std::uint64_t total() const { return camera + tracedShadow + reflect + refract + indirect; }
    RayCounts& operator+=(const RayCounts& o) {
        camera += o.camera, shadow += o.shadow, reflect += o.reflect, refract += o.refract;
        indirect += o.indirect, tracedShadow += o.tracedShadow;
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
