#include "render/tile_sampler.h"

#include <algorithm>
#include <cstring>
#include <span>

namespace {

void addFirstHit(Film& film, Aov aov, int x, int y, const FirstHit& first) {
    const auto grey = [](float v) { return Rgb{v, v, v}; };
    switch (aov) {
    case Aov::Depth: return film.add(x, y, grey(first.depth));
    case Aov::Normal: return film.add(x, y, {first.normal.x, first.normal.y, first.normal.z});
    case Aov::Position:
        return film.add(x, y, {first.position.x, first.position.y, first.position.z});
    case Aov::Albedo: return film.add(x, y, first.albedo);
    case Aov::Id: return film.add(x, y, grey(static_cast<float>(first.object)));
    case Aov::Samples:
    case Aov::Error: return film.add(x, y, {});
    }
}

// Returns the largest sum of the channels of a sample that is a number.
float largestOf(std::span<const Rgb> samples) {
    float largest = 0;
    for (const Rgb& c : samples)
        if (Film::isNumber(c)) largest = max(largest, c.r + c.g + c.b);
    return largest;
}

} // namespace

TileSampler::TileSampler(const Scene& scene, const RenderSettings& settings)
    : context_(scene, settings), settings_(settings), units_(filmUnitsOf(scene, settings)),
      cameraRays_(context_), emptyTiles_(context_, cameraRays_) {}

bool TileSampler::trace(const Tile& tile, int begin, int samples, TileWorker& worker,
                        const std::atomic<bool>* stop) const {
    worker.color.reset(tile.width(), tile.height(), units_.color);
    for (std::size_t a = 0; a < worker.aovs.size(); ++a)
        worker.aovs[a].reset(tile.width(), tile.height(), units_.aovs[a]);
    worker.largest = 0;
    const int pixels = tile.width() * tile.height();
    if (settings_.refinement && emptyTiles_.isEmpty(tile)) {
        countEmpty(tile, samples, worker.rays);
        worker.color.addToAll(background(), samples);
        for (Film& film : worker.aovs) film.addToAll({}, samples); // nothing was met
        return true;
    }
    const int perChunk = std::max(1, settings_.chunkSamples / pixels);
    const int end = begin + samples;
    for (int first = begin; first < end; first += perChunk) {
        if (stop && stop->load(std::memory_order_relaxed)) return false;
        const int count = std::min(perChunk, end - first);
        traceChunk(tile, first, count, worker);
        collect(tile, first, count, worker);
        if (settings_.refinement)
            worker.largest = max(worker.largest, largestOf(worker.chunk.radiance));
    }
    return true;
}

void TileSampler::countEmpty(const Tile& tile, int samples, RayCounts& counts) {
    const auto rays = static_cast<std::uint64_t>(samples) *
                      static_cast<std::uint64_t>(tile.width() * tile.height());
    counts.camera += rays, counts.skipped.emptyTileRays += rays;
}

void TileSampler::traceChunk(const Tile& tile, int first, int count, TileWorker& worker) const {
    cameraRays_.make(tile, first, count, worker.chunk);
    worker.rays.skipped.rayNumbers += numbersLeftOut() * worker.chunk.cameraRays.size();
    worker.chunk.radiance.resize(worker.chunk.cameraRays.size());
    std::memset(static_cast<void*>(worker.chunk.radiance.data()), 0,
                worker.chunk.radiance.size() * sizeof(Rgb));
    if (context_.wantsFirstHits)
        worker.chunk.first.assign(worker.chunk.cameraRays.size(), FirstHit{});
    integrate(worker);
}

void TileSampler::traceOnce(const Tile& tile, TileWorker& worker) const {
    traceChunk(tile, 0, 1, worker);
    const Rgb* sample = worker.chunk.radiance.data();
    Rgb* const pixels = worker.tile.pixels().data();
    const std::ptrdiff_t width = worker.tile.width();
    const auto take = [&](int x, int y) {
        Rgb& sum = pixels[y * width + x];
        if (Film::isNumber(*sample))
            sum = WholeSum::rounded(*sample, units_.color);
        else
            sum = {}, ++worker.nanSamples;
        ++sample;
    };
    const auto takeTwo = [&](int x, int y) {
        if (!Film::isNumber(sample[0]) || !Film::isNumber(sample[1])) {
            take(x, y), take(x + 1, y);
            return;
        }
        Rgb* const sum = &pixels[y * width + x];
        sum[0] = WholeSum::rounded(sample[0], units_.color);
        sum[1] = WholeSum::rounded(sample[1], units_.color);
        sample += 2;
    };
    const auto takeSquare = [&](int left, int top) { forEachTwo(left, top, takeTwo); };
    forEachSquare({0, 0, tile.width(), tile.height()}, takeSquare, take);
}

void TileSampler::integrate(TileWorker& w) const {
    switch (settings_.picture.integrator) {
    case IntegratorKind::Whitted:
        return integrateWhitted(context_, w.chunk, w.memory, w.rays, w.cameraHits);
    case IntegratorKind::Path:
        return integratePath(context_, w.chunk, w.memory, w.rays, w.cameraHits);
    case IntegratorKind::Ao: return integrateAo(context_, w.chunk, w.memory, w.rays, w.cameraHits);
    case IntegratorKind::Normal:
    case IntegratorKind::Depth:
    case IntegratorKind::Albedo:
    case IntegratorKind::Id:
    case IntegratorKind::Uv: break;
    }
    integrateFirstHit(context_, w.chunk, w.memory, w.rays, w.cameraHits);
}

Rgb TileSampler::background() const {
    switch (settings_.picture.integrator) {
    case IntegratorKind::Whitted:
    case IntegratorKind::Path: return context_.scene.background(Vec3{0, 0, 1});
    case IntegratorKind::Ao: return {1, 1, 1};
    case IntegratorKind::Normal:
    case IntegratorKind::Depth:
    case IntegratorKind::Albedo:
    case IntegratorKind::Id:
    case IntegratorKind::Uv: break;
    }
    return {};
}

void TileSampler::collect(const Tile& tile, int first, int count, TileWorker& worker) const {
    const auto each = static_cast<std::size_t>(count);
    std::size_t slot = 0;
    const auto samplesOf = [&](std::size_t places) {
        const std::size_t from = slot;
        slot += places * each;
        return std::span(worker.chunk.radiance).subspan(from, places * each);
    };
    const auto take = [&](int x, int y) {
        worker.nanSamples += worker.color.addNumbers(x, y, samplesOf(1));
    };
    const auto takeTwo = [&](int x, int y) { take(x, y), take(x + 1, y); };
    const auto takeSquare = [&](int left, int top) { forEachTwo(left, top, takeTwo); };
    const Tile places{0, 0, tile.width(), tile.height()};
    forEachSquare(places, takeSquare, take);
    if (!settings_.aovs.empty()) collectFirstHits(places, first, count, worker);
}

void TileSampler::collectFirstHits(const Tile& places, int first, int count,
                                   TileWorker& worker) const {
    std::size_t slot = 0;
    forEachPlace(places, [&](int x, int y) {
        for (int s = first; s < first + count; ++s, ++slot)
            for (std::size_t a = 0; a < settings_.aovs.size(); ++a) {
                // Numbers of objects can't be averaged: the first sample stands for all.
                if (settings_.aovs[a] == Aov::Id && s > 0) continue;
                addFirstHit(worker.aovs[a], settings_.aovs[a], x, y, worker.chunk.first[slot]);
            }
    });
}
