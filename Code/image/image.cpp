#include "image/image.h"

#include "base/error.h"
#include "base/file_text.h"
#include "base/text.h"
#include "image/colour.h"
#include "image/formats.h"

#include <algorithm>
#include <array>
#include <string_view>

using namespace std::string_view_literals;

namespace {

std::size_t areaOf(int width, int height) {
    checkSize(width, height, "picture");
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

struct Format {
    std::string_view start; // first bytes of such a file
    std::string_view name;
    StoredImage (*decode)(Bytes file, const std::string& name); // nullptr: only known by name
};
constexpr Format kFormats[] = {
    {"P6"sv, "PPM", decodePpm},
    {"P3"sv, "PPM", decodePpm},
    {"P5"sv, "PGM", decodePpm},
    {"P2"sv, "PGM", decodePpm},
    {"\x89PNG"sv, "PNG", decodePng},
    {"PF"sv, "PFM", decodePfm},
    {"Pf"sv, "PFM", decodePfm},
    {"P1"sv, "a bitmap (PBM)", nullptr},
    {"P4"sv, "a bitmap (PBM)", nullptr},
    {"P7"sv, "a PAM picture", nullptr},
    {"\xFF\xD8\xFF"sv, "JPEG", decodeJpeg},
    {"GIF8"sv, "a GIF picture", nullptr},
    {"BM"sv, "a BMP picture", nullptr},
    {"\x76\x2F\x31\x01"sv, "OpenEXR", decodeExr},
    {"#?RADIANCE"sv, "Radiance HDR", decodeHdr},
    {"#?RGBE"sv, "Radiance HDR", decodeHdr},
    {"II*\0"sv, "a TIFF picture", nullptr},
    {"MM\0*"sv, "a TIFF picture", nullptr},
    {"RIFF"sv, "a WebP picture", nullptr},
};

// NOLINTNEXTLINE(cert-err58-cpp): short strings need no memory
const std::array<std::string, 4> kExtensions{"ppm", "png", "pfm", "exr"};

// One Rgb for each pixel of `values`, which has `channels` per pixel; grey fills all three.
template <class T, class Decode>
void decodePixels(const std::vector<T>& values, int channels, std::span<Rgb> out, Decode decode) {
    const T* value = values.data();
    for (Rgb& pixel : out) {
        if (channels < 3) {
            const float grey = decode(value[0]);
            pixel = {grey, grey, grey};
        } else {
            pixel = {decode(value[0]), decode(value[1]), decode(value[2])};
        }
        value += channels;
    }
}

// Codes of one byte or of two, the high one first.
template <class Code>
void putCodes(std::span<const Rgb> pixels, std::uint8_t* to, const Code& codeOf) {
    for (const Rgb& pixel : pixels)
        for (const float value : {pixel.r, pixel.g, pixel.b}) {
            const auto code = codeOf(value);
            if constexpr (sizeof code == 2) *to++ = static_cast<std::uint8_t>(code >> 8);
            *to++ = static_cast<std::uint8_t>(code);
        }
}

// An OpenEXR file of nothing but R, G and B: HALF where 16 bits are wanted, FLOAT otherwise.
void encodeBeauty(const Image& image, Encoding encoding, int threads, ByteSink use) {
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    const std::span<const Rgb> pixels = image.pixels();
    const ExrLayer beauty{
        "", {"R", "G", "B"}, {reinterpret_cast<const float*>(pixels.data()), 3 * pixels.size()}};
    encodeExr({&beauty, 1}, image.width(), image.height(), encoding.bits == 16, threads, use);
}

} // namespace

std::string extensionOf(const std::string& fileName) {
    const std::string extension = lowerExtension(fileName);
    return extension.empty() ? extension : extension.substr(1);
}

void encodeSource(const PixelSource& picture, const std::string& extension, int threads,
                  ByteSink use) {
    if (extension == "ppm") return encodePpm(picture, threads, use);
    if (extension == "png") return encodePng(picture, threads, use);
    fail(ErrorKind::Output,
         cat("error: unknown picture extension ", unknownName(extension, kExtensions)));
}

void failPicture(const std::string& name, std::string_view what) {
    fail(ErrorKind::Input, cat(name, ": error: ", what));
}

std::string printable(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c < ' ' || c > '~') c = '?';
    return out;
}
std::string quotedPart(std::string_view text, std::size_t most) {
    return cat("'", printable(text.substr(0, most)), text.size() > most ? "...'" : "'");
}

