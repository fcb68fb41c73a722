// render(): Scene + RenderSettings -> pictures. Tiles, threads, progress and counters live here;
// the samples of one tile come from TileSampler.
#pragma once

#include "base/function_ref.h"
#include "image/coded_image.h"
#include "image/image.h"
#include "scene/settings.h"
#include "scene/stats.h"

#include <atomic>
#include <vector>

class Scene;

struct AovImage {
    Aov aov;
    Image image;
};
struct Picture {
    Image color;      // linear radiance, exposure not applied
    CodedImage codes; // or this, where no more is wanted: see RenderSettings
    std::vector<AovImage> aovs;
    bool finished = false; // false: stopped before every tile was done; the others are black
};
struct RenderControl {
    // Called from one worker at a time with the part that is done, 0 to 1. Of a function that
    // outlives the call.
    FunctionRef<void(double)> progress = {};
    // Set by a signal handler or a caller; workers look at it between chunks of samples.
    const std::atomic<bool>* stop = nullptr;
    // Returns how long the picture may still take, for a refinement that the clock ends. It may be
    // exceeded by a part of a pass, and by the first pass as a whole.
    FunctionRef<double()> secondsLeft = {};
};

// The picture covers the crop rectangle. Same bits for any number of threads.
Picture render(const Scene& scene, const RenderSettings& settings, const RenderControl& control,
               Stats& stats);
