// CameraRays: the samples of a tile, and the rays that they send into the scene.
#pragma once

#include "camera/camera_lanes.h"
#include "film/tile.h"
#include "integrate/context.h"
#include "integrate/samples.h"
#include "sample/filter.h"

#include <array>

class CameraRays {
public:
    explicit CameraRays(const IntegratorContext& context);

    // Fills in numbers and rays of the samples first .. first + count - 1 of every place, place
    // after place, in the order of forEachPlace().
    void make(const Tile& tile, int first, int count, SampleChunk& chunk) const;

    bool throughCorners() const { return corners_; }
    // Random numbers that make a ray where everything is drawn, and those of them that are not.
    static constexpr std::uint64_t kNumbers = 5;
    std::uint64_t numbersLeftOut() const;
    int placesPerRow() const { return width_; } // of the whole picture
    // No sample is farther from the middle of its place than this, in pixels.
    double reach() const { return corners_ ? 0 : filter_.radius(); }
    // Where place x, y is in the picture.
    Vec2d middle(int x, int y) const {
        const double half = corners_ ? 0 : 0.5;
        return {x + half, y + half};
    }

private:
    // Which pixel and sample each slot is, and the middle of its place.
    void listSamples(const Tile& tile, int first, int count, SampleChunk& chunk) const;
    // The same of a TileSquare with one sample per place.
    void listSquare(int left, int top, std::uint32_t* stream, PlaceBlock* blocks) const;
    // To where the filter has them.
    void moveFromMiddles(SampleChunk& chunk) const;
    // Sampler::get2D() of all slots: take(pairs, slot, count), `slot` that of the block's first.
    template <class TakeFn>
    void drawPairs(std::uint32_t dimension, const SampleChunk& chunk, const TakeFn& take) const;
    // Sampler::get1D() of all slots.
    void drawTimes(SampleChunk& chunk) const;
    // The general form draws what it may not need; what does not use it does not notice.
    bool drawsTimes() const { return !context_.settings.specialise || context_.scene.moves(); }
    bool drawsLens() const {
        return !context_.settings.specialise || context_.scene.camera().hasLens();
    }
    void setConstants(SampleChunk& chunk) const;

    const IntegratorContext& context_;
    Filter filter_;
    const CameraLanes& lanes_;
    bool corners_; // samples lie on the corners of pixels; places are those, one more each way
    bool inZOrder_; // the numbers of pixels, for the sampler ZSobol
    int width_;
    // The pixels of a TileSquare, less its first one.
    std::array<std::uint32_t, TileSquare::kPlaces> pixelsOfSquare_;
    bool isInMiddle_; // every sample, of its place: that needs no numbers
};
