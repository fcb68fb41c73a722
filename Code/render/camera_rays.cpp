#include "render/camera_rays.h"

#include <algorithm>

namespace {

FilterKind filterKind(SettingsDesc::Filter kind) {
    switch (kind) {
    case SettingsDesc::Filter::Box: return FilterKind::Box;
    case SettingsDesc::Filter::Tent: return FilterKind::Tent;
    case SettingsDesc::Filter::Gaussian: return FilterKind::Gaussian;
    case SettingsDesc::Filter::BlackmanHarris: break;
    }
    return FilterKind::BlackmanHarris;
}

} // namespace

CameraRays::CameraRays(const IntegratorContext& context, ThreadPool* pool)
    : context_(context), filter_(filterKind(context.settings.picture.filter),
                                 context.settings.picture.filterWidth, pool),
      corners_(context.settings.picture.sampler == SettingsDesc::Sampler::Corners),
      width_(context.settings.picture.width + corners_) {}

// Which pixel and sample each slot is, and where in the picture it lies.
void CameraRays::choosePlaces(const Tile& tile, int first, int count, SampleChunk& chunk) const {
    const auto samples = static_cast<std::size_t>(count);
    const auto begin = static_cast<std::uint32_t>(first);
    const auto all = static_cast<std::size_t>(tile.width() * tile.height()) * samples;
    chunk.ids.resize(all);
    chunk.places.resize(all);
    chunk.offsets.resize(all);
    std::size_t slot = 0;
    forEachPlace(tile, [&](int x, int y) {
        const std::uint32_t pixel =
            static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width_) +
            static_cast<std::uint32_t>(x); // wraps in huge pictures
        if (!corners_ && samples > 1)
            context_.sampler.get2D(pixel, begin, kPixelDimension,
                                   std::span(chunk.offsets).subspan(slot, samples));
        for (std::uint32_t s = begin; s < begin + samples; ++s, ++slot) {
            chunk.ids[slot] = {pixel, s};
            chunk.places[slot] = middle(x, y);
        }
    });
    if (corners_) return;
    if (samples == 1) {
        chunk.pixels.resize(all);
        for (std::size_t i = 0; i < all; ++i) chunk.pixels[i] = chunk.ids[i].pixel;
        context_.sampler.get2D(chunk.pixels, begin, kPixelDimension, chunk.offsets);
    }
    filter_.sample(chunk.offsets);
    for (std::size_t i = 0; i < chunk.places.size(); ++i) {
        const Vec2d middle = chunk.places[i];
        chunk.places[i] = {middle.x + chunk.offsets[i].x, middle.y + chunk.offsets[i].y};
    }
}

// The samples of a place follow each other.
void CameraRays::chooseLensPlaces(int first, int count, SampleChunk& chunk) const {
    const auto samples = static_cast<std::size_t>(count);
    chunk.onLens.resize(chunk.ids.size());
    for (std::size_t slot = 0; slot < chunk.ids.size(); slot += samples)
        context_.sampler.get2D(chunk.ids[slot].pixel, static_cast<std::uint32_t>(first),
                               kLensDimension, std::span(chunk.onLens).subspan(slot, samples));
}

void CameraRays::make(const Tile& tile, int first, int count, SampleChunk& chunk) const {
    const Camera& camera = context_.scene.camera();
    const Sampler& sampler = context_.sampler;
    choosePlaces(tile, first, count, chunk);

    PathBatch& rays = chunk.cameraRays;
    // What all rays of a picture share is written once.
    const std::size_t known = chunk.raysWithConstants;
    rays.setSize(chunk.ids.size());
    chunk.raysWithConstants = std::max(known, rays.size());
    // The general form draws what it may not need; who does not use it does not notice.
    const bool isGeneral = !context_.settings.specialise;
    const bool hasTime = isGeneral || context_.scene.moves();
    const bool hasLens = isGeneral || camera.hasLens();
    const bool isPinhole = !hasTime && !hasLens && camera.hasSharedOrigin();
    if (isPinhole) camera.pinholeRays(chunk.places, rays.dir, rays.tMin);
    const Vec3 origin = camera.ray({0, 0}, {0.5f, 0.5f}, 0.5f).org;
    for (std::size_t i = known; i < rays.size(); ++i) {
        rays.org[i] = origin;
        rays.sample[i] = static_cast<std::uint32_t>(i);
        rays.weight[i] = {1, 1, 1};
        rays.medium[i] = context_.cameraMedium;
        rays.seesLights[i] = true;
        rays.tMax[i] = kInfinityF;
        rays.time[i] = 0.5f; // what stands still looks the same at any time
    }
    for (std::size_t i = 0; i < rays.size(); ++i) rays.stream[i] = chunk.ids[i].pixel;
    if (isPinhole) return;
    if (hasLens) chooseLensPlaces(first, count, chunk);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const SampleId id = chunk.ids[i];
        if (hasTime) rays.time[i] = sampler.get1D(id.pixel, id.index, kTimeDimension);
        Vec2 lens{0.5f, 0.5f};
        if (hasLens) lens = chunk.onLens[i];
        const Ray ray = camera.ray(chunk.places[i], lens, rays.time[i]);
        rays.org[i] = ray.org;
        rays.dir[i] = ray.dir;
        rays.tMin[i] = ray.tMin;
    }
}
