// Film: sums of samples per place of one tile. Every tile belongs to one worker and its samples
// come in the order of their numbers, so sums have one order and threads need no locks. A place is
// a pixel, or for the sampler Corners the corner of pixels, which takes part in the four around it.
#pragma once

#include "base/vec.h"
#include "image/image.h"
#include "render/two_sums.h"

#include <cstdint>
#include <span>
#include <vector>

class Film {
public:
    struct Place {
        Vec3d sum;
        std::uint32_t count = 0;
        Rgb mean() const {
            const Vec3 m = toFloat(count <= 1 ? sum : sum / static_cast<double>(count));
            return {m.x, m.y, m.z};
        }
    };

    // Empty places.
    void reset(int width, int height) {
        width_ = width;
        sums_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), {});
    }

    void add(int x, int y, Rgb value) {
        Place& place = sums_[index(x, y)];
        place.sum += Vec3d{value.r, value.g, value.b};
        ++place.count;
    }

    // In their order, without those that are no numbers. Returns how many are not.
    std::uint32_t addNumbers(int x, int y, std::span<const Rgb> values) {
        Place& place = sums_[index(x, y)];
        Vec3d sum = place.sum;
        std::uint32_t numbers = 0;
        for (const Rgb& value : values) {
            if (!isNumber(value)) continue;
            sum += Vec3d{value.r, value.g, value.b};
            ++numbers;
        }
        place.sum = sum, place.count += numbers;
        return static_cast<std::uint32_t>(values.size()) - numbers;
    }
    // The same of (x, y) and (x + 1, y), the first half of the values for the first one.
    std::uint32_t addNumbersOfTwo(int x, int y, std::span<const Rgb> values) {
        const std::size_t each = values.size() / 2;
        if (!two_sums::areSmall(values.data(), values.size()))
            return addNumbers(x, y, values.first(each)) + addNumbers(x + 1, y, values.last(each));
        Place* const places = &sums_[index(x, y)];
        two_sums::add(places[0].sum, places[1].sum, values.data(), each);
        for (Place* place : {&places[0], &places[1]})
            place->count += static_cast<std::uint32_t>(each);
        return 0;
    }
    static bool isNumber(Rgb c) {
        const float sum = c.r + c.g + c.b;
        return sum - sum == 0;
    }

    // As many samples more of every place, all the same. Sums of one value are exact, so this is
    // what adding one after the other gives.
    void addToAll(Rgb value, int samples) {
        const auto count = static_cast<std::uint32_t>(samples);
        for (Place& place : sums_) {
            place.sum += Vec3d{value.r, value.g, value.b} * static_cast<double>(count);
            place.count += count;
        }
    }
    // What another film has seen of the places from (x0, y0) on.
    void add(const Film& part, int x0, int y0) {
        std::size_t from = 0;
        const std::size_t rows = part.sums_.size() / static_cast<std::size_t>(part.width_);
        for (std::size_t row = 0; row < rows; ++row) {
            std::size_t to = index(x0, y0 + static_cast<int>(row));
            for (int x = 0; x < part.width_; ++x, ++from, ++to) {
                sums_[to].sum += part.sums_[from].sum;
                sums_[to].count += part.sums_[from].count;
            }
        }
    }

    const Place& at(int x, int y) const { return sums_[index(x, y)]; }
    // The mean of the place's samples, black where there are none.
    Rgb mean(int x, int y) const { return sums_[index(x, y)].mean(); }
    // The means of all places, from (x0, y0) of `image` on.
    void writeMeans(Image& image, int x0, int y0) const {
        writeEach(image, x0, y0, [](const Place& place) { return place.mean(); });
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
    std::vector<Place> sums_;
};
