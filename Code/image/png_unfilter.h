// Rows of a PNG file as they were before the filter. Private to image/.
#pragma once

#include "image/formats.h"
#include "image/png.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

// Adds what the filter has subtracted; left of the first pixel all is zero. With the pixel before
// in registers: each byte waits for the one `kBack` before it.
template <std::size_t kBack, class Predict>
void addPredicted(std::span<std::uint8_t> row, Bytes above, Predict predict) {
    std::array<std::uint8_t, kBack> left{}, corner{};
    for (std::size_t i = 0; i + kBack <= row.size(); i += kBack)
        for (std::size_t k = 0; k < kBack; ++k) {
            const std::uint8_t up = above[i + k];
            left[k] = static_cast<std::uint8_t>(row[i + k] + predict(left[k], up, corner[k]));
            corner[k] = up;
            row[i + k] = left[k];
        }
}

// `above` is all zero for the first row.
template <std::size_t kBack>
void unfilterRow(PngFilter filter, std::span<std::uint8_t> row, Bytes above) {
    using Byte = std::uint8_t;
    switch (filter) {
    case PngFilter::None: break;
    case PngFilter::Sub:
        addPredicted<kBack>(row, above, [](Byte a, Byte, Byte) { return a; });
        break;
    case PngFilter::Up: // no byte waits for another
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = static_cast<Byte>(row[i] + above[i]);
        break;
    case PngFilter::Average:
        addPredicted<kBack>(row, above, [](Byte a, Byte b, Byte) { return (a + b) / 2; });
        break;
    case PngFilter::Paeth: addPredicted<kBack>(row, above, paethPredictor); break;
    }
}

using UnfilterRow = void (*)(PngFilter, std::span<std::uint8_t>, Bytes);
// For pixels of so many bytes, 1 where they are smaller.
inline UnfilterRow unfilterFor(std::size_t pixelBytes) {
    switch (pixelBytes) {
    case 2: return unfilterRow<2>;
    case 3: return unfilterRow<3>;
    case 4: return unfilterRow<4>;
    case 6: return unfilterRow<6>;
    case 8: return unfilterRow<8>;
    default: return unfilterRow<1>;
    }
}
