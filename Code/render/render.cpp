#include "render/render.h"

#include "base/parallel.h"
#include "render/camera_rays.h"
#include "render/empty_tiles.h"
#include "render/film.h"
#include "render/integrator.h"

#include <algorithm>
#include <atomic>
#include <mutex>

namespace {

bool isFinite(Rgb c) {
    const float sum = c.r + c.g + c.b;
    return sum - sum == 0;
}

void addFirstHit(Film& film, Aov aov, int x, int y, const FirstHit& first) {
    const auto grey = [](float v) { return Rgb{v, v, v}; };
    switch (aov) {
    case Aov::Depth: return film.add(x, y, grey(first.depth));
    case Aov::Normal: return film.add(x, y, {first.normal.x, first.normal.y, first.normal.z});
    case Aov::Position:
        return film.add(x, y, {first.position.x, first.position.y, first.position.z});
    case Aov::Albedo: return film.add(x, y, first.albedo);
    case Aov::Id: return film.add(x, y, grey(static_cast<float>(first.object)));
    case Aov::Samples: return film.add(x, y, {});
    }
}

// Everything that the workers share; only the pictures are written, each pixel by one worker.
class Renderer {
public:
    Renderer(const Scene& scene, const RenderSettings& settings)
        : pool_(settings.threads), context_(scene, settings), settings_(settings),
          cameraRays_(context_, &pool_),
          emptyTiles_(context_, cameraRays_), area_{0, 0, settings.picture.width,
                                                    settings.picture.height} {
        if (const auto& crop = settings.picture.crop)
            area_ = {(*crop)[0], (*crop)[1], (*crop)[2], (*crop)[3]};
        area_.x1 += cameraRays_.throughCorners();
        area_.y1 += cameraRays_.throughCorners();
        color_ = Image(area_.width(), area_.height());
        for (std::size_t i = 0; i < settings.aovs.size(); ++i)
            aovs_.emplace_back(area_.width(), area_.height());
        const int side = settings.tileSide;
        for (int y = area_.y0; y < area_.y1; y += side)
            for (int x = area_.x0; x < area_.x1; x += side)
                tiles_.push_back(
                    {x, y, std::min(x + side, area_.x1), std::min(y + side, area_.y1)});
    }

    Picture run(const RenderControl& control, Stats& stats) {
        std::vector<Worker> workers(static_cast<std::size_t>(pool_.threads()));
        for (Worker& worker : workers) worker.aovs.resize(aovs_.size());
        std::mutex progressMutex;
        std::atomic<std::size_t> done{0};
        const auto tile = [&](std::size_t index, int worker) {
            renderTile(tiles_[index], workers[static_cast<std::size_t>(worker)]);
            const bool isLast = ++done == tiles_.size();
            if (!control.progress) return;
            // Nobody waits to tell: who tells now counts this tile as well. The end has to be told.
            std::unique_lock lock(progressMutex, std::defer_lock);
            if (isLast)
                lock.lock();
            else if (!lock.try_lock())
                return;
            control.progress(static_cast<double>(done) / static_cast<double>(tiles_.size()));
        };
        Picture picture;
        picture.finished = pool_.run(tiles_.size(), tile, control.stop);
        for (const Worker& worker : workers) {
            stats.rays += worker.rays;
            stats.cameraHits += worker.cameraHits;
            stats.nanSamples += worker.nanSamples;
        }
        const double samples = settings_.picture.samplesPerPixel;
        stats.samplesMin = stats.samplesMean = stats.samplesMax = samples;
        picture.color = pixelsOf(std::move(color_), false);
        for (std::size_t i = 0; i < aovs_.size(); ++i) {
            const Aov aov = settings_.aovs[i];
            picture.aovs.push_back({aov, pixelsOf(std::move(aovs_[i]), aov == Aov::Id)});
        }
        return picture;
    }

private:
    // Two cache lines: processors fetch them in pairs, and counters are written all the time.
    struct alignas(128) Worker {
        SampleChunk chunk;
        WaveMemory memory;
        Film color;
        std::vector<Film> aovs;
        RayCounts rays;
        std::uint64_t cameraHits = 0, nanSamples = 0;
    };

