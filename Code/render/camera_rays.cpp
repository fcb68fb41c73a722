#include "render/camera_rays.h"

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

CameraRays::CameraRays(const IntegratorContext& context)
    : context_(context),
      filter_(filterKind(context.settings.picture.filter), context.settings.picture.filterWidth),
      corners_(context.settings.picture.sampler == SettingsDesc::Sampler::Corners),
      width_(context.settings.picture.width + corners_) {}

void CameraRays::make(const Tile& tile, int first, int count, SampleChunk& chunk) const {
    chunk.ids.clear();
    chunk.cameraRays.clear();
    for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x) {
            const std::uint32_t pixel =
                static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width_) +
                static_cast<std::uint32_t>(x); // wraps in huge pictures
            for (int s = first; s < first + count; ++s)
                add(pixel, x, y, static_cast<std::uint32_t>(s), chunk);
        }
}

void CameraRays::add(std::uint32_t pixel, int x, int y, std::uint32_t sample,
                     SampleChunk& chunk) const {
    const Camera& camera = context_.scene.camera();
    Vec2d place = middle(x, y);
    if (!corners_) {
        const Vec2 offset = filter_.sample(context_.sampler.get2D(pixel, sample, kPixelDimension));
        place = {place.x + offset.x, place.y + offset.y};
    }
    Vec2 lens{0.5f, 0.5f};
    if (camera.hasLens()) lens = context_.sampler.get2D(pixel, sample, kLensDimension);
    float time = 0.5f; // what stands still looks the same at any time
    if (context_.scene.moves()) time = context_.sampler.get1D(pixel, sample, kTimeDimension);
    const auto slot = static_cast<std::uint32_t>(chunk.ids.size());
    chunk.ids.push_back({pixel, sample});
    chunk.cameraRays.push(camera.ray(place, lens, time), slot, {1, 1, 1}, context_.cameraMedium,
                          pixel, true);
}
