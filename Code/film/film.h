// Film: sums of samples per place of one tile, in whole numbers: any order of samples and any
// division of them among films gives the same bits. A place is a pixel, or for the sampler Corners
// the corner of pixels, which takes part in the four around it.
#pragma once

#include "base/vec.h"
#include "film/whole_sum.h"
#include "image/image.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

class Film {
public:
    struct Place {
        WholeSum sum; // in units of the film
        std::uint32_t count = 0;
    };

    // Empty places. `perUnit`: see WholeSum.
    void reset(int width, int height, double perUnit) {
        width_ = width, perUnit_ = perUnit;
        sums_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), {});
    }
    int width() const { return width_; }
    int height() const { return width_ > 0 ? static_cast<int>(sums_.size()) / width_ : 0; }
    double perUnit() const { return perUnit_; }

    void add(int x, int y, Rgb value) {
        Place& place = sums_[index(x, y)];
        place.sum.add(value, perUnit_);
        ++place.count;
    }

    // Leaves out those that are no numbers. Returns how many are not.
    std::uint32_t addNumbers(int x, int y, std::span<const Rgb> values) {
        Place& place = sums_[index(x, y)];
        const std::uint32_t before = place.count;
        for (auto rest = values; !rest.empty();) {
            const auto some = rest.first(std::min(rest.size(), WholeSum::kTogether));
            rest = rest.subspan(some.size());
            if (WholeSum::areSmall(some, perUnit_)) {
                place.sum.addSmall(some, perUnit_);
                place.count += static_cast<std::uint32_t>(some.size());
                continue;
            }
            for (const Rgb& value : some)
                if (isNumber(value)) place.sum.add(value, perUnit_), ++place.count;
        }
        return static_cast<std::uint32_t>(values.size()) - (place.count - before);
    }
    static bool isNumber(Rgb c) {
        const float sum = c.r + c.g + c.b;
        return sum - sum == 0;
    }

    // As many samples more of every place, all the same.
    void addToAll(Rgb value, int samples) {
        const auto count = static_cast<std::uint32_t>(samples);
        WholeSum one;
        one.add(value, perUnit_);
        for (Place& place : sums_) place.sum.addTimes(one, count), place.count += count;
    }
    // What another film of the same unit has seen of the places from (x0, y0) on.
    void add(const Film& part, int x0, int y0) {
        std::size_t from = 0;
        const std::size_t rows = part.sums_.size() / static_cast<std::size_t>(part.width_);
        for (std::size_t row = 0; row < rows; ++row) {
            std::size_t to = index(x0, y0 + static_cast<int>(row));
            for (int x = 0; x < part.width_; ++x, ++from, ++to) {
                sums_[to].sum.add(part.sums_[from].sum);
                sums_[to].count += part.sums_[from].count;
            }
        }
    }

    const Place& at(int x, int y) const { return sums_[index(x, y)]; }
    // Returns half the difference of the means of two places, per unit, where both are of as many samples;
    // else what has the same variance, sqrt(ab) / (a + b) of it. 0 where one of them has no sample.
    static Vec3d halfDifference(const Place& before, const Place& batch, double perUnit) {
        if (before.count == 0 || batch.count == 0) return {};
        const double a = before.count, b = batch.count;
        const Vec3d apart = before.sum.value() / a - batch.sum.value() / b;
        return apart * (std::sqrt(a * b) / (a + b)) / perUnit;
    }
    // The mean of the place's samples, black where there are none, unrounded.
    Vec3d meanAt(int x, int y) const {
        return exactMeanOf(at(x, y));
    }
    // The mean of the place's samples, black where there are none.
    Rgb mean(int x, int y) const { return meanOf(sums_[index(x, y)]); }
    // The means of all places, from (x0, y0) of `image` on.
    void writeMeans(Image& image, int x0, int y0) const {
        writeEach(image, x0, y0, [&](const Place& place) { return meanOf(place); });
    }
    // How many samples each place has, as a grey picture.
    void writeCounts(Image& image, int x0, int y0) const {
        writeEach(image, x0, y0, [](const Place& place) {
            const float n = static_cast<float>(place.count);
            return Rgb{n, n, n};
        });
    }

    // For a picture of corners: the pixels between them, each its upper left one (for numbers of
    // objects, which can't be averaged), or the mean of its four.
    static Image upperLeftCorners(const Image& corners) {
        Image image(corners.width() - 1, corners.height() - 1);
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) image.setPixel(x, y, corners.pixel(x, y));
        return image;
    }
    static Image meanOfCorners(const Image& corners) {
        Image image(corners.width() - 1, corners.height() - 1);
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x) {
                const Rgb above = corners.pixel(x, y) + corners.pixel(x + 1, y);
                const Rgb below = corners.pixel(x, y + 1) + corners.pixel(x + 1, y + 1);
                image.setPixel(x, y, (above + below) * 0.25f);
            }
        return image;
    }

private:
    Vec3d exactMeanOf(const Place& place) const {
        const double count = std::max(place.count, std::uint32_t{1});
        return place.sum.value() / (perUnit_ * count);
    }
    Rgb meanOf(const Place& place) const {
        const Vec3 m = toFloat(exactMeanOf(place));
        return {m.x, m.y, m.z};
    }
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }

    template <class ValueOf>
    void writeEach(Image& image, int x0, int y0, const ValueOf& valueOf) const {
        int x = 0, y = 0;
        for (const Place& place : sums_) {
            image.setPixel(x0 + x, y0 + y, valueOf(place));
            if (++x == width_) x = 0, ++y;
        }
    }

    int width_ = 0;
    double perUnit_ = 1;
    std::vector<Place> sums_;
};
