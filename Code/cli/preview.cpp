#include "cli/output.h"

#include "base/text.h"
#include "image/colour.h"

#include <algorithm>
#include <cmath>

namespace {

// The pixels of one half cell: [x0, x1) x [y0, y1), never empty.
struct Area {
    int x0, y0, x1, y1;
};

Area areaOf(const Image& image, int x, int y, int width, int height) {
    const auto edge = [](int i, int count, int pixels) {
        return static_cast<int>(static_cast<long long>(i) * pixels / count);
    };
    return {edge(x, width, image.width()), edge(y, height, image.height()),
            edge(x + 1, width, image.width()), edge(y + 1, height, image.height())};
}

std::string colourText(const Image& image, const Area& area) {
    Rgb sum;
    for (int y = area.y0; y < area.y1; ++y)
        for (int x = area.x0; x < area.x1; ++x) sum += image.pixel(x, y);
    const Rgb mean = sum / static_cast<float>((area.x1 - area.x0) * (area.y1 - area.y0));
    return cat(int{srgb8FromLinear(mean.r)}, ";", int{srgb8FromLinear(mean.g)}, ";",
               int{srgb8FromLinear(mean.b)});
}

} // namespace

std::string previewText(const Image& image, int columns, int rows) {
    const double shrink = std::min({1.0, static_cast<double>(std::max(columns, 1)) / image.width(),
                                    2.0 * std::max(rows, 1) / image.height()});
    const int width = std::max(1, static_cast<int>(image.width() * shrink));
    const int height = std::max(1, static_cast<int>(image.height() * shrink));
    std::string out;
    for (int y = 0; y < height; y += 2) {
        for (int x = 0; x < width; ++x) {
            out += "\x1b[38;2;" + colourText(image, areaOf(image, x, y, width, height));
            // An odd last row has nothing below it.
            if (y + 1 < height)
                out += ";48;2;" + colourText(image, areaOf(image, x, y + 1, width, height));
            out += "m\xE2\x96\x80"; // U+2580, upper half block
        }
        out += "\x1b[0m\n";
    }
    return out;
}
