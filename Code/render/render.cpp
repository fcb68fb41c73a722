#include "render/render.h"

#include "base/parallel.h"
#include "render/camera_rays.h"
#include "render/canvas.h"
#include "render/empty_tiles.h"
#include "render/film.h"
#include "render/goal_film.h"
#include "render/integrator.h"
#include "render/shading_form.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>

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
        color_.emplace(area_.width(), area_.height(), wantedCodes());
        for (std::size_t i = 0; i < settings.aovs.size(); ++i)
            aovs_.emplace_back(area_.width(), area_.height());
        for (int y = area_.y0; y < area_.y1; y += side_)
            for (int x = area_.x0; x < area_.x1; x += side_)
                tiles_.push_back(
                    {x, y, std::min(x + side_, area_.x1), std::min(y + side_, area_.y1)});
    }

    Picture run(const RenderControl& control, Stats& stats) {
        std::vector<Worker> workers(static_cast<std::size_t>(pool_.threads()));
        for (Worker& worker : workers) {
            worker.aovs.resize(aovs_.size());
            worker.tile = Image(std::min(side_, area_.width()), std::min(side_, area_.height()));
        }
        Picture picture;
        if (settings_.errorGoal)
            picture.finished = renderToGoal(pool_, workers, control, picture, stats);
        else
            picture.finished = renderTiles(pool_, workers, control, stats);
        stats.shading = shadingForm(context_);
        for (const Worker& worker : workers) {
            stats.rays += worker.rays;
            stats.cameraHits += worker.cameraHits;
            stats.nanSamples += worker.nanSamples;
        }
        picture.codes = std::move(color_->codes());
        picture.color = pixelsOf(std::move(color_->image()), false);
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
        Image tile; // what it becomes
        RayCounts rays;
        std::uint64_t cameraHits = 0, nanSamples = 0;
    };

    // Calls job(index, worker) for all; they are the part from `begun` to `finished` of the work.
    template <class Job>
    static bool runJobs(ThreadPool& pool, std::size_t count, const RenderControl& control,
                        double begun, double finished, const Job& job) {
        std::mutex progressMutex;
        std::atomic<std::size_t> done{0};
        const auto one = [&](std::size_t index, int worker) {
            job(index, static_cast<std::size_t>(worker));
            const bool isLast = ++done == count;
            if (!control.progress) return;
            // Nobody waits to tell: who tells now counts this job as well. The end has to be told.
            std::unique_lock lock(progressMutex, std::defer_lock);
            if (isLast)
                lock.lock();
            else if (!lock.try_lock())
                return;
            const double part = static_cast<double>(done) / static_cast<double>(count);
            control.progress(begun + part * (finished - begun));
        };
        return pool.run(count, one, control.stop);
    }

    bool renderTiles(ThreadPool& pool, std::vector<Worker>& workers, const RenderControl& control,
                     Stats& stats) {
        stats.samplesMin = stats.samplesMean = stats.samplesMax = settings_.picture.samplesPerPixel;
        return runJobs(pool, tiles_.size(), control, 0, 1, [&](std::size_t i, std::size_t worker) {
            renderTile(tiles_[i], workers[worker]);
        });
    }

    // In rounds, each of which adds samples where the picture needs them.
    bool renderToGoal(ThreadPool& pool, std::vector<Worker>& workers, const RenderControl& control,
                      Picture& picture, Stats& stats) {
        GoalFilm film(area_.width(), area_.height(), settings_);
        double told = 0; // progress never falls, though the work ahead may turn out to be more
        for (;;) {
            const std::vector<Tile> parts = film.nextRound();
            if (parts.empty()) break;
            const double begun = std::max(told, film.share().begun);
            told = std::max(begun, film.share().done);
            const auto addBatch = [&](std::size_t index, std::size_t number) {
                const Tile& part = parts[index];
                Worker& worker = workers[number];
                traceSamples({part.x0 + area_.x0, part.y0 + area_.y0, part.x1 + area_.x0,
                              part.y1 + area_.y0},
                             film.samplesOf(part), film.batchOf(part), worker);
                film.add(part, worker.color, worker.aovs);
            };
            if (!runJobs(pool, parts.size(), control, begun, told, addBatch)) return false;
        }
        if (control.progress) control.progress(1);
        film.color().writeMeans(color_->image(), 0, 0);
        for (std::size_t a = 0; a < aovs_.size(); ++a) writeAov(film.aov(a), a, 0, 0);
        picture.error = film.error();
        film.describe(stats);
        return true;
    }

    void writeAov(const Film& film, std::size_t number, int x, int y) {
        if (settings_.aovs[number] == Aov::Samples)
            film.writeCounts(aovs_[number], x, y);
        else
            film.writeMeans(aovs_[number], x, y);
    }

    void renderTile(const Tile& tile, Worker& worker) {
        if (emptyTiles_.isEmpty(tile)) return showBackground(tile, worker);
        if (settings_.picture.samplesPerPixel == 1 && aovs_.empty())
            return showSamples(tile, worker);
        traceSamples(tile, 0, settings_.picture.samplesPerPixel, worker);
        worker.color.writeMeans(worker.tile, 0, 0);
        paint(tile, worker);
        const int x = tile.x0 - area_.x0, y = tile.y0 - area_.y0;
        for (std::size_t a = 0; a < aovs_.size(); ++a) writeAov(worker.aovs[a], a, x, y);
    }

    // The samples first .. first + samples - 1 of all places of the tile, into the worker's films.
    void traceSamples(const Tile& tile, int begin, int samples, Worker& worker) {
        worker.color.reset(tile.width(), tile.height());
        for (Film& film : worker.aovs) film.reset(tile.width(), tile.height());
        const int pixels = tile.width() * tile.height();
        if (settings_.errorGoal && emptyTiles_.isEmpty(tile)) {
            worker.rays.camera +=
                static_cast<std::uint64_t>(samples) * static_cast<std::uint64_t>(pixels);
            worker.color.addToAll(background(), samples);
            for (Film& film : worker.aovs) film.addToAll({}, samples); // nothing was met
            return;
        }
        const int perChunk = std::max(1, settings_.chunkSamples / pixels);
        const int end = begin + samples;
        for (int first = begin; first < end; first += perChunk) {
            const int count = std::min(perChunk, end - first);
            traceChunk(tile, first, count, worker);
            collect(tile, first, count, worker);
        }
    }

    void traceChunk(const Tile& tile, int first, int count, Worker& worker) {
        cameraRays_.make(tile, first, count, worker.chunk);
        worker.chunk.radiance.assign(worker.chunk.ids.size(), Rgb{});
        if (context_.wantsFirstHits) worker.chunk.first.assign(worker.chunk.ids.size(), FirstHit{});
        integrate(worker);
    }

    // What a film would of one sample in each place.
    void showSamples(const Tile& tile, Worker& worker) {
        traceChunk(tile, 0, 1, worker);
        std::size_t slot = 0;
        forEachPlace({0, 0, tile.width(), tile.height()}, [&](int x, int y) {
            Rgb sum; // a sum is never -0
            if (const Rgb radiance = worker.chunk.radiance[slot++]; isFinite(radiance))
                sum += radiance;
            else
                ++worker.nanSamples;
            worker.tile.setPixel(x, y, sum);
        });
        paint(tile, worker);
    }

    void paint(const Tile& tile, const Worker& worker) {
        color_->paint(
            {tile.x0 - area_.x0, tile.y0 - area_.y0, tile.x1 - area_.x0, tile.y1 - area_.y0},
            worker.tile);
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
        std::ranges::fill(worker.tile.pixels(), meanOf(seen));
        paint(tile, worker);
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

    // Where pixels are made of corners or of sums that grow, all of them are needed to the end.
    std::optional<Encoding::Transfer> wantedCodes() const {
        if (!settings_.onlyCodes || settings_.errorGoal || cameraRays_.throughCorners()) return {};
        return settings_.picture.transfer == SettingsDesc::Transfer::Srgb
                   ? Encoding::Transfer::Srgb
                   : Encoding::Transfer::Linear;
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
        forEachPlace({0, 0, tile.width(), tile.height()}, [&](int x, int y) {
            for (int s = first; s < first + count; ++s, ++slot) {
                const Rgb radiance = worker.chunk.radiance[slot];
                if (isFinite(radiance))
                    worker.color.add(x, y, radiance);
                else
                    ++worker.nanSamples;
                for (std::size_t a = 0; a < aovs_.size(); ++a) {
                    // Numbers of objects can't be averaged: the first sample stands for all.
                    if (settings_.aovs[a] == Aov::Id && s > 0) continue;
                    addFirstHit(worker.aovs[a], settings_.aovs[a], x, y, worker.chunk.first[slot]);
                }
            }
        });
    }

    ThreadPool pool_; // first: its threads start while the rest is set up
    IntegratorContext context_;
    const RenderSettings& settings_;
    CameraRays cameraRays_;
    EmptyTiles emptyTiles_;
    Tile area_;
    // About a thousand rays make a wave; those of one sample each are in a larger tile.
    const int side_ = settings_.tileSide * (settings_.picture.samplesPerPixel == 1 ? 2 : 1);
    std::vector<Tile> tiles_;
    std::optional<Canvas> color_; // of places, as the aovs
    std::vector<Image> aovs_;
};

} // namespace

Picture render(const Scene& scene, const RenderSettings& settings, const RenderControl& control,
               Stats& stats) {
    return Renderer(scene, settings).run(control, stats);
}
