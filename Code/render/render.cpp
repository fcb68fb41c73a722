#include "render/render.h"

#include "base/parallel.h"
#include "film/canvas.h"
#include "film/adaptive_film.h"
#include "render/denoised.h"
#include "render/thin_places.h"
#include "render/tile_sampler.h"
#include "scene/settings.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>

namespace {

// Everything that the workers share; only the pictures are written, each pixel by one worker.
class Renderer {
public:
    Renderer(const Scene& scene, const RenderSettings& settings)
        : pool_(settings.threads), sampler_(scene, settings),
          settings_(settings), area_{0, 0, settings.picture.width, settings.picture.height} {
        if (const auto& crop = settings.picture.crop)
            area_ = {(*crop)[0], (*crop)[1], (*crop)[2], (*crop)[3]};
        area_.x1 += sampler_.throughCorners();
        area_.y1 += sampler_.throughCorners();
        color_.emplace(area_.width(), area_.height(), wantedCodes());
        for (std::size_t i = 0; i < settings.aovs.size(); ++i)
            aovs_.emplace_back(area_.width(), area_.height());
        for (int y = area_.y0; y < area_.y1; y += side_)
            for (int x = area_.x0; x < area_.x1; x += side_)
                tiles_.push_back(
                    {x, y, std::min(x + side_, area_.x1), std::min(y + side_, area_.y1)});
    }

    Picture run(const RenderControl& control, Stats& stats) {
        std::vector<TileWorker> workers(static_cast<std::size_t>(pool_.threads()));
        for (TileWorker& worker : workers) {
            worker.aovs.resize(aovs_.size());
            worker.tile = Image(std::min(side_, area_.width()), std::min(side_, area_.height()));
        }
        Picture picture;
        if (settings_.refinement)
            picture.finished = renderPasses(pool_, workers, control, stats);
        else
            picture.finished = renderTiles(pool_, workers, control, stats);
        for (const TileWorker& worker : workers) {
            stats.rays += worker.rays;
            stats.cameraHits += worker.cameraHits;
            stats.nanSamples += worker.nanSamples;
        }
        picture.codes = std::move(color_->codes());
        picture.color = denoised_ ? std::move(*denoised_) : pixelsOf(std::move(color_->image()), false);
        for (std::size_t i = 0; i < aovs_.size(); ++i) {
            const Aov aov = settings_.aovs[i];
            picture.aovs.push_back({aov, pixelsOf(std::move(aovs_[i]), aov == Aov::Id)});
        }
        return picture;
    }

private:
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

    bool renderTiles(ThreadPool& pool, std::vector<TileWorker>& workers,
                     const RenderControl& control, Stats& stats) {
        stats.samplesMin = stats.samplesMean = stats.samplesMax = settings_.picture.samplesPerPixel;
        std::atomic<bool> allWhole = true;
        const auto renderOne = [&](std::size_t i, std::size_t worker) {
            if (!renderTile(tiles_[i], workers[worker], control.stop)) allWhole = false;
        };
        return runJobs(pool, tiles_.size(), control, 0, 1, renderOne) && allWhole;
    }

    // In passes, each of which adds samples where the picture needs them. The clock decides how many there are,
    // and nothing else.
    bool renderPasses(ThreadPool& pool, std::vector<TileWorker>& workers,
                      const RenderControl& control, Stats& stats) {
        AdaptiveFilm film(area_, settings_, sampler_.units());
        if (settings_.refinement->evenDoublings == 0) sampleThinPlaces(film);
        double told = 0; // progress never falls, though the work ahead may turn out to be more
        double secondsPerSample = 0;
        std::atomic<bool> allWhole = true;
        while (allWhole) {
            const double secondsBefore = control.secondsLeft ? control.secondsLeft() : 0;
            const std::vector<SamplePlan::Part> parts = film.nextPass(pool);
            if (parts.empty()) break;
            double samples = 0;
            for (const SamplePlan::Part& part : parts)
                samples += static_cast<double>(part.batch) * part.tile.width() * part.tile.height();
            if (secondsPerSample > 0 && samples * secondsPerSample > control.secondsLeft()) {
                film.cancelPass();
                break;
            }
            const double begun = std::max(told, film.share().begun);
            told = std::max(begun, film.share().done);
            const auto addBatch = [&](std::size_t index, std::size_t number) {
                const SamplePlan::Part& part = parts[index];
                TileWorker& worker = workers[number];
                if (sampler_.trace(part.tile, part.before, part.batch, worker, control.stop))
                    film.add(part, worker.color, worker.largest, worker.aovs);
                else
                    allWhole = false;
            };
            if (!runJobs(pool, parts.size(), control, begun, told, addBatch)) allWhole = false;
            if (control.secondsLeft)
                secondsPerSample = (secondsBefore - control.secondsLeft()) / samples;
        }
        if (control.progress && allWhole) control.progress(1);
        film.color().writeMeans(color_->image(), 0, 0);
        for (std::size_t a = 0; a < aovs_.size(); ++a)
            if (settings_.aovs[a] == Aov::Error)
                aovs_[a] = film.error();
            else
                writeAov(film.aov(a), a, 0, 0);
        film.describe(stats);
        if (settings_.picture.denoise && allWhole && film.showsNoise()) denoise(film, stats);
        return allWhole;
    }

    void sampleThinPlaces(AdaptiveFilm& film) const {
        const ThinPlaces thin(sampler_.context().scene, settings_.picture.width,
                              settings_.picture.height, sampler_.reach());
        static_assert(ThinPlaces::kSide == NoiseMap::kGroupSide);
        for (int row = 0; row < thin.rows(); ++row)
            for (int column = 0; column < thin.columns(); ++column)
                film.setLeast(column, row, thin.samples(column, row));
    }

