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

CameraRays::CameraRays(const IntegratorContext& context)
    : context_(context),
      filter_(filterKind(context.settings.picture.filter), context.settings.picture.filterWidth),
      lanes_(cameraLanes(chooseKernel(context.settings.kernel))),
      corners_(context.settings.picture.sampler == SettingsDesc::Sampler::Corners),
      width_(context.settings.picture.width + corners_) {
    const SettingsDesc& picture = context.settings.picture;
    if (corners_)
        fixed_ = Vec2{};
    else if (picture.samplesPerPixel == 1 && !picture.jitter && context.settings.specialise)
        fixed_ = filter_.sample({0.5f, 0.5f}); // see Sampler
}

template <class Fn> void CameraRays::forEachSlot(const Tile& tile, const Fn& fn) const {
    std::size_t slot = 0;
    forEachPlace(tile, [&](int x, int y) {
        fn(slot++,
           static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(width_) +
               static_cast<std::uint32_t>(x), // wraps in huge pictures
           x, y);
    });
}

// Which pixel and sample each slot is, and where in the picture it lies.
void CameraRays::choosePlaces(const Tile& tile, int first, int count, SampleChunk& chunk) const {
    const auto samples = static_cast<std::size_t>(count);
    const auto begin = static_cast<std::uint32_t>(first);
    const auto all = static_cast<std::size_t>(tile.width() * tile.height()) * samples;
    chunk.ids.resize(all);
    chunk.places.resize(all);
    if (samples == 1 && fixed_) {
        const Vec2d corner = middle(0, 0), offset{fixed_->x, fixed_->y};
        forEachSlot(tile, [&](std::size_t slot, std::uint32_t pixel, int x, int y) {
            chunk.ids[slot] = {pixel, begin};
            chunk.places[slot] = {(x + corner.x) + offset.x, (y + corner.y) + offset.y};
        });
        return;
    }
    chunk.offsets.resize(all);
    forEachSlot(tile, [&](std::size_t place, std::uint32_t pixel, int x, int y) {
        for (std::size_t s = 0; s < samples; ++s) {
            const std::size_t slot = place * samples + s;
            chunk.ids[slot] = {pixel, begin + static_cast<std::uint32_t>(s)};
            chunk.places[slot] = middle(x, y);
        }
    });
    if (corners_) return;
    drawPairs(first, count, kPixelDimension, chunk.ids, &filter_, chunk.offsets);
    for (std::size_t i = 0; i < chunk.places.size(); ++i) {
        const Vec2d middle = chunk.places[i];
        chunk.places[i] = {middle.x + chunk.offsets[i].x, middle.y + chunk.offsets[i].y};
    }
}

template <class TakeFn>
void CameraRays::drawInLanes(int first, int count, std::uint32_t dimension,
                             std::span<const SampleId> ids, const TakeFn& take) const {
    const Sampler& sampler = context_.sampler;
    Sampler::PairSeeds seeds{};
    PairBlock block;
    for (std::size_t slot = 0; slot < ids.size(); slot += PairBlock::kPairs) {
        const std::size_t some = std::min(PairBlock::kPairs, ids.size() - slot);
        for (std::size_t i = 0; i < some; ++i) {
            const SampleId id = ids[slot + i];
            block.pixel[i] = id.pixel, block.sample[i] = id.index;
            if (count == 1) continue; // by the register, below
            if (id.index == static_cast<std::uint32_t>(first))
                seeds = sampler.pairSeeds(id.pixel, dimension);
            block.index[i] = seeds.index, block.x[i] = seeds.x, block.y[i] = seeds.y;
        }
        if (count == 1)
            lanes_.seeds(sampler.seed(), dimension, std::span<const std::uint32_t>(block.pixel),
                         {block.index, block.x, block.y});
        lanes_.pairs(block);
        take(block, slot, some);
    }
}

