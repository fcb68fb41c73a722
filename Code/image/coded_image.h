// CodedImage: a picture as a file of 8 bits has it, for who needs no more of it than that file: a
// quarter of the memory of an Image, which would be touched for the first time only to be read
// once.
#pragma once

#include "base/raw_vector.h"
#include "image/image.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

struct PixelSource;

class CodedImage {
public:
    CodedImage() = default;
    // Zeros; the encoding has 8 bits. Fails as Image does.
    CodedImage(int width, int height, Encoding encoding);

    bool isEmpty() const { return codes_.empty(); }
    int width() const { return width_; }
    int height() const { return height_; }
    Encoding encoding() const { return encoding_; }
    PixelSource source() const;
    // Three per pixel, row after row from the top.
    std::span<const std::uint8_t> codes() const { return codes_; }

    // Pixels of a row, from (x, y) on; threads may do this for different pixels at a time.
    void put(int x, int y, std::span<const Rgb> pixels);
    // As many pixels of so many rows, all alike.
    void fill(int x, int y, int width, int height, Rgb pixel);

    // The file that Image::write() makes of the same pixels: .ppm or .png.
    void write(const std::string& fileName, int threads = 1) const;

private:
    std::span<std::uint8_t> codesAt(int x, int y, std::size_t pixels);

    int width_ = 0, height_ = 0;
    Encoding encoding_;
    ZeroedVector<std::uint8_t> codes_;
};

// As encodeImage().
std::vector<std::uint8_t> encodeImage(const CodedImage& image, const std::string& extension,
                                      int threads = 1);