    void denoise(AdaptiveFilm& film, Stats& stats) {
        const auto guide = [&](Aov aov) {
            const auto at = std::find(settings_.aovs.begin(), settings_.aovs.end(), aov);
            const auto number = static_cast<std::size_t>(at - settings_.aovs.begin());
            return HalvedImage{pixelsOf(aovs_[number], false), pixelsOf(film.aovDifference(number), false)};
        };
        const HalvedPicture halves{
            {pixelsOf(color_->image(), false), pixelsOf(film.difference(), false)},
            guide(Aov::Albedo),
            guide(Aov::Normal)};
        const ErrorMeasure measure(settings_.refinement->unit, exact::exp2(settings_.picture.exposureEv),
                                   settings_.picture.transfer);
        DenoisedPicture picture = denoisedPicture(halves, pixelsOf(film.pastDifferences(), false), measure,
                                                  *settings_.isa, settings_.threads);
        denoised_ = std::move(picture.color);
        stats.denoisedError = picture.error;
    }

    void writeAov(const Film& film, std::size_t number, int x, int y) {
        if (settings_.aovs[number] == Aov::Samples)
            film.writeCounts(aovs_[number], x, y);
        else
            film.writeMeans(aovs_[number], x, y);
    }

    // Returns false when it was stopped, and has painted nothing then.
    bool renderTile(const Tile& tile, TileWorker& worker, const std::atomic<bool>* stop) {
        if (sampler_.isEmpty(tile)) {
            showBackground(tile, worker);
            return true;
        }
        if (settings_.picture.samplesPerPixel == 1 && aovs_.empty()) {
            sampler_.traceOnce(tile, worker);
            paint(tile, worker);
            return true;
        }
        if (!sampler_.trace(tile, 0, settings_.picture.samplesPerPixel, worker, stop)) return false;
        worker.color.writeMeans(worker.tile, 0, 0);
        paint(tile, worker);
        const Tile to = onCanvas(tile);
        for (std::size_t a = 0; a < aovs_.size(); ++a) writeAov(worker.aovs[a], a, to.x0, to.y0);
        return true;
    }

    // The tile, as the picture counts it, where the canvas has it.
    Tile onCanvas(const Tile& tile) const {
        return {tile.x0 - area_.x0, tile.y0 - area_.y0, tile.x1 - area_.x0, tile.y1 - area_.y0};
    }
    void paint(const Tile& tile, const TileWorker& worker) {
        color_->paint(onCanvas(tile), worker.tile);
    }

    // What renderTile() would, of samples that are all the same.
    void showBackground(const Tile& tile, TileWorker& worker) {
        TileSampler::countEmpty(tile, settings_.picture.samplesPerPixel, worker.rays);
        worker.color.reset(1, 1, sampler_.units().color);
        worker.color.addToAll(sampler_.background(), settings_.picture.samplesPerPixel);
        color_->fill(onCanvas(tile), worker.color.mean(0, 0));
        const float samples = static_cast<float>(settings_.picture.samplesPerPixel);
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
    std::optional<Encoding> wantedCodes() const {
        if (!settings_.onlyCodes || settings_.refinement || sampler_.throughCorners()) return {};
        return encodingOf(settings_, 8);
    }

    Image pixelsOf(Image places, bool areNumbers) const {
        if (!sampler_.throughCorners()) return places;
        return areNumbers ? Film::upperLeftCorners(places) : Film::meanOfCorners(places);
    }

    ThreadPool pool_; // first: its threads start while the rest is set up
    TileSampler sampler_;
    const RenderSettings& settings_;
    Tile area_;
    // About a thousand rays make a wave; those of one sample each are in a larger tile.
    const int side_ = settings_.tileSide * (settings_.picture.samplesPerPixel == 1 ? 2 : 1);
    std::vector<Tile> tiles_;
    std::optional<Canvas> color_; // of places, as the aovs
    std::vector<Image> aovs_;
    std::optional<Image> denoised_; // of pixels
};

// Returns settings that render what denoise() looks at besides the colour as well, and the noise by doublings.
RenderSettings settingsToDenoise(RenderSettings settings) {
    for (const Aov aov : {Aov::Albedo, Aov::Normal})
        if (std::find(settings.aovs.begin(), settings.aovs.end(), aov) == settings.aovs.end())
            settings.aovs.push_back(aov);
    if (settings.refinement) return settings;
    SettingsDesc& picture = settings.picture;
    settings.refinement = Refinement{.mostSamples = picture.samplesPerPixel, .evenDoublings = 3};
    // Samples in cells are spread over each half, as those of a part of all cells say nothing of the others.
    if (picture.sampler == SettingsDesc::Sampler::Stratified || picture.sampler == SettingsDesc::Sampler::Grid) {
        picture.samplesPerPixel = std::max(1, picture.samplesPerPixel / 2);
        settings.refinement->evenDoublings = 1;
    }
    return settings;
}

} // namespace

Picture render(const Scene& scene, const RenderSettings& settings, const RenderControl& control,
               Stats& stats) {
    if (!settings.picture.denoise) return Renderer(scene, settings).run(control, stats);
    const RenderSettings all = settingsToDenoise(settings);
    Picture picture = Renderer(scene, all).run(control, stats);
    picture.aovs.resize(settings.aovs.size());
    return picture;
}