void CameraRays::drawPairs(int first, int count, std::uint32_t dimension,
                           std::span<const SampleId> ids, const Filter* filter,
                           std::span<Vec2> out) const {
    const Sampler& sampler = context_.sampler;
    const auto samples = static_cast<std::size_t>(count);
    const bool areCentres = dimension == kPixelDimension && sampler.sampleCount() == 1 &&
                            !context_.settings.picture.jitter; // see Sampler
    if (!areLanesAsked() || areCentres) {
        for (std::size_t slot = 0; slot < ids.size(); slot += samples)
            sampler.get2D(ids[slot].pixel, static_cast<std::uint32_t>(first), dimension,
                          out.subspan(slot, samples));
        if (filter) filter->sample(out);
        return;
    }
    const auto inverse = filter ? filter->inverse() : std::nullopt;
    drawInLanes(first, count, dimension, ids,
                [&](PairBlock& block, std::size_t slot, std::size_t some) {
                    if (inverse) lanes_.spread(*inverse, block);
                    for (std::size_t i = 0; i < some; ++i) out[slot + i] = {block.u[i], block.v[i]};
                });
    if (filter && !inverse) filter->sample(out);
}

void CameraRays::drawTimes(int first, int count, SampleChunk& chunk) const {
    const Sampler& sampler = context_.sampler;
    std::vector<float>& times = chunk.cameraRays.time;
    if (areLanesAsked())
        return drawInLanes(first, count, Sampler::alone(kTimeDimension), chunk.ids,
                           [&](const PairBlock& block, std::size_t slot, std::size_t some) {
                               std::copy_n(block.u, some, &times[slot]);
                           });
    for (std::size_t i = 0; i < chunk.ids.size(); ++i)
        times[i] = sampler.get1D(chunk.ids[i].pixel, chunk.ids[i].index, kTimeDimension);
}

bool CameraRays::areLanesAsked() const {
    return lanes_.pairs != nullptr && context_.sampler.kind() == SamplerKind::Sobol;
}

void CameraRays::sendThroughLens(const Camera::Lens& lens, SampleChunk& chunk) const {
    PathBatch& rays = chunk.cameraRays;
    LensBlock block;
    for (std::size_t first = 0; first < rays.size(); first += LensBlock::kRays) {
        const std::size_t some = std::min(LensBlock::kRays, rays.size() - first);
        for (std::size_t i = 0; i < some; ++i) {
            block.x[i] = chunk.places[first + i].x, block.y[i] = chunk.places[first + i].y;
            block.u[i] = chunk.onLens[first + i].x, block.v[i] = chunk.onLens[first + i].y;
        }
        lanes_.rays(lens, block);
        for (std::size_t i = 0; i < some; ++i) {
            rays.org[first + i] = {block.org[0][i], block.org[1][i], block.org[2][i]};
            rays.dir[first + i] = {block.dir[0][i], block.dir[1][i], block.dir[2][i]};
            rays.tMin[first + i] = block.tMin[i];
        }
    }
}

void CameraRays::make(const Tile& tile, int first, int count, SampleChunk& chunk) const {
    const Camera& camera = context_.scene.camera();
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
    const bool isPinhole = !hasLens && camera.hasSharedOrigin();
    if (isPinhole && lanes_.pinhole)
        lanes_.pinhole(*camera.pinhole(), chunk.places, rays.dir, rays.tMin);
    else if (isPinhole)
        camera.pinholeRays(chunk.places, rays.dir, rays.tMin);
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
    if (hasTime) drawTimes(first, count, chunk);
    if (isPinhole) return;
    if (hasLens) {
        chunk.onLens.resize(rays.size());
        drawPairs(first, count, kLensDimension, chunk.ids, nullptr, chunk.onLens);
        if (const auto lens = camera.lens(); lens && lanes_.rays)
            return sendThroughLens(*lens, chunk);
    }
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Vec2 lens{0.5f, 0.5f};
        if (hasLens) lens = chunk.onLens[i];
        const Ray ray = camera.ray(chunk.places[i], lens, rays.time[i]);
        rays.org[i] = ray.org;
        rays.dir[i] = ray.dir;
        rays.tMin[i] = ray.tMin;
    }
}
