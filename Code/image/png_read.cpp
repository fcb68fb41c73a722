// Reads PNG: every colour type, depth and interlace method of the specification. Colour management
// is the caller's business.
#include "base/text.h"
#include "image/bits.h"
#include "image/png.h"
#include "image/zlib.h"

#include <algorithm>

namespace {

// The pixels of an interlaced picture come in 7 passes, each a coarser grid (Adam7).
struct Pass {
    std::size_t x0, y0, dx, dy;
};
constexpr Pass kAdam7[] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                           {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
constexpr Pass kWhole[] = {{0, 0, 1, 1}};

std::span<const Pass> passesOf(const PngHeader& header) {
    return header.isInterlaced ? std::span<const Pass>(kAdam7) : std::span<const Pass>(kWhole);
}
std::size_t stepsIn(std::size_t size, std::size_t start, std::size_t step) {
    return size <= start ? 0 : (size - start + step - 1) / step;
}

// Puts the samples of unpacked rows where they belong in the picture.
class PixelWriter {
public:
    PixelWriter(const PngChunks& chunks, const std::string& name) : chunks_(chunks), name_(name) {
        const PngHeader& header = chunks.header;
        const bool isPalette = header.colourType == kPngPalette;
        const bool addsAlpha = chunks.transparent.has_value() || chunks.hasPaletteAlpha;
        using enum StoredImage::Depth;
        out_ = blankPicture(header.width, header.height,
                            (isPalette ? 3 : header.samples()) + (addsAlpha ? 1 : 0),
                            header.depth == 16 ? Bits16 : Bits8);
    }

    void putRow(Bytes row, std::size_t columns, std::size_t y, std::size_t x0, std::size_t dx) {
        const PngHeader& header = chunks_.header;
        const auto channels = static_cast<std::size_t>(out_.channels);
        const std::size_t samples = header.samples();
        if (header.depth == 8 && channels == samples && dx == 1 &&
            header.colourType != kPngPalette) {
            std::copy(row.begin(), row.end(),
                      out_.bytes.begin() +
                          static_cast<std::ptrdiff_t>((y * header.width + x0) * channels));
            return;
        }
        // 1, 2, 4 bits to 8: multiplied by 255, 85, 17.
        const unsigned toByte = header.depth < 8 ? 255u / ((1u << header.depth) - 1) : 1;
        for (std::size_t i = 0; i < columns; ++i) {
            const std::size_t to = (y * header.width + x0 + i * dx) * channels;
            if (header.colourType == kPngPalette) {
                putColour(to, sampleAt(row, i));
                continue;
            }
            bool isTransparent = chunks_.transparent.has_value();
            for (std::size_t s = 0; s < samples; ++s) {
                const unsigned sample = sampleAt(row, i * samples + s);
                isTransparent = isTransparent && sample == (*chunks_.transparent)[s];
                put(to + s, sample * toByte);
            }
            if (chunks_.transparent) put(to + samples, isTransparent ? 0 : 0xFFFF);
        }
    }
    StoredImage result() && { return std::move(out_); }

private:
    unsigned sampleAt(Bytes row, std::size_t index) const {
        const unsigned depth = chunks_.header.depth;
        if (depth == 8) return row[index];
        if (depth == 16) return loadBig<std::uint16_t>(&row[2 * index]);
        const std::size_t bit = index * depth; // the leftmost sample has the highest bits
        return row[bit / 8] >> (8 - depth - bit % 8) & ((1u << depth) - 1);
    }
    void put(std::size_t at, unsigned value) { // the low bits
        if (out_.words.empty())
            out_.bytes[at] = static_cast<std::uint8_t>(value);
        else
            out_.words[at] = static_cast<std::uint16_t>(value);
    }
    void putColour(std::size_t at, unsigned index) {
        if (index >= chunks_.palette.size())
            failPicture(name_, cat("a pixel has colour ", index, ", but the palette has only ",
                                   chunks_.palette.size()));
        const PngColour colour = chunks_.palette[index];
        out_.bytes[at] = colour.r;
        out_.bytes[at + 1] = colour.g;
        out_.bytes[at + 2] = colour.b;
        if (chunks_.hasPaletteAlpha) out_.bytes[at + 3] = colour.alpha;
    }

    const PngChunks& chunks_;
    const std::string& name_;
    StoredImage out_;
};

} // namespace

StoredImage decodePng(Bytes file, const std::string& name) {
    const PngChunks chunks = readPngChunks(file, name);
    const PngHeader& header = chunks.header;
    std::size_t size = 0;
    for (const Pass& pass : passesOf(header)) {
        const std::size_t columns = stepsIn(header.width, pass.x0, pass.dx);
        const std::size_t rows = stepsIn(header.height, pass.y0, pass.dy);
        if (columns > 0) size += rows * (1 + header.rowBytes(columns));
    }
    if (size / kMaxInflation > chunks.packed.size())
        failPicture(name, cat("the file is too short for ", header.width, "x", header.height,
                              " pixels: ", chunks.packed.size(), " bytes cannot hold ", size));
    std::vector<std::uint8_t> rows = inflateZlib(chunks.packed, size, name);

    PixelWriter picture(chunks, name);
    const std::size_t pixelBytes = header.samples() * header.depth / 8;
    const std::vector<std::uint8_t> zeros(header.rowBytes(header.width));
    std::span<std::uint8_t> rest(rows);
    for (const Pass& pass : passesOf(header)) {
        const std::size_t columns = stepsIn(header.width, pass.x0, pass.dx);
        if (columns == 0) continue;
        const std::size_t rowBytes = header.rowBytes(columns);
        Bytes above(zeros);
        for (std::size_t y = pass.y0; y < header.height; y += pass.dy) {
            if (rest[0] >= kPngFilterCount)
                failPicture(name,
                            cat("row ", y, " has the filter ", rest[0] + 0, "; it must be 0 to 4"));
            const auto row = rest.subspan(1, rowBytes);
            unfilterRow(static_cast<PngFilter>(rest[0]), row, above, pixelBytes);
            picture.putRow(row, columns, y, pass.x0, pass.dx);
            above = row;
            rest = rest.subspan(1 + rowBytes);
        }
    }
    return std::move(picture).result();
}
