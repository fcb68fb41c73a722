// Film: sums of samples per place. Every sample belongs to one place and every place to one worker,
// so sums have one order and threads need no locks. A place is a pixel, or for SamplerKind Corners
// the corner of pixels, which takes part in the four around it.
#pragma once

#include "base/vec.h"
#include "image/image.h"

#include <cstdint>
#include <vector>

class Film {
public:
    Film(int width, int height)
        : width_(width), height_(height),
          sums_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)),
          counts_(sums_.size()) {}

    void add(int x, int y, Rgb value) {
        const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                               static_cast<std::size_t>(x);
        sums_[at] += Vec3d{value.r, value.g, value.b};
        ++counts_[at];
    }

    // The mean of each pixel's samples; black where there are none.
    Image mean() const {
        Image image(width_, height_);
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            const Vec3 m = toFloat(sums_[i] / static_cast<double>(counts_[i] ? counts_[i] : 1));
            image.pixels()[i] = {m.x, m.y, m.z};
        }
        return image;
    }
    // How many samples each pixel has, as a grey picture.
    Image samples() const {
        Image image(width_, height_);
        for (std::size_t i = 0; i < counts_.size(); ++i) {
            const float n = static_cast<float>(counts_[i]);
            image.pixels()[i] = {n, n, n};
        }
        return image;
    }

    // For a film of corners: the pixels between them, each its upper left one (for numbers of
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
    int width_, height_;
    std::vector<Vec3d> sums_;
    std::vector<std::uint32_t> counts_;
};
