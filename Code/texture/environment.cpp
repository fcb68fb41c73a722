#include "texture/environment.h"

#include "base/math.h"
#include "base/parallel.h"
#include "base/text.h"
#include "image/colour.h"
#include "texture/pictures_in_lanes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

Environment::Environment(StoredImage image, ColorSpace space, Interpolation interpolation, Up up,
                         double rotationRad)
    : grid_(std::move(image), space, interpolation), place_{up == Up::Z, rotationRad * kInvTwoPi} {}

Rgb Environment::radiance(Vec3 dir) const {
    const auto [s, t] = kernels::one::placesOf(place_, {dir.x, dir.y, dir.z});
    return grid_.color(s.v, t.v, Extension::Repeat, Extension::Extend);
}

namespace {

// Returns the luminance of all texels, rows from the bottom.
std::vector<float> luminances(const TexelGrid& grid, ThreadPool& pool) {
    const StoredImage& image = grid.image();
    const auto width = static_cast<std::size_t>(image.width);
    const auto height = static_cast<std::size_t>(image.height);
    const auto channels = static_cast<std::size_t>(image.channels);
    std::vector<float> out(width * height);
    const auto fill = [&](const auto& numbers, const auto& decoded) {
        pool.run(height, [&](std::size_t j, int) {
            const auto* from = numbers.data() + (height - 1 - j) * width * channels;
            for (std::size_t i = 0; i < width; ++i, from += channels) {
                const float first = decoded(from[0]);
                const float light = channels < 3
                                        ? first
                                        : luminance(Rgb{first, decoded(from[1]), decoded(from[2])});
                out[j * width + i] = light > 0 ? light : 0;
            }
        });
    };
    switch (image.depth) {
    case StoredImage::Depth::Bits8: {
        std::array<float, 256> table{};
        for (std::size_t i = 0; i < table.size(); ++i)
            table[i] = grid.isSrgb() ? linearFromSrgb8(static_cast<std::uint8_t>(i))
                                     : static_cast<float>(i) / 255;
        fill(image.bytes, [&](std::uint8_t code) { return table[code]; });
        break;
    }
    case StoredImage::Depth::Bits16:
        fill(image.words, [&](std::uint16_t code) {
            return grid.isSrgb() ? linearFromSrgb16(code) : static_cast<float>(code) / 65535;
        });
        break;
    case StoredImage::Depth::Float: fill(image.floats, [](float x) { return x; }); break;
    }
    return out;
}

// The texels from `first` to `last` that have a say between two borders of cells.
struct Range {
    std::ptrdiff_t first, last;
};
Range rangeOf(std::size_t cell, std::size_t cells, std::size_t texels) {
    const double from = static_cast<double>(cell * texels) / static_cast<double>(cells);
    const double to = static_cast<double>((cell + 1) * texels) / static_cast<double>(cells);
    return {static_cast<std::ptrdiff_t>(std::floor(from - 0.5)),
            static_cast<std::ptrdiff_t>(std::ceil(to + 0.5)) - 1};
}

} // namespace

SkyCells skyCells(const Environment& environment, int mostColumns, int mostRows, int threads) {
    const TexelGrid& grid = environment.grid();
    ThreadPool pool(threads);
    const std::vector<float> texels = luminances(grid, pool);
    SkyCells out{std::min(grid.width(), mostColumns), std::min(grid.height(), mostRows), {}};
    const auto width = static_cast<std::size_t>(grid.width());
    const auto height = static_cast<std::size_t>(grid.height());
    const auto columns = static_cast<std::size_t>(out.width);
    const auto rows = static_cast<std::size_t>(out.height);
    out.luminance.resize(columns * rows);
    pool.run(rows, [&](std::size_t j, int) {
        // Rows are held at the poles, columns go round.
        const Range y = rangeOf(j, rows, height);
        const auto low = static_cast<std::size_t>(std::max<std::ptrdiff_t>(y.first, 0));
        const auto high = std::min(static_cast<std::size_t>(y.last), height - 1);
        std::vector<double> sums(width);
        for (std::size_t t = low; t <= high; ++t)
            for (std::size_t i = 0; i < width; ++i)
                sums[i] += static_cast<double>(texels[t * width + i]);
        for (std::size_t c = 0; c < columns; ++c) {
            const Range x = rangeOf(c, columns, width);
            const auto round = static_cast<std::ptrdiff_t>(width);
            double sum = 0;
            for (std::ptrdiff_t i = x.first; i <= x.last; ++i)
                sum += sums[static_cast<std::size_t>((i + round) % round)];
            out.luminance[j * columns + c] = static_cast<float>(
                sum / static_cast<double>((high - low + 1) *
                                          static_cast<std::size_t>(x.last - x.first + 1)));
        }
    });
    return out;
}

std::optional<std::string> whyNoLight(const StoredImage& image) {
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t colours = channels < 3 ? 1 : 3;
    const auto isBad = [&](std::size_t i) {
        return !(image.floats[i] >= 0) && i % channels < colours;
    };
    std::size_t bad = 0;
    while (bad < image.floats.size() && !isBad(bad)) ++bad;
    if (image.noNumber) bad = std::min(bad, *image.noNumber);
    if (bad >= image.floats.size()) return {};
    const std::size_t pixel = bad / channels, width = static_cast<std::size_t>(image.width);
    return cat("pixel ", pixel % width, " from the left, ", pixel / width, " from the top is ",
               image.floats[bad] < 0 ? "negative" : "not a number",
               "; light has no colours below 0");
}
