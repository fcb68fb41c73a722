// The readers and writers of the file formats, one source file or a few each; image.cpp chooses.
// Private to image/.
#pragma once

#include "base/parallel.h"
#include "image/image.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

using Bytes = std::span<const std::uint8_t>;

// All fail (ErrorKind::Input) with "name: error: what; what would be right", text parts with
// "name:line:col". The size in the header is checked against the bytes before memory is taken.
StoredImage decodePpm(Bytes file, const std::string& name);
StoredImage decodePfm(Bytes file, const std::string& name);
StoredImage decodePng(Bytes file, const std::string& name);

[[noreturn]] void failPicture(const std::string& name, std::string_view what);
// Of a file in a message: what is no printable ASCII becomes '?'; in quotes, at most so many bytes.
std::string printable(std::string_view text);
std::string quotedPart(std::string_view text, std::size_t most);

// A picture of zeros.
StoredImage blankPicture(std::size_t width, std::size_t height, std::size_t channels,
                         StoredImage::Depth depth = StoredImage::Depth::Bits8);

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

// ---- JPEG (ITU-T T.81, JFIF in T.871)

// Decodes a baseline, extended or progressive picture with 8 bits per sample and Huffman codes
// (SOF0, SOF1, SOF2). One component gives grey (1 channel), three give RGB (3 channels), 8 bits
// each, the rows from the top. Three components are YCbCr unless an Adobe segment or the
// identifiers 'R', 'G', 'B' say that they are RGB already, and no JFIF segment says otherwise.
// Chroma of half the size is interpolated linearly, of any other size repeated. A progressive
// picture may end before all bits of its coefficients have come: those are 0. EXIF segments are
// skipped, and with them the orientation.
//
// Fails (ErrorKind::Input) with "name: error: what; what would be right" for a damaged file, one
// whose last scan is cut off, and for CMYK, YCCK, 12 bits, lossless, hierarchical and arithmetic
// coding. Memory is at most some 8 KB for each byte of the file.
StoredImage decodeJpeg(Bytes file, const std::string& name);

// ---- Truevision TGA (Truevision TGA File Format Specification, version 2.0)

// Returns whether the file may be a TGA picture. Only version 2.0 has a signature, at the end of
// the file; without it all bytes of the header must be possible. So other files look like one, too:
// to be called when no format with a signature fits.
bool looksLikeTga(Bytes file);

// Computes the picture of a TGA file: types 1, 2 and 3 (colour-mapped, true-colour, grey) and 9, 10
// and 11 (the same run-length encoded), from any corner. Mapped and true colours have 15, 16, 24 or
// 32 bits, grey has 8, or 16 with alpha; 5 bits become value * 255 / 31, rounded down. There are
// 1 or 3 channels, and one more where the descriptor says that the bits beyond the colour are alpha
// (8 of 32 bits, 1 of 16, 8 of 16 beside grey); else these bits are left out. Fails
// (ErrorKind::Input) with `name` when the file is broken or too short, or of another type.
StoredImage decodeTga(Bytes file, const std::string& name);

// ---- Radiance HDR (G. Ward, "Real Pixels", Graphics Gems II; Radiance reference manual, "File
// Formats", pictures)

// What the text in front of the scanlines says.
struct HdrHeader {
    int width = 0, height = 0;
    // The file has `lines` scanlines of `length` pixels: rows or columns, from any corner. Pixel j
    // of scanline i is number start + i * lineStep + j * pixelStep of the picture, whose pixels are
    // counted row after row from the top.
    std::size_t lines = 0, length = 0;
    std::ptrdiff_t start = 0, lineStep = 0, pixelStep = 0;
    // The product of all EXPOSURE and COLORCORR lines: what red, green and blue were multiplied by
    // before they were stored. Each is in 1e-30 .. 1e30.
    std::array<double, 3> exposure{1, 1, 1};
    std::size_t dataStart = 0; // where the first scanline begins in the file
};

// Reads the lines up to and with the one of the resolution. Fails (ErrorKind::Input) with
// "name:line:1" when a line is not as it must be, and when the pixels are XYZE.
HdrHeader readHdrHeader(Bytes file, const std::string& name);

// Computes the picture of a Radiance HDR file with RGBE pixels: three floats per pixel, each
// mantissa * 2^(exponent - 136), divided by what the header says the values were multiplied by; an
// exponent of 0 is black. Scanlines may be flat or packed by either of the two run-length codes.
// Fails (ErrorKind::Input) with `name` when the file is broken or too short, before it takes memory
// for the pixels, and when a value is too large for a float.
StoredImage decodeHdr(Bytes file, const std::string& name);

// ---- OpenEXR (OpenEXR File Layout, version 2; the OpenEXR library where the document is silent):
// linear pictures of 16- or 32-bit floating-point numbers

// Decodes the data window of a file as Depth::Float with 1 (Y), 2 (Y, A), 3 (R, G, B) or 4 (R, G,
// B, A) channels; the display window is ignored. Reads parts of scan lines and of tiles (of those
// the full-resolution level) in any line order, channels of type HALF and FLOAT, and the
// compressions NONE, RLE, ZIPS, ZIP and PIZ.
// The colour is "R", "G", "B"; if a file has no such channels, "P.R", "P.G", "P.B" of the first
// prefix P in alphabetical order that has all three; if there is none either, "Y". The alpha is "A"
// of the same layer. Of several parts the first with R, G and B counts, else the first with Y.
// A StoredImage is finite: infinity becomes the largest float of its sign, and NaN becomes 0.
// Fails (ErrorKind::Input) when the file is damaged or incomplete, and when the picture is deep
// data, luminance-chroma, subsampled or compressed in another way.
StoredImage decodeExr(Bytes file, const std::string& name);

// Some channels of a picture that belong together.
struct ExrLayer {
    std::string name;                  // "" for the beauty, whose channels are "R", "G", "B"
    std::vector<std::string> channels; // "Z" of the layer "depth" is called "depth.Z" in the file
    std::span<const float> values;     // row by row from the top, channels interleaved per pixel
};

// Encodes the layers as one part of scan lines with ZIP compression. All channels are HALF or
// all FLOAT. A HALF is the nearest one, of two equally near the even one; what is too large,
// infinity too, becomes the largest finite HALF. FLOAT values are stored bit for bit.
// The bytes are the same for any number of threads (0: as many as the machine has). The compressed
// picture is held in memory until its size is known, because the table of offsets comes first.
// Fails (ErrorKind::Output) when the size is not possible, when there are no channels, when a
// channel's name is empty, longer than 255 bytes, holds a zero byte or occurs twice, and when a
// layer has not as many values as pixels times channels.
void encodeExr(std::span<const ExrLayer> layers, int width, int height, bool half, int threads,
               ByteSink use);
