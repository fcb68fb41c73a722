// The readers and writers of the file formats, one source file each; image.cpp chooses.
// Private to image/.
#pragma once

#include "base/in_order.h"
#include "image/image.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

using Bytes = std::span<const std::uint8_t>;

// All fail (ErrorKind::Input) with "name: error: what; what would be right", text parts with
// "name:line:col". The size in the header is checked against the bytes before memory is taken.
StoredImage decodePpm(Bytes file, const std::string& name);
StoredImage decodePfm(Bytes file, const std::string& name);
StoredImage decodePng(Bytes file, const std::string& name);

// Pixels as 8-bit or 16-bit (high byte first) codes; `out` has 3 * bits / 8 bytes per pixel.
void encodePixels(std::span<const Rgb> pixels, Encoding encoding, std::span<std::uint8_t> out);

// What is written: pixels that are encoded on the way, or codes that are there.
struct PixelSource {
    int width, height;
    Encoding encoding;
    std::span<const Rgb> pixels;
    Bytes codes{}; // if not empty, instead

    std::size_t pixelBytes() const { return 3 * static_cast<std::size_t>(encoding.bits / 8); }
    std::size_t count() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
    // Of some pixels in a row.
    void encode(std::size_t first, std::size_t number, std::span<std::uint8_t> out) const {
        if (codes.empty()) return encodePixels(pixels.subspan(first, number), encoding, out);
        const Bytes some = codes.subspan(pixelBytes() * first, out.size());
        std::copy(some.begin(), some.end(), out.begin());
    }
};
// "png" for "a.PNG".
std::string extensionOf(const std::string& fileName);
// encodeImage() in pieces, which are used one after the other while others are made. The extension
// says which format; a source may be PPM or PNG.
void encodeImage(const Image& image, const std::string& extension, Encoding encoding, int threads,
                 ByteSink use);
void encodeSource(const PixelSource& picture, const std::string& extension, int threads,
                  ByteSink use);
void encodePpm(const PixelSource& picture, int threads, ByteSink use);
void encodePng(const PixelSource& picture, int threads, ByteSink use);
void encodePfm(const Image& image, int threads, ByteSink use);

// Fails unless both sides are in 1..kMaxSide and the area is at most kMaxPixels.
void checkSize(long long width, long long height, const std::string& name);
