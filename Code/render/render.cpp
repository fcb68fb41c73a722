#include "render/render.h"

#include "base/parallel.h"
#include "render/camera_medium.h"
#include "render/film.h"
#include "render/integrator.h"
#include "sample/dimensions.h"
#include "sample/filter.h"

#include <algorithm>
#include <mutex>

namespace {

struct Rect {
    int x0, y0, x1, y1; // x1, y1 exclusive
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
};

SamplerKind samplerKind(SettingsDesc::Sampler kind) {
    switch (kind) {
    case SettingsDesc::Sampler::Stratified: return SamplerKind::Stratified;
    case SettingsDesc::Sampler::Random: return SamplerKind::Random;
    case SettingsDesc::Sampler::Grid:
    case SettingsDesc::Sampler::Corners: return SamplerKind::Grid;
    case SettingsDesc::Sampler::Sobol: break;
    }
    return SamplerKind::Sobol;
}

FilterKind filterKind(SettingsDesc::Filter kind) {
    switch (kind) {
    case SettingsDesc::Filter::Box: return FilterKind::Box;
    case SettingsDesc::Filter::Tent: return FilterKind::Tent;
    case SettingsDesc::Filter::Gaussian: return FilterKind::Gaussian;
    case SettingsDesc::Filter::BlackmanHarris: break;
    }
    return FilterKind::BlackmanHarris;
}

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

// Everything that the workers share; only the films are written, each pixel by one worker.
class Renderer {
public:
    Renderer(const Scene& scene, const RenderSettings& settings)
        : context_(scene, settings), settings_(settings),
          filter_(filterKind(settings.picture.filter), settings.picture.filterWidth),
          corners_(settings.picture.sampler == SettingsDesc::Sampler::Corners),
          width_(settings.picture.width + corners_), area_{0, 0, settings.picture.width,
                                                           settings.picture.height},
          color_(1, 1) {
        if (const auto& crop = settings.picture.crop)
            area_ = {(*crop)[0], (*crop)[1], (*crop)[2], (*crop)[3]};
        area_.x1 += corners_;
        area_.y1 += corners_;
        color_ = Film(area_.width(), area_.height());
        for (std::size_t i = 0; i < settings.aovs.size(); ++i)
            aovs_.emplace_back(area_.width(), area_.height());
        const int side = settings.tileSide;
        for (int y = area_.y0; y < area_.y1; y += side)
            for (int x = area_.x0; x < area_.x1; x += side)
                tiles_.push_back({x, y, std::min(x + side, area_.x1), std::min(y + side, area_.y1)});
    }

    Picture run(const RenderControl& control, Stats& stats) {
        ThreadPool pool(settings_.threads);
        std::vector<Worker> workers(static_cast<std::size_t>(pool.threads()));
        std::mutex progressMutex;
        std::size_t done = 0;
        const auto tile = [&](std::size_t index, int worker) {
            renderTile(tiles_[index], workers[static_cast<std::size_t>(worker)]);
            const std::lock_guard lock(progressMutex);
            ++done;
            if (control.progress)
                control.progress(static_cast<double>(done) / static_cast<double>(tiles_.size()));
        };
        Picture picture;
        picture.finished = pool.run(tiles_.size(), tile, control.stop);
        for (const Worker& worker : workers) {
            stats.rays += worker.rays;
            stats.cameraHits += worker.cameraHits;
            stats.nanSamples += worker.nanSamples;
        }
        const double samples = settings_.picture.samplesPerPixel;
        stats.samplesMin = stats.samplesMean = stats.samplesMax = samples;
        picture.color = pixelsOf(color_.mean(), false);
        for (std::size_t i = 0; i < aovs_.size(); ++i) {
            const Aov aov = settings_.aovs[i];
            Image image = aov == Aov::Samples ? aovs_[i].samples() : aovs_[i].mean();
            picture.aovs.push_back({aov, pixelsOf(std::move(image), aov == Aov::Id)});
        }
        return picture;
    }

private:
    struct Worker {
        SampleChunk chunk;
        WaveMemory memory;
        RayCounts rays;
        std::uint64_t cameraHits = 0, nanSamples = 0;
    };

    void renderTile(const Rect& tile, Worker& worker) {
        const int pixels = tile.width() * tile.height();
        const int samples = settings_.picture.samplesPerPixel;
        const int perChunk = std::max(1, settings_.chunkSamples / pixels);
        for (int first = 0; first < samples; first += perChunk) {
            const int count = std::min(perChunk, samples - first);
            makeSamples(tile, first, count, worker.chunk);
            integrate(worker);
            collect(tile, count, worker);
        }
    }

