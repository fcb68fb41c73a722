// Image: a rectangle of linear float RGB pixels, and how it comes from and goes to a file.
// Knows nothing about scenes or rendering.
#pragma once

#include "base/raw_vector.h"
#include "base/vec.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

// How linear light becomes 8- or 16-bit values in a PPM or PNG file. PFM and OpenEXR are always
// linear.
struct Encoding {
    enum class Transfer { Srgb, Linear };
    Transfer transfer = Transfer::Srgb;
    int bits = 8; // 8 or 16; of OpenEXR 16 (HALF), and FLOAT otherwise
    // A PNG is written in four fifths of the time, and takes up to 1.8 times the room: its writer
    // does not look for what comes again.
    bool isDraft = false;
    bool operator==(const Encoding&) const = default;
};

// A picture as a file stores it, undecoded: what textures need (8-bit sRGB is filtered before it is
// decoded) and what the readers produce.
struct StoredImage {
    int width = 0, height = 0;
    int channels = 0; // 1 grey, 2 grey+alpha, 3 RGB, 4 RGBA
    enum class Depth { Bits8, Bits16, Float } depth = Depth::Bits8;
    std::vector<std::uint8_t> bytes;  // Bits8: row after row from the top, channels interleaved
    std::vector<std::uint16_t> words; // Bits16
    std::vector<float> floats;        // Float: linear and finite
    // The first of the floats that is a colour and was no number in the file: it is 0.
    std::optional<std::size_t> noNumber{};
};

class Image {
public:
    Image() = default;
    // Black pixels. Fails (ErrorKind::Input) when a side is not in 1..kMaxSide or there are more
    // than kMaxPixels.
    Image(int width, int height);
    // Reads any supported file, told apart by its first bytes. Whole codes are decoded with
    // `transfer`. Fails with the file's name and the reason.
    explicit Image(const std::string& fileName,
                   Encoding::Transfer transfer = Encoding::Transfer::Srgb);
    // Decodes whole codes with `transfer`; grey becomes three equal channels, alpha is left out.
    explicit Image(const StoredImage& stored,
                   Encoding::Transfer transfer = Encoding::Transfer::Srgb);

    int width() const { return width_; }
    int height() const { return height_; }
    // x from the left, y from the top; both inside the picture.
    Rgb pixel(int x, int y) const { return pixels_[index(x, y)]; }
    void setPixel(int x, int y, Rgb value) { pixels_[index(x, y)] = value; }
    std::span<const Rgb> pixels() const { return pixels_; }
    std::span<Rgb> pixels() { return pixels_; }

    // Writes .ppm (P6), .png, .pfm or .exr by the extension, through a temporary file that is
    // renamed, so that a broken picture never has the final name. The bytes do not depend on how
    // many threads make them. Fails with ErrorKind::Output.
    void write(const std::string& fileName, Encoding encoding = {}, int threads = 1) const;

    bool operator==(const Image&) const = default;

    static constexpr int kMaxSide = 65535;
    static constexpr long long kMaxPixels = 1LL << 28; // 16384 x 16384: 3 GiB as floats

private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }
    int width_ = 0, height_ = 0;
    ZeroedVector<Rgb> pixels_;
};

// Reads any supported file as it is stored. Palette and 1-, 2-, 4-bit PNG become 8 bits, a PPM with
// any maxval 8 bits where that is exact and 16 otherwise. Fails (ErrorKind::Input) with the file's
// name and the reason.
StoredImage readStoredImage(const std::string& fileName);
// The same from memory; `name` is used in messages.
StoredImage decodeImage(std::span<const std::uint8_t> file, const std::string& name);
// Bytes of a file, the same for any number of threads; `extension` is "ppm", "png", "pfm" or
// "exr".
std::vector<std::uint8_t> encodeImage(const Image& image, const std::string& extension,
                                      Encoding encoding, int threads = 1);