    void renderTile(const Tile& tile, Worker& worker) {
        if (emptyTiles_.isEmpty(tile)) return showBackground(tile, worker);
        worker.color.reset(tile.width(), tile.height());
        for (Film& film : worker.aovs) film.reset(tile.width(), tile.height());
        const int pixels = tile.width() * tile.height();
        const int samples = settings_.picture.samplesPerPixel;
        const int perChunk = std::max(1, settings_.chunkSamples / pixels);
        for (int first = 0; first < samples; first += perChunk) {
            const int count = std::min(perChunk, samples - first);
            cameraRays_.make(tile, first, count, worker.chunk);
            worker.chunk.radiance.assign(worker.chunk.ids.size(), Rgb{});
            if (context_.wantsFirstHits)
                worker.chunk.first.assign(worker.chunk.ids.size(), FirstHit{});
            integrate(worker);
            collect(tile, first, count, worker);
        }
        const int x = tile.x0 - area_.x0, y = tile.y0 - area_.y0;
        worker.color.writeMeans(color_, x, y);
        for (std::size_t a = 0; a < aovs_.size(); ++a)
            if (settings_.aovs[a] == Aov::Samples)
                worker.aovs[a].writeCounts(aovs_[a], x, y);
            else
                worker.aovs[a].writeMeans(aovs_[a], x, y);
    }

    // What renderTile() would, of samples that are all the same.
    void showBackground(const Tile& tile, Worker& worker) {
        const Rgb seen = background();
        const auto count = static_cast<std::uint64_t>(settings_.picture.samplesPerPixel);
        worker.rays.camera += count * static_cast<std::uint64_t>(tile.width() * tile.height());
        const auto meanOf = [&](Rgb sample) {
            worker.color.reset(1, 1);
            for (std::uint64_t s = 0; s < count; ++s) worker.color.add(0, 0, sample);
            return worker.color.mean(0, 0);
        };
        fill(color_, tile, meanOf(seen));
        const float samples = static_cast<float>(count);
        for (std::size_t a = 0; a < aovs_.size(); ++a)
            if (settings_.aovs[a] == Aov::Samples)
                fill(aovs_[a], tile, {samples, samples, samples}); // else nothing was met: black
    }

    void fill(Image& image, const Tile& tile, Rgb value) const {
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x)
                image.setPixel(x - area_.x0, y - area_.y0, value);
    }

    Image pixelsOf(Image places, bool areNumbers) const {
        if (!cameraRays_.throughCorners()) return places;
        return areNumbers ? Film::upperLeftCorners(places) : Film::meanOfCorners(places);
    }

    void integrate(Worker& w) {
        switch (settings_.integrator) {
        case IntegratorKind::Whitted:
            return integrateWhitted(context_, w.chunk, w.memory, w.rays, w.cameraHits);
        case IntegratorKind::Ao:
            return integrateAo(context_, w.chunk, w.memory, w.rays, w.cameraHits);
        case IntegratorKind::Normal:
        case IntegratorKind::Depth:
        case IntegratorKind::Albedo:
        case IntegratorKind::Id:
        case IntegratorKind::Uv: break;
        }
        integrateFirstHit(context_, w.chunk, w.memory, w.rays, w.cameraHits);
    }

    // What integrate() gives for camera rays that meet nothing, where that is the same for all.
    Rgb background() const {
        switch (settings_.integrator) {
        case IntegratorKind::Whitted: return context_.scene.background({0, 0, 1});
        case IntegratorKind::Ao: return {1, 1, 1};
        case IntegratorKind::Normal:
        case IntegratorKind::Depth:
        case IntegratorKind::Albedo:
        case IntegratorKind::Id:
        case IntegratorKind::Uv: break;
        }
        return {};
    }

    // Samples go to the film in the order of their numbers, whatever the size of the chunks.
    void collect(const Tile& tile, int first, int count, Worker& worker) {
        std::size_t slot = 0;
        for (int y = 0; y < tile.height(); ++y)
            for (int x = 0; x < tile.width(); ++x)
                for (int s = first; s < first + count; ++s, ++slot) {
                    const Rgb radiance = worker.chunk.radiance[slot];
                    if (isFinite(radiance))
                        worker.color.add(x, y, radiance);
                    else
                        ++worker.nanSamples;
                    for (std::size_t a = 0; a < aovs_.size(); ++a) {
                        // Numbers of objects can't be averaged: the first sample stands for all.
                        if (settings_.aovs[a] == Aov::Id && s > 0) continue;
                        addFirstHit(worker.aovs[a], settings_.aovs[a], x, y,
                                    worker.chunk.first[slot]);
                    }
                }
    }

    ThreadPool pool_; // first: its threads start while the rest is set up
    IntegratorContext context_;
    const RenderSettings& settings_;
    CameraRays cameraRays_;
    EmptyTiles emptyTiles_;
    Tile area_;
    std::vector<Tile> tiles_;
    Image color_; // of places, as the aovs
    std::vector<Image> aovs_;
};

} // namespace

Picture render(const Scene& scene, const RenderSettings& settings, const RenderControl& control,
               Stats& stats) {
    return Renderer(scene, settings).run(control, stats);
}
