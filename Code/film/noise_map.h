// NoiseMap: how far the means of the pixels are from what they converge to, as halves of their samples
// show it. Knows sums of samples, and nothing of how they are made or where more of them go.
//
// Samples of a group of 4 x 4 pixels double. Then D, half the difference of the means of the samples
// before and of those that came, is an estimate of the deviation of the mean of all of them: for
// independent samples E[D^2] is its variance, and for samples that are spread together, whose variance
// falls as n^-theta, it is 2^theta - 1 times that. One D has one degree of freedom. So pixels take the mean
// of D^2 over those around them, and not their own, which would end the sampling of pixels that are too
// dark by chance (the error of a mean and its D are correlated where the samples are skewed).
#pragma once

#include "film/error_measure.h"
#include "film/film.h"
#include "film/tile.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

class NoiseMap {
public:
    // Groups of pixels have one number of samples. Blocks of groups are estimated by themselves, so that a
    // crop of whole blocks has the estimates of the whole picture.
    static constexpr int kGroupSide = 4, kBlockSide = 32, kGroupsPerSide = kBlockSide / kGroupSide;

    struct Group {
        int samples = 0;             // of each pixel
        int pixels = 0;
        int least = Refinement::kFirstSamples; // that it has before errors decide
        // Sums of the squared errors of pixels and channels: `told` by the pixels from which the error is told,
        // `squares` by those that decide.
        double told = kInfinity, squares = kInfinity;
        float largest = 0;           // of the samples, the largest sum of the channels
        // Sums of D^2 over the group of the last three doublings, the latest first.
        std::array<double, 3> halves{};
        int doublings = 0;
    };
    struct Block {
        Tile area{}; // in pixels of the picture
        double pixels = 0;
        double squares = kInfinity; // sum of the squared errors of pixels and channels
        // Sums of the squared errors that each pixel's own D gives, and of their squares.
        double ownSquares = 0, ownFourth = 0;
        double growth = 2;           // 2^theta: the variance falls by this when samples double
        // Where the largest sample is a tenth of the light of all or more: the error that another one like it
        // would show in every pixel of the block.
        double spike = 0;
    };

    // `area` is that of the picture, in pixels.
    NoiseMap(const Tile& area, const ErrorMeasure& measure);

    // The group of a pixel has at least so many samples before errors decide.
    void setLeast(int x, int y, int samples) { groups_[groupIndex(x, y)].least = samples; }
    // A part within a block gets as many samples more of each pixel: `before` are the sums of the picture,
    // `batch` those of the part alone, `largest` the largest of the samples' sums of channels. Threads may add
    // different parts at a time.
    void add(const Tile& part, int samples, const Film& before, const Film& batch, float largest);
    // Estimates a block, by its number, anew from the sums that its pixels have now. Threads may do different blocks.
    void update(std::size_t number, const Film& sums);

    std::span<const Block> blocks() const { return blocks_; }
    // Returns the number of the block of a pixel.
    std::size_t blockAt(int x, int y) const {
        const int columns = (area_.x1 - 1) / kBlockSide - area_.x0 / kBlockSide + 1;
        const int column = x / kBlockSide - area_.x0 / kBlockSide;
        const int row = y / kBlockSide - area_.y0 / kBlockSide;
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
               static_cast<std::size_t>(column);
    }
    // Calls fn(group, area) for the groups of an area, row after row.
    template <class Fn> void forEachGroup(const Tile& area, const Fn& fn) const {
        forEachGroupArea(area, [&](const Tile& part) { fn(group(part.x0, part.y0), part); });
    }
    const Group& group(int x, int y) const { return groups_[groupIndex(x, y)]; }
    // Returns the squared error of a pixel, summed over the channels, with the factor of its block that makes
    // the error of the block an upper bound.
    double boundSquaresAt(int x, int y) const {
        const Block& block = blocks_[blockAt(x, y)];
        return static_cast<double>(squares_[pixelIndex(x, y)]) *
               sqr(upperFactor(block.ownSquares, block.ownFourth));
    }
    // Returns D of the latest doubling of a pixel, per channel: the samples before it minus those that it brought.
    Vec3 differenceAt(int x, int y) const { return difference_[pixelIndex(x, y)]; }
    double pixels() const { return static_cast<double>(squares_.size()); }

    // Returns the factor that makes an upper bound, right in 95 % of all cases, of an estimated error:
    // sqrt(nu / chi^2_0.05(nu)) by Wilson and Hilferty (1931), within 4 % of it. The degrees of freedom nu
    // are Satterthwaite's (1946): D^2 of pixels of unlike noise tell less than their number says.
    static double upperFactor(double ownSquares, double ownFourth);

private:
    static constexpr int nextGroup(int x) { return (x / kGroupSide + 1) * kGroupSide; }
    static double freedomOf(double ownSquares, double ownFourth);
    double growthOf(const Block& block) const;

    template <class Fn> static void forEachGroupArea(const Tile& area, const Fn& fn) {
        for (int y = area.y0; y < area.y1; y = nextGroup(y))
            for (int x = area.x0; x < area.x1; x = nextGroup(x))
                fn(Tile{x, y, std::min(nextGroup(x), area.x1), std::min(nextGroup(y), area.y1)});
    }
    template <class Fn> void forEachGroup(const Tile& area, const Fn& fn) {
        forEachGroupArea(area, [&](const Tile& part) {
            fn(groups_[groupIndex(part.x0, part.y0)], part);
        });
    }
    // Calls fn(place, x, y) for the pixels of a block; the place counts rows of kBlockSide.
    template <class Fn> static void forEachPixel(const Block& block, const Fn& fn) {
        for (int y = block.area.y0; y < block.area.y1; ++y)
            for (int x = block.area.x0; x < block.area.x1; ++x)
                fn(static_cast<std::size_t>(y % kBlockSide) * kBlockSide +
                       static_cast<std::size_t>(x % kBlockSide),
                   x, y);
    }
    std::size_t groupIndex(int x, int y) const {
        const int column = x / kGroupSide - area_.x0 / kGroupSide;
        const int row = y / kGroupSide - area_.y0 / kGroupSide;
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(groupColumns_) +
               static_cast<std::size_t>(column);
    }
    std::size_t pixelIndex(int x, int y) const {
        return static_cast<std::size_t>(y - area_.y0) * static_cast<std::size_t>(area_.width()) +
               static_cast<std::size_t>(x - area_.x0);
    }

    Tile area_;
    const ErrorMeasure& measure_;
    int groupColumns_;
    std::vector<Group> groups_;
    std::vector<Block> blocks_;
    std::vector<Vec3> difference_; // D per channel
    std::vector<float> squares_;
};
