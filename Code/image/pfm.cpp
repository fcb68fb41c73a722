// PFM (Debevec): "PF" or "Pf", size, scale (negative: little-endian), 32-bit floats, bottom row
// first. Always linear.
#include "base/text.h"
#include "image/bits.h"
#include "image/netpbm.h"

#include <algorithm>
#include <bit>
#include <cmath>

StoredImage decodePfm(Bytes file, const std::string& name) {
    NetpbmHeader header(file, name);
    const std::size_t channels = header.magic() == "PF" ? 3 : 1;
    const long long width = header.number("width"), height = header.number("height");
    checkSize(width, height, name);
    const double scale = header.real("scale");
    const std::size_t row = static_cast<std::size_t>(width) * channels;
    const std::size_t count = row * static_cast<std::size_t>(height);
    const Bytes data = header.data(4 * count);
    StoredImage image =
        blankPicture(row / channels, count / row, channels, StoredImage::Depth::Float);
    const auto load = scale < 0 ? loadLittle<std::uint32_t> : loadBig<std::uint32_t>;
    const float factor = static_cast<float>(std::fabs(scale));
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t fromTop = static_cast<std::size_t>(height) - 1 - i / row;
        const float value = std::bit_cast<float>(load(&data[4 * i])) * factor;
        if (!std::isfinite(value))
            failPicture(name, cat("the pixel ", i % row / channels, ",", fromTop,
                                  " is not a finite number"));
        image.floats[fromTop * row + i % row] = value;
    }
    return image;
}

void encodePfm(const Image& image, int threads, ByteSink use) {
    const std::string header = cat("PF\n", image.width(), " ", image.height(), "\n-1.0\n");
    const auto width = static_cast<std::size_t>(image.width());
    const auto height = static_cast<std::size_t>(image.height());
    // The lowest row comes first.
    makeRawFile(header, height, 12 * width, threads, use,
                [&](std::size_t first, std::size_t count, std::span<std::uint8_t> out) {
                    std::uint8_t* to = out.data();
                    for (std::size_t i = first; i < first + count; ++i)
                        for (const Rgb& p : image.pixels().subspan((height - 1 - i) * width, width))
                            for (const float value : {p.r, p.g, p.b}) {
                                storeLittle(to, std::bit_cast<std::uint32_t>(value));
                                to += 4;
                            }
                });
}
