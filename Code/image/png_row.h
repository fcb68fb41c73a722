// PngRow: the bytes of a row of a PNG picture, for who filters it.
// Private to image/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// A row of bytes as the filter wants it: zeros to the left, for the pixel before the first, and to
// the right up to a whole vector of any of byte_lanes.h.
class PngRow {
public:
    explicit PngRow(std::size_t size)
        : size_(size), bytes_(kLeft + (size + kWidest - 1) / kWidest * kWidest) {}
    std::span<std::uint8_t> bytes() { return std::span(bytes_).subspan(kLeft, size_); }
    const std::uint8_t* data() const { return bytes_.data() + kLeft; }
    std::size_t size() const { return size_; }

private:
    static constexpr std::size_t kWidest = 32, kLeft = 16; // a pixel has at most 8 bytes

    std::size_t size_;
    std::vector<std::uint8_t> bytes_;
};