StoredImage blankPicture(std::size_t width, std::size_t height, std::size_t channels,
                         StoredImage::Depth depth) {
    StoredImage out;
    out.width = static_cast<int>(width);
    out.height = static_cast<int>(height);
    out.channels = static_cast<int>(channels);
    out.depth = depth;
    const std::size_t count = width * height * channels;
    if (depth == StoredImage::Depth::Bits8) out.bytes.resize(count);
    if (depth == StoredImage::Depth::Bits16) out.words.resize(count);
    if (depth == StoredImage::Depth::Float) out.floats.resize(count);
    return out;
}

void checkSize(long long width, long long height, const std::string& name) {
    if (width < 1 || height < 1 || width > Image::kMaxSide || height > Image::kMaxSide)
        failPicture(name, cat("the size ", width, "x", height,
                              " is not possible; both sides must be 1 to ", Image::kMaxSide));
    if (width * height > Image::kMaxPixels)
        failPicture(name, cat("the size ", width, "x", height, " is too large; at most ",
                              Image::kMaxPixels, " pixels"));
}

Image::Image(int width, int height)
    : width_(width), height_(height), pixels_(areaOf(width, height)) {}

Image::Image(const std::string& fileName, Encoding::Transfer transfer)
    : Image(readStoredImage(fileName), transfer) {}

Image::Image(const StoredImage& stored, Encoding::Transfer transfer)
    : Image(stored.width, stored.height) {
    const bool srgb = transfer == Encoding::Transfer::Srgb;
    switch (stored.depth) {
    case StoredImage::Depth::Bits8:
        decodePixels(stored.bytes, stored.channels, pixels_, srgb ? linearFromSrgb8 : unitFrom8);
        break;
    case StoredImage::Depth::Bits16:
        decodePixels(stored.words, stored.channels, pixels_, srgb ? linearFromSrgb16 : unitFrom16);
        break;
    case StoredImage::Depth::Float:
        decodePixels(stored.floats, stored.channels, pixels_, [](float value) { return value; });
        break;
    }
}

void Image::write(const std::string& fileName, Encoding encoding, int threads) const {
    const std::string extension = extensionOf(fileName);
    if (std::find(kExtensions.begin(), kExtensions.end(), extension) == kExtensions.end())
        fail(ErrorKind::Output, cat(fileName, ": error: unknown picture extension ",
                                    unknownName(extension, kExtensions)));
    writeFileAtomically(
        fileName, [&](ByteSink write) { encodeImage(*this, extension, encoding, threads, write); });
}

StoredImage readStoredImage(const std::string& fileName) {
    return decodeImage(readWholeFile(fileName), fileName);
}

StoredImage decodeImage(std::span<const std::uint8_t> file, const std::string& name) {
    constexpr std::string_view kRight =
        "; what can be read: PPM, PNG, PFM, JPEG, OpenEXR, Radiance HDR, TGA";
    if (file.empty()) failPicture(name, cat("the file is empty", kRight));
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    for (const Format& format : kFormats) {
        if (!text.starts_with(format.start)) continue;
        if (format.decode) return format.decode(file, name);
        failPicture(name, cat("this is ", format.name, kRight));
    }
    if (looksLikeTga(file)) return decodeTga(file, name); // it has no signature
    failPicture(name, cat("the file is no picture of a known kind", kRight));
}

std::vector<std::uint8_t> encodeImage(const Image& image, const std::string& extension,
                                      Encoding encoding, int threads) {
    std::vector<std::uint8_t> file;
    encodeImage(image, extension, encoding, threads, [&](std::span<const std::uint8_t> piece) {
        file.insert(file.end(), piece.begin(), piece.end());
    });
    return file;
}

void encodeImage(const Image& image, const std::string& extension, Encoding encoding, int threads,
                 ByteSink use) {
    const bool isHalf = encoding.bits == 16, isFloat = encoding.bits == 32 && extension == "exr";
    if (encoding.bits != 8 && !isHalf && !isFloat)
        fail(ErrorKind::Usage, cat("error: ", encoding.bits, " bits per channel; 8 or 16"));
    if (extension == "pfm") return encodePfm(image, threads, use);
    if (extension == "exr") return encodeBeauty(image, encoding, threads, use);
    encodeSource({image.width(), image.height(), encoding, image.pixels()}, extension, threads,
                 use);
}

void encodePixels(std::span<const Rgb> pixels, Encoding encoding, std::span<std::uint8_t> out) {
    const bool srgb = encoding.transfer == Encoding::Transfer::Srgb;
    if (encoding.bits == 8 && srgb)
        srgb8FromLinear(pixels, out.data());
    else if (encoding.bits == 8)
        putCodes(pixels, out.data(), [](float value) { return unit8From(value); });
    else if (srgb)
        putCodes(pixels, out.data(), [](float value) { return srgb16FromLinear(value); });
    else
        putCodes(pixels, out.data(), [](float value) { return unit16From(value); });
}
