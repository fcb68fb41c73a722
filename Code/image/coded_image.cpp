#include "image/coded_image.h"

#include "base/file.h"
#include "image/formats.h"

CodedImage::CodedImage(int width, int height, Encoding::Transfer transfer)
    : width_(width), height_(height), transfer_(transfer) {
    checkSize(width, height, "picture");
    codes_.resize(source().count() * source().pixelBytes());
}

PixelSource CodedImage::source() const { return {width_, height_, encoding(), {}, codes_}; }

void CodedImage::put(int x, int y, std::span<const Rgb> pixels) {
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                           static_cast<std::size_t>(x);
    encodePixels(pixels, encoding(), std::span(codes_).subspan(3 * at, 3 * pixels.size()));
}

void CodedImage::write(const std::string& fileName, int threads) const {
    const std::string extension = extensionOf(fileName);
    writeFileAtomically(fileName, codes_.size() + 64, [&](const ByteSink& write) {
        encodeSource(source(), extension, threads, write);
    });
}

std::vector<std::uint8_t> encodeImage(const CodedImage& image, const std::string& extension,
                                      int threads) {
    std::vector<std::uint8_t> file;
    encodeSource(image.source(), extension, threads, [&](std::span<const std::uint8_t> piece) {
        file.insert(file.end(), piece.begin(), piece.end());
    });
    return file;
}
