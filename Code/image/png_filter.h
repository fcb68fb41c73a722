// Filters a row of a PNG picture so that it packs well. Knows bytes only, no colours and no files.
// Private to image/.
#pragma once

#include "image/png.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// A row of bytes as the filter wants it: zeros to the left, for the pixel before the first, and to
// the right up to a whole vector.
class PngRow {
public:
    explicit PngRow(std::size_t size)
        : size_(size), bytes_(kLeft + (size + kVector - 1) / kVector * kVector) {}
    std::span<std::uint8_t> bytes() { return std::span(bytes_).subspan(kLeft, size_); }
    const std::uint8_t* data() const { return bytes_.data() + kLeft; }
    std::size_t size() const { return size_; }

    static constexpr std::size_t kVector = 16, kLeft = 16; // a pixel has at most 8 bytes

private:
    std::size_t size_;
    std::vector<std::uint8_t> bytes_;
};

// Writes the row to `out` with the filter whose bytes, as signed numbers without their signs, have
// the smallest sum (PNG specification, 12.7; of equal sums the first filter). `above` is as long.
PngFilter filterRow(const PngRow& row, const PngRow& above, std::size_t pixelBytes,
                    std::span<std::uint8_t> out);
