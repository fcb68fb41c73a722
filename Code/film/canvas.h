// Canvas: what the tiles of a picture are painted on, an Image or only its codes.
#pragma once

#include "film/tile.h"
#include "image/coded_image.h"
#include "image/image.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

class Canvas {
public:
    // For such codes, else for an image.
    Canvas(int width, int height, std::optional<Encoding> codes) : isCoded_(codes) {
        if (codes)
            codes_ = CodedImage(width, height, *codes);
        else
            image_ = Image(width, height);
    }

    // The upper left of `from` becomes this part of the picture. Threads may paint different parts
    // at a time.
    void paint(const Tile& to, const Image& from) {
        const auto width = static_cast<std::size_t>(from.width());
        std::size_t row = 0;
        for (int y = to.y0; y < to.y1; ++y, row += width) {
            const auto pixels = from.pixels().subspan(row, static_cast<std::size_t>(to.width()));
            if (isCoded_)
                codes_.put(to.x0, y, pixels);
            else
                std::copy(pixels.begin(), pixels.end(), rowOf(y) + to.x0);
        }
    }

    // The same with one colour.
    void fill(const Tile& to, Rgb color) {
        if (isCoded_) return codes_.fill(to.x0, to.y0, to.width(), to.height(), color);
        for (int y = to.y0; y < to.y1; ++y) std::fill_n(rowOf(y) + to.x0, to.width(), color);
    }

    // One of the two is the picture, the other one is empty.
    Image& image() { return image_; }
    CodedImage& codes() { return codes_; }

private:
    Rgb* rowOf(int y) {
        return image_.pixels().data() +
               static_cast<std::ptrdiff_t>(y) * static_cast<std::ptrdiff_t>(image_.width());
    }

    bool isCoded_;
    Image image_;
    CodedImage codes_;
};
