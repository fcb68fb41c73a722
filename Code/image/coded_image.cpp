#include "image/coded_image.h"

#include "base/file_text.h"
#include "image/formats.h"

#include <algorithm>

CodedImage::CodedImage(int width, int height, Encoding encoding)
    : width_(width), height_(height), encoding_(encoding) {
    checkSize(width, height, "picture");
    codes_.resize(source().count() * source().pixelBytes());
}

PixelSource CodedImage::source() const { return {width_, height_, encoding(), {}, codes_}; }

std::span<std::uint8_t> CodedImage::codesAt(int x, int y, std::size_t pixels) {
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                           static_cast<std::size_t>(x);
    return std::span(codes_).subspan(3 * at, 3 * pixels);
}

void CodedImage::put(int x, int y, std::span<const Rgb> pixels) {
    encodePixels(pixels, encoding(), codesAt(x, y, pixels.size()));
}

void CodedImage::fill(int x, int y, int width, int height, Rgb pixel) {
    const std::vector<Rgb> row(static_cast<std::size_t>(width), pixel);
    put(x, y, row);
    const std::span<const std::uint8_t> first = codesAt(x, y, row.size());
    for (int below = 1; below < height; ++below)
        std::copy(first.begin(), first.end(), codesAt(x, y + below, row.size()).begin());
}

void CodedImage::write(const std::string& fileName, int threads) const {
    const std::string extension = extensionOf(fileName);
    writeFileAtomically(fileName,
                        [&](ByteSink write) { encodeSource(source(), extension, threads, write); });
}

std::vector<std::uint8_t> encodeImage(const CodedImage& image, const std::string& extension,
                                      int threads) {
    std::vector<std::uint8_t> file;
    encodeSource(image.source(), extension, threads, [&](std::span<const std::uint8_t> piece) {
        file.insert(file.end(), piece.begin(), piece.end());
    });
    return file;
}
