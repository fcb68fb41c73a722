// TileSampler: the samples of one tile, from camera rays to a worker's films. What a ray sees is in
// whitted.cpp and first_hit.cpp. Threads share it, each with a worker of its own.
#pragma once

#include "film/film.h"
#include "film/film_units.h"
#include "integrate/integrator.h"
#include "render/camera_rays.h"
#include "render/empty_tiles.h"

#include <atomic>
#include <cstdint>
#include <vector>

// What a thread writes to. Two cache lines: processors fetch them in pairs, and counters are
// written all the time.
struct alignas(128) TileWorker {
    SampleChunk chunk;
    WaveMemory memory;
    Film color;
    std::vector<Film> aovs; // as in the settings
    Image tile;             // what it becomes
    RayCounts rays;
    std::uint64_t cameraHits = 0, nanSamples = 0;
    float largest = 0; // with a refinement: of the samples of the last trace(), the largest sum of channels
};

class TileSampler {
public:
    TileSampler(const Scene& scene, const RenderSettings& settings);
    TileSampler(const TileSampler&) = delete;
    TileSampler& operator=(const TileSampler&) = delete;

    bool throughCorners() const { return cameraRays_.throughCorners(); }
    const IntegratorContext& context() const { return context_; }
    double reach() const { return cameraRays_.reach(); }
    // Random numbers that each camera ray does without.
    std::uint64_t numbersLeftOut() const { return cameraRays_.numbersLeftOut(); }
    const FilmUnits& units() const { return units_; }

    // Traces samples begin .. begin + samples - 1 of all places of the tile, into the worker's
    // films. Returns false when *stop became true before the last of them: a tile of many samples
    // takes longer than a user waits.
    bool trace(const Tile& tile, int begin, int samples, TileWorker& worker,
               const std::atomic<bool>* stop) const;
    // The same for the only sample of each place, into the worker's tile: what a film would make of
    // it.
    void traceOnce(const Tile& tile, TileWorker& worker) const;

    // Camera rays through such a tile meet nothing; false says nothing.
    bool isEmpty(const Tile& tile) const { return emptyTiles_.isEmpty(tile); }
    // What they see then, where that is the same for all.
    Rgb background() const;
    // Counts so many samples of each place of such a tile.
    static void countEmpty(const Tile& tile, int samples, RayCounts& counts);

private:
    void traceChunk(const Tile& tile, int first, int count, TileWorker& worker) const;
    void integrate(TileWorker& worker) const;
    void collect(const Tile& tile, int first, int count, TileWorker& worker) const;
    void collectFirstHits(const Tile& places, int first, int count, TileWorker& worker) const;

    IntegratorContext context_;
    const RenderSettings& settings_;
    FilmUnits units_;
    CameraRays cameraRays_;
    EmptyTiles emptyTiles_;
};