    Image pixelsOf(Image places, bool areNumbers) const {
        if (!corners_) return places;
        return areNumbers ? Film::upperLeftCorners(places) : Film::meanOfCorners(places);
    }

    // Camera rays for samples first .. first + count - 1 of every pixel, pixel after pixel.
    void makeSamples(const Rect& tile, int first, int count, SampleChunk& chunk) {
        chunk.ids.clear();
        chunk.cameraRays.clear();
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x)
                for (int s = first; s < first + count; ++s) addCameraRay(x, y, s, chunk);
        chunk.radiance.assign(chunk.ids.size(), Rgb{});
        if (context_.wantsFirstHits) chunk.first.assign(chunk.ids.size(), FirstHit{});
    }

    void addCameraRay(int x, int y, int s, SampleChunk& chunk) {
        const std::uint32_t pixel =
            static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width_) +
            static_cast<std::uint32_t>(x); // wraps in huge pictures
        const auto sample = static_cast<std::uint32_t>(s);
        Vec2d place{static_cast<double>(x),
                    static_cast<double>(y)}; // the pixel's upper left corner
        if (!corners_) {
            const Vec2 offset =
                filter_.sample(context_.sampler.get2D(pixel, sample, kPixelDimension));
            place = {x + 0.5 + offset.x, y + 0.5 + offset.y};
        }
        Vec2 lens{0.5f, 0.5f};
        if (context_.scene.camera().hasLens())
            lens = context_.sampler.get2D(pixel, sample, kLensDimension);
        float time = 0.5f; // what stands still looks the same at any time
        if (context_.scene.moves()) time = context_.sampler.get1D(pixel, sample, kTimeDimension);
        const Ray ray = context_.scene.camera().ray(place, lens, time);
        const auto slot = static_cast<std::uint32_t>(chunk.ids.size());
        chunk.ids.push_back({pixel, sample});
        chunk.cameraRays.push(ray, slot, {1, 1, 1}, context_.cameraMedium, pixel, true);
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

    // Samples go to the film in the order of their numbers, whatever the size of the chunks.
    void collect(const Rect& tile, int count, Worker& worker) {
        std::size_t slot = 0;
        for (int y = tile.y0; y < tile.y1; ++y) {
            for (int x = tile.x0; x < tile.x1; ++x) {
                for (int s = 0; s < count; ++s, ++slot) {
                    const Rgb radiance = worker.chunk.radiance[slot];
                    if (isFinite(radiance))
                        color_.add(x - area_.x0, y - area_.y0, radiance);
                    else
                        ++worker.nanSamples;
                    for (std::size_t a = 0; a < aovs_.size(); ++a) {
                        // Numbers of objects can't be averaged: the first sample stands for all.
                        if (settings_.aovs[a] == Aov::Id && worker.chunk.ids[slot].index > 0)
                            continue;
                        addFirstHit(aovs_[a], settings_.aovs[a], x - area_.x0, y - area_.y0,
                                    worker.chunk.first[slot]);
                    }
                }
            }
        }
    }

    IntegratorContext context_;
    const RenderSettings& settings_;
    Filter filter_;
    bool corners_; // samples lie on the corners of pixels; places are those, one more each way
    int width_;    // of the whole picture, in places
    Rect area_;
    std::vector<Rect> tiles_;
    Film color_;
    std::vector<Film> aovs_;
};

bool needsFirstHits(const RenderSettings& settings) {
    return !settings.aovs.empty() || (settings.integrator != IntegratorKind::Whitted &&
                                      settings.integrator != IntegratorKind::Ao);
}

} // namespace

IntegratorContext::IntegratorContext(const Scene& theScene, const RenderSettings& theSettings)
    : scene(theScene), settings(theSettings),
      sampler(samplerKind(theSettings.picture.sampler), theSettings.picture.samplesPerPixel,
              theSettings.picture.seed, theSettings.picture.jitter),
      wantsFirstHits(needsFirstHits(theSettings)),
      cameraMedium(mediumOfCamera(theScene, theSettings, media)) {
    for (std::size_t i = 0; i < scene.lights().size(); ++i)
        lightSamplers.push_back(
            sampler.stream(static_cast<std::uint32_t>(i) + 1, settings.picture.lightSamples));
}

Picture render(const Scene& scene, const RenderSettings& settings, const RenderControl& control,
               Stats& stats) {
    return Renderer(scene, settings).run(control, stats);
}
