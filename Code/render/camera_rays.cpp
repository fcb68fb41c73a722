#include "render/camera_rays.h"

#include "sample/dimensions.h"
#include "sample/z_order.h"

#include <algorithm>
#include <span>

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

constexpr std::size_t kBlock = PlaceBlock::kPlaces;
// The number of a pixel in the picture, which wraps in huge ones.
constexpr std::uint32_t pixelAt(int x, int y, std::uint32_t width) {
    return static_cast<std::uint32_t>(y) * width + static_cast<std::uint32_t>(x);
}
constexpr std::size_t blocksOf(std::size_t slots) { return (slots + kBlock - 1) / kBlock; }
// fn(slot, count) for the first slot of each block.
template <class Fn> void forEachBlock(std::size_t slots, const Fn& fn) {
    for (std::size_t slot = 0; slot < slots; slot += kBlock)
        fn(slot, std::min(kBlock, slots - slot));
}

} // namespace

CameraRays::CameraRays(const IntegratorContext& context)
    : context_(context),
      filter_(filterKind(context.settings.picture.filter), context.settings.picture.filterWidth),
      lanes_(*context.settings.isa->camera),
      corners_(context.settings.picture.sampler == SettingsDesc::Sampler::Corners),
      inZOrder_(context.settings.picture.sampler == SettingsDesc::Sampler::ZSobol),
      width_(context.settings.picture.width + corners_) {
    const SettingsDesc& picture = context.settings.picture;
    isInMiddle_ = corners_ || (picture.samplesPerPixel == 1 && !picture.jitter &&
                               context.settings.specialise); // see Sampler
    for (std::size_t i = 0; i < pixelsOfSquare_.size(); ++i) {
        const TileSquare::Step step = TileSquare::kCurve[i];
        pixelsOfSquare_[i] = pixelAt(step.x, step.y, static_cast<std::uint32_t>(width_));
    }
}

void CameraRays::listSamples(const Tile& tile, int first, int count, SampleChunk& chunk) const {
    const auto all =
        static_cast<std::size_t>(tile.width() * tile.height()) * static_cast<std::size_t>(count);
    const auto samples = static_cast<std::uint32_t>(count);
    chunk.sampleNumber.set(static_cast<std::uint32_t>(first), samples, all);
    chunk.cameraRays.setSize(all);
    chunk.places.resize(std::max(chunk.places.size(), blocksOf(all)));
    // In registers: what is written could be part of *this.
    const auto width = static_cast<std::uint32_t>(width_);
    const bool inZOrder = inZOrder_;
    const Vec2d corner = middle(0, 0);
    std::uint32_t* stream = chunk.cameraRays.stream.data();
    PlaceBlock* block = chunk.places.data();
    std::size_t inBlock = 0;
    const auto place = [&](int x, int y) {
        const std::uint32_t pixel =
            inZOrder ? zNumber(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))
                     : pixelAt(x, y, width);
        for (std::uint32_t s = 0; s < samples; ++s) {
            *stream++ = pixel;
            block->x[inBlock] = x + corner.x, block->y[inBlock] = y + corner.y;
            if (++inBlock == kBlock) ++block, inBlock = 0;
        }
    };
    const auto square = [&](int left, int top) {
        if (samples != 1 || inBlock != 0 || inZOrder) {
            for (const TileSquare::Step s : TileSquare::kCurve) place(left + s.x, top + s.y);
            return;
        }
        listSquare(left, top, stream, block);
        stream += TileSquare::kPlaces, block += TileSquare::kPlaces / kBlock;
    };
    forEachSquare(tile, square, place);
}

// By the register: sums of whole numbers and halves are exact in any order.
void CameraRays::listSquare(int left, int top, std::uint32_t* stream, PlaceBlock* blocks) const {
    constexpr std::size_t kPlaces = TileSquare::kPlaces;
    static_assert(kPlaces % kBlock == 0);
    static constexpr auto kSteps = [] {
        std::array<std::array<double, kPlaces>, 2> steps{};
        for (std::size_t i = 0; i < kPlaces; ++i)
            steps[0][i] = TileSquare::kCurve[i].x, steps[1][i] = TileSquare::kCurve[i].y;
        return steps;
    }();
    const Vec2d corner = middle(left, top);
    const std::uint32_t first = pixelAt(left, top, static_cast<std::uint32_t>(width_));
    for (std::size_t i = 0; i < kPlaces; ++i) stream[i] = first + pixelsOfSquare_[i];
    for (std::size_t from = 0; from < kPlaces; from += kBlock) {
        PlaceBlock& block = blocks[from / kBlock];
        for (std::size_t i = 0; i < kBlock; ++i) {
            block.x[i] = corner.x + kSteps[0][from + i];
            block.y[i] = corner.y + kSteps[1][from + i];
        }
    }
}

