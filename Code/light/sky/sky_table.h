// SkyTable: how likely a lamp that is all of the sky is sampled in each direction: cells in rows of
// equal latitude, as an equirectangular picture has them, each with one density.
#pragma once

#include "base/vec.h"
#include "sample/sky_place.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

class Environment;

// What the sky looks like: a picture, if there is one, times a factor.
struct SkyRadiance {
    const Environment* picture = nullptr;
    Rgb factor{1, 1, 1};
};

// What the lanes see of a table.
struct SkyView {
    const float* rows = nullptr;     // height + 1 parts of 1: how much lies below each row
    const float* columns = nullptr;  // of each row, `pitch` apart: width + 1 parts of 1
    const double* borders = nullptr; // height + 1 sines of latitude
    std::uint32_t width = 0, height = 0, pitch = 0;
    SkyPlace place;
    SkyRadiance radiance;
};

// The cells of a picture are these many at most.
inline constexpr int kMostSkyColumns = 1024, kMostSkyRows = 512;

class SkyTable {
public:
    // Makes a table of one cell: all directions are equally likely.
    SkyTable() : SkyTable(1, 1, std::vector<float>{1}, false, {}) {}
    // `luminance`: of width x height cells, rows from the bottom; no number is negative or NaN.
    // `compensated`: only what is brighter than the mean is sampled, in proportion to the rest
    // (Karlik et al. 2019), where samples are combined with those of surfaces; else no cell has
    // less than a thousandth of an even share. The threads give the same table, however many.
    SkyTable(int width, int height, std::span<const float> luminance, bool compensated,
             SkyPlace place, int threads = 1);

    SkyView view(const SkyRadiance& radiance) const {
        return {rows_.data(), columns_.data(), borders_.data(), width_,
                height_,      width_ + 1,      place_,          radiance};
    }
    // Mean luminance over all directions.
    double mean() const { return mean_; }

private:
    std::uint32_t width_, height_;
    SkyPlace place_;
    std::vector<float> rows_, columns_;
    std::vector<double> borders_;
    double mean_ = 0;
};
