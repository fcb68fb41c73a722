// Writes PNG: 8- or 16-bit RGB, filtered row by row, packed by deflate.h.
#include "image/checksum.h"
#include "image/deflate.h"
#include "image/formats.h"
#include "image/png.h"

#include <algorithm>
#include <string_view>

namespace {

void putNumber(std::vector<std::uint8_t>& out, std::size_t value) {
    for (const int shift : {24, 16, 8, 0}) out.push_back(static_cast<std::uint8_t>(value >> shift));
}

void putChunk(std::vector<std::uint8_t>& out, std::string_view type, Bytes data) {
    putNumber(out, data.size());
    const std::size_t start = out.size();
    out.insert(out.end(), type.begin(), type.end());
    out.insert(out.end(), data.begin(), data.end());
    putNumber(out, crc32(std::span(out).subspan(start)));
}

// Rows are worked on in pieces of a fixed length, which compilers turn into vector code; they are
// padded with zeros to whole pieces, and have zeros to the left for the pixel before the first.
constexpr std::size_t kPiece = 64, kLeft = 16;

struct FilteredRow {
    std::vector<std::uint8_t> bytes;
    // The sum of the bytes as signed numbers, without sign: a small one packs well (PNG
    // specification, 12.7).
    std::uint64_t cost = 0;
};

template <class Predict>
void filterRow(const std::uint8_t* row, const std::uint8_t* above, std::size_t size,
               std::size_t pixelBytes, FilteredRow& out, Predict predict) {
    out.cost = 0;
    for (std::size_t start = 0; start < size; start += kPiece) {
        const std::uint8_t* here = row + start;
        const std::uint8_t* up = above + start;
        // In front of the row for its first pixel: see kLeft.
        const std::uint8_t* const left = here - pixelBytes;
        const std::uint8_t* const upLeft = up - pixelBytes;
        std::array<std::uint8_t, kPiece> piece; // local, so that nothing else can change with it
        for (std::size_t i = 0; i < kPiece; ++i)
            piece[i] = static_cast<std::uint8_t>(here[i] - predict(left[i], up[i], upLeft[i]));
        std::uint16_t sum = 0; // at most 64 * 128
        for (std::size_t i = 0; i < kPiece; ++i) {
            const auto negative = static_cast<std::uint8_t>(-piece[i]);
            sum = static_cast<std::uint16_t>(sum + std::min(piece[i], negative));
        }
        out.cost += sum;
        std::copy(piece.begin(), piece.end(),
                  out.bytes.begin() + static_cast<std::ptrdiff_t>(start));
    }
}

// The rows with their filter types in front, as they are packed.
std::vector<std::uint8_t> filteredRows(const Image& image, Encoding encoding) {
    const std::size_t pixelBytes = 3 * static_cast<std::size_t>(encoding.bits / 8);
    const auto width = static_cast<std::size_t>(image.width());
    const auto height = static_cast<std::size_t>(image.height());
    const std::size_t size = pixelBytes * width;
    const std::size_t padded = (size + kPiece - 1) / kPiece * kPiece;
    std::vector<std::uint8_t> row(kLeft + padded), above(kLeft + padded);
    std::array<FilteredRow, kPngFilterCount> rows;
    for (FilteredRow& filtered : rows) filtered.bytes.resize(padded);
    std::vector<std::uint8_t> out;
    out.reserve((size + 1) * height);
    for (std::size_t y = 0; y < height; ++y) {
        encodePixels(image.pixels().subspan(y * width, width), encoding,
                     std::span(row).subspan(kLeft, size));
        using Byte = std::uint8_t;
        const auto filter = [&](PngFilter kind, auto predict) {
            filterRow(row.data() + kLeft, above.data() + kLeft, size, pixelBytes,
                      rows[static_cast<std::size_t>(kind)], predict);
        };
        filter(PngFilter::None, [](Byte, Byte, Byte) { return 0; });
        filter(PngFilter::Sub, [](Byte a, Byte, Byte) { return a; });
        filter(PngFilter::Up, [](Byte, Byte b, Byte) { return b; });
        filter(PngFilter::Average, [](Byte a, Byte b, Byte) { return (a + b) / 2; });
        filter(PngFilter::Paeth, paethPredictor);
        const auto best = std::min_element(
            rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.cost < b.cost; });
        out.push_back(static_cast<Byte>(best - rows.begin()));
        out.insert(out.end(), best->bytes.begin(),
                   best->bytes.begin() + static_cast<std::ptrdiff_t>(size));
        std::swap(row, above);
    }
    return out;
}

} // namespace

std::vector<std::uint8_t> encodePng(const Image& image, Encoding encoding) {
    std::vector<std::uint8_t> file(kPngSignature.begin(), kPngSignature.end());
    std::vector<std::uint8_t> header;
    putNumber(header, static_cast<std::size_t>(image.width()));
    putNumber(header, static_cast<std::size_t>(image.height()));
    constexpr std::uint8_t kRgb = 2;
    header.insert(header.end(), {static_cast<std::uint8_t>(encoding.bits), kRgb, 0, 0, 0});
    putChunk(file, "IHDR", header);
    if (encoding.transfer == Encoding::Transfer::Srgb) {
        putChunk(file, "sRGB", std::array<std::uint8_t, 1>{0}); // intent: perceptual
    } else {
        std::vector<std::uint8_t> gamma;
        putNumber(gamma, 100000); // 1.0
        putChunk(file, "gAMA", gamma);
    }
    const std::vector<std::uint8_t> packed = deflateZlib(filteredRows(image, encoding));
    constexpr std::size_t kLongestChunk = std::size_t{1} << 30;
    file.reserve(file.size() + packed.size() + 64);
    for (Bytes rest = packed; !rest.empty();) {
        const Bytes part = rest.first(std::min(rest.size(), kLongestChunk));
        putChunk(file, "IDAT", part);
        rest = rest.subspan(part.size());
    }
    putChunk(file, "IEND", {});
    return file;
}