void CameraRays::moveFromMiddles(SampleChunk& chunk) const {
    if (isInMiddle_) return;
    const Filter::Spread spread = filter_.spread();
    drawPairs(kPixelDimension, chunk, [&](const PairBlock& pairs, std::size_t slot, std::size_t) {
        lanes_.spread(spread, pairs, chunk.places[slot / kBlock]);
    });
}

template <class TakeFn>
void CameraRays::drawPairs(std::uint32_t dimension, const SampleChunk& chunk,
                           const TakeFn& take) const {
    const Sampler& sampler = context_.sampler;
    const bool isMiddle = dimension == kPixelDimension && sampler.sampleCount() == 1 &&
                          !context_.settings.picture.jitter; // see Sampler
    PairBlock block{};
    forEachBlock(chunk.cameraRays.size(), [&](std::size_t slot, std::size_t some) {
        const std::uint32_t* const pixel = &chunk.cameraRays.stream[slot];
        const std::uint32_t* const sample = &chunk.sampleNumber[slot];
        if (sampler.isInLanes() && !isMiddle) {
            std::copy_n(pixel, some, block.pixel);
            std::copy_n(sample, some, block.sample);
            lanes_.seedsOf(sampler, dimension, std::span<const std::uint32_t>(block.pixel),
                           {block.index, block.x, block.y});
            lanes_.pairsOf(sampler, block, PairBlock::kPairs);
        } else {
            for (std::size_t i = 0; i < some; ++i) {
                const Vec2 pair = sampler.get2D(pixel[i], sample[i], dimension);
                block.u[i] = pair.x, block.v[i] = pair.y;
            }
        }
        take(block, slot, some);
    });
}

void CameraRays::drawTimes(SampleChunk& chunk) const {
    const Sampler& sampler = context_.sampler;
    std::vector<float>& times = chunk.cameraRays.time;
    if (sampler.isInLanes())
        return drawPairs(Sampler::alone(kTimeDimension), chunk,
                         [&](const PairBlock& block, std::size_t slot, std::size_t some) {
                             std::copy_n(block.u, some, &times[slot]);
                         });
    for (std::size_t i = 0; i < chunk.cameraRays.size(); ++i)
        times[i] = sampler.get1D(chunk.cameraRays.stream[i], chunk.sampleNumber[i], kTimeDimension);
}

std::uint64_t CameraRays::numbersLeftOut() const {
    const std::uint64_t place = isInMiddle_ ? 2 : 0, lens = drawsLens() ? 0 : 2;
    return place + lens + (drawsTimes() ? 0 : 1);
}

// What all rays of a picture share is written once.
void CameraRays::setConstants(SampleChunk& chunk) const {
    PathBatch& rays = chunk.cameraRays;
    if (chunk.raysWithConstants >= rays.size()) return;
    for (std::size_t i = chunk.raysWithConstants; i < rays.size(); ++i) {
        rays.sample[i] = static_cast<std::uint32_t>(i);
        rays.weight[i] = {1, 1, 1};
        rays.medium[i] = context_.cameraMedium;
        rays.seesLights[i] = PathLights::kSeesAsCamera;
        rays.tMax[i] = kInfinityF;
        rays.time[i] = 0.5f; // what stands still looks the same at any time
    }
    chunk.raysWithConstants = rays.size();
}

void CameraRays::make(const Tile& tile, int first, int count, SampleChunk& chunk) const {
    const Camera& camera = context_.scene.camera();
    listSamples(tile, first, count, chunk);
    moveFromMiddles(chunk);
    setConstants(chunk);
    PathBatch& rays = chunk.cameraRays;
    if (drawsTimes()) drawTimes(chunk);
    if (drawsLens())
        drawPairs(kLensDimension, chunk,
                  [&](const PairBlock& pairs, std::size_t slot, std::size_t) {
                      std::copy_n(pairs.u, kBlock, chunk.places[slot / kBlock].u);
                      std::copy_n(pairs.v, kBlock, chunk.places[slot / kBlock].v);
                  });
    forEachBlock(rays.size(), [&](std::size_t slot, std::size_t some) {
        lanes_.rays(
            camera, chunk.places[slot / kBlock],
            {std::span(rays.org).subspan(slot, some), std::span(rays.dir).subspan(slot, some),
             std::span(rays.tMin).subspan(slot, some), std::span(rays.time).subspan(slot, some)});
    });
}
