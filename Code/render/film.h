// Film: sums of samples per pixel. Every sample belongs to one pixel and every pixel to one worker,
// so sums have one order and threads need no locks.
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

private:
    int width_, height_;
    std::vector<Vec3d> sums_;
    std::vector<std::uint32_t> counts_;
};
