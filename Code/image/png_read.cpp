// Reads PNG: every colour type, depth and interlace method of the specification. Ancillary chunks
// other than tRNS are skipped; colour management is the caller's business.
#include "base/error.h"
#include "base/text.h"
#include "image/checksum.h"
#include "image/formats.h"
#include "image/inflate.h"
#include "image/png.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <string_view>

namespace {

enum ColourType : unsigned { kGrey = 0, kRgb = 2, kPalette = 3, kGreyAlpha = 4, kRgba = 6 };

struct Header {
    std::size_t width = 0, height = 0;
    unsigned depth = 0, colourType = 0; // bits per sample
    bool isInterlaced = false;

    std::size_t samples() const { // per pixel in the file
        switch (colourType) {
        case kRgb: return 3;
        case kGreyAlpha: return 2;
        case kRgba: return 4;
        default: return 1;
        }
    }
    std::size_t rowBytes(std::size_t columns) const {
        return (columns * samples() * depth + 7) / 8;
    }
};

struct Colour8 {
    std::uint8_t r = 0, g = 0, b = 0, alpha = 255;
};

// Everything but the pixels, and the packed pixels in pieces.
struct Chunks {
    Header header;
    std::vector<Colour8> palette;
    std::optional<std::array<std::uint16_t, 3>> transparent; // the colour whose alpha is 0
    bool hasPaletteAlpha = false;
    std::vector<std::uint8_t> packed;
};

// The pixels of an interlaced picture come in 7 passes, each a coarser grid (Adam7).
struct Pass {
    std::size_t x0, y0, dx, dy;
};
constexpr Pass kAdam7[] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                           {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
constexpr Pass kWhole[] = {{0, 0, 1, 1}};

std::span<const Pass> passesOf(const Header& header) {
    return header.isInterlaced ? std::span<const Pass>(kAdam7) : std::span<const Pass>(kWhole);
}
std::size_t stepsIn(std::size_t size, std::size_t start, std::size_t step) {
    return size <= start ? 0 : (size - start + step - 1) / step;
}

std::uint32_t numberAt(Bytes bytes, std::size_t at) {
    return static_cast<std::uint32_t>(bytes[at]) << 24 |
           static_cast<std::uint32_t>(bytes[at + 1]) << 16 |
           static_cast<std::uint32_t>(bytes[at + 2]) << 8 | bytes[at + 3];
}
std::uint16_t wordAt(Bytes bytes, std::size_t at) {
    return static_cast<std::uint16_t>(bytes[at] << 8 | bytes[at + 1]);
}

class ChunkReader {
public:
    ChunkReader(Bytes file, const std::string& name) : file_(file), name_(name) {}

    Chunks read() {
        if (file_.size() < kPngSignature.size() ||
            !std::equal(kPngSignature.begin(), kPngSignature.end(), file_.begin()))
            broken("the PNG signature is damaged (was the file copied as text?)");
        for (std::size_t at = kPngSignature.size(); at < file_.size();) {
            const Bytes rest = file_.subspan(at);
            if (rest.size() < 12) broken("the file ends in the middle of a chunk");
            const std::size_t length = numberAt(rest, 0);
            const std::string_view type(reinterpret_cast<const char*>(rest.data()) + 4, 4);
            if (!std::all_of(type.begin(), type.end(), isLetter))
                broken(cat("no chunk starts at byte ", at));
            if (length > rest.size() - 12)
                broken(cat("the file ends in the middle of the ", type, " chunk"));
            if (crc32(rest.subspan(4, length + 4)) != numberAt(rest, 8 + length))
                broken(cat("the checksum (CRC) of the ", type, " chunk does not fit"));
            if (at == kPngSignature.size() && type != "IHDR") broken("the first chunk is not IHDR");
            if (type == "IEND") return finished();
            take(type, rest.subspan(8, length));
            previous_ = type;
            at += 12 + length;
        }
        broken("the file ends before the IEND chunk");
    }

private:
    [[noreturn]] void broken(const std::string& what) const {
        fail(ErrorKind::Input, cat(name_, ": error: ", what));
    }
    static bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

    void take(std::string_view type, Bytes data) {
        constexpr char kAncillary = 0x20; // a small first letter: may be skipped
        if (type == "IHDR")
            takeHeader(data);
        else if (type == "PLTE")
            takePalette(data);
        else if (type == "tRNS")
            takeTransparency(data);
        else if (type == "IDAT")
            takePixels(data);
        else if (!(type[0] & kAncillary))
            broken(cat("the chunk ", type, " is necessary for the picture, but unknown"));
    }

    void takeHeader(Bytes data) {
        if (!previous_.empty()) broken("there are two IHDR chunks");
        if (data.size() != 13) broken(cat("the IHDR chunk has ", data.size(), " bytes; 13"));
        Header& header = chunks_.header;
        checkSize(numberAt(data, 0), numberAt(data, 4), name_);
        header.width = numberAt(data, 0);
        header.height = numberAt(data, 4);
        header.depth = data[8];
        header.colourType = data[9];
        struct Allowed {
            unsigned colourType;
            std::string_view depths;
        };
        constexpr Allowed kAllowed[] = {{kGrey, "1, 2, 4, 8, 16"},
                                        {kRgb, "8, 16"},
                                        {kPalette, "1, 2, 4, 8"},
                                        {kGreyAlpha, "8, 16"},
                                        {kRgba, "8, 16"}};
        const auto allowed =
            std::find_if(std::begin(kAllowed), std::end(kAllowed),
                         [&](const Allowed& row) { return row.colourType == header.colourType; });
        if (allowed == std::end(kAllowed))
            broken(cat("the colour type is ", header.colourType, "; it must be 0, 2, 3, 4 or 6"));
        const bool isPower = std::has_single_bit(header.depth) && header.depth <= 16;
        const bool isWhole = header.depth >= 8;
        const bool needsWhole = header.colourType != kGrey && header.colourType != kPalette;
        if (!isPower || (needsWhole && !isWhole) ||
            (header.colourType == kPalette && header.depth == 16))
            broken(cat("the bit depth is ", header.depth, "; with colour type ", header.colourType,
                       " it must be one of ", allowed->depths));
        if (data[10] != 0)
            broken(cat("the compression method is ", data[10] + 0, "; only 0 exists"));
        if (data[11] != 0) broken(cat("the filter method is ", data[11] + 0, "; only 0 exists"));
        if (data[12] > 1)
            broken(cat("the interlace method is ", data[12] + 0, "; it must be 0 or 1"));
        header.isInterlaced = data[12] == 1;
    }

    void takePalette(Bytes data) {
        if (!chunks_.palette.empty()) broken("there are two PLTE chunks");
        if (!chunks_.packed.empty()) broken("the PLTE chunk comes after the pixels");
        if (data.empty() || data.size() % 3 != 0 || data.size() > std::size_t{3} * 256)
            broken(
                cat("the PLTE chunk has ", data.size(), " bytes; 3 for each of 1 to 256 colours"));
        for (std::size_t i = 0; i < data.size(); i += 3)
            chunks_.palette.push_back({data[i], data[i + 1], data[i + 2]});
    }

    void takeTransparency(Bytes data) {
        const unsigned type = chunks_.header.colourType;
        if (!chunks_.packed.empty()) broken("the tRNS chunk comes after the pixels");
        if (type == kPalette) {
            if (chunks_.palette.empty()) broken("the tRNS chunk comes before the PLTE chunk");
            if (data.size() > chunks_.palette.size())
                broken("the tRNS chunk has more entries than the palette");
            for (std::size_t i = 0; i < data.size(); ++i) chunks_.palette[i].alpha = data[i];
            chunks_.hasPaletteAlpha = true;
            return;
        }
        if (type == kGreyAlpha || type == kRgba)
            broken("there is a tRNS chunk, but the pixels have alpha already");
        const std::size_t samples = chunks_.header.samples();
        if (data.size() != 2 * samples)
            broken(cat("the tRNS chunk has ", data.size(), " bytes; ", 2 * samples));
        chunks_.transparent.emplace();
        for (std::size_t i = 0; i < samples; ++i) (*chunks_.transparent)[i] = wordAt(data, 2 * i);
    }

    void takePixels(Bytes data) {
        if (!chunks_.packed.empty() && previous_ != "IDAT")
            broken("the IDAT chunks do not follow each other");
        if (chunks_.packed.empty()) chunks_.packed.reserve(file_.size());
        chunks_.packed.insert(chunks_.packed.end(), data.begin(), data.end());
    }

    Chunks finished() {
        if (chunks_.packed.empty()) broken("there is no IDAT chunk: the picture has no pixels");
        if (chunks_.header.colourType == kPalette && chunks_.palette.empty())
            broken("the PLTE chunk is missing");
        return std::move(chunks_);
    }

    Bytes file_;
    const std::string& name_;
    Chunks chunks_;
    std::string_view previous_; // type of the chunk before
};

// Adds what the filter has subtracted; left of the first pixel all is zero. With the pixel before
// in registers: each byte waits for the one `kBack` before it.
template <std::size_t kBack, class Predict>
void addPredicted(std::span<std::uint8_t> row, Bytes above, Predict predict) {
    std::array<std::uint8_t, kBack> left{}, corner{};
    for (std::size_t i = 0; i + kBack <= row.size(); i += kBack)
        for (std::size_t k = 0; k < kBack; ++k) {
            const std::uint8_t up = above[i + k];
            left[k] = static_cast<std::uint8_t>(row[i + k] + predict(left[k], up, corner[k]));
            corner[k] = up;
            row[i + k] = left[k];
        }
}

// `above` is all zero for the first row.
template <std::size_t kBack>
void unfilterRow(PngFilter filter, std::span<std::uint8_t> row, Bytes above) {
    using Byte = std::uint8_t;
    switch (filter) {
    case PngFilter::None: break;
    case PngFilter::Sub:
        addPredicted<kBack>(row, above, [](Byte a, Byte, Byte) { return a; });
        break;
    case PngFilter::Up: // no byte waits for another
        for (std::size_t i = 0; i < row.size(); ++i) row[i] = static_cast<Byte>(row[i] + above[i]);
        break;
    case PngFilter::Average:
        addPredicted<kBack>(row, above, [](Byte a, Byte b, Byte) { return (a + b) / 2; });
        break;
    case PngFilter::Paeth: addPredicted<kBack>(row, above, paethPredictor); break;
    }
}

using UnfilterRow = void (*)(PngFilter, std::span<std::uint8_t>, Bytes);
// For pixels of so many bytes, 1 where they are smaller.
UnfilterRow unfilterFor(std::size_t pixelBytes) {
    switch (pixelBytes) {
    case 2: return unfilterRow<2>;
    case 3: return unfilterRow<3>;
    case 4: return unfilterRow<4>;
    case 6: return unfilterRow<6>;
    case 8: return unfilterRow<8>;
    default: return unfilterRow<1>;
    }
}

// Puts the samples of unpacked rows where they belong in the picture.
class PixelWriter {
public:
    PixelWriter(const Chunks& chunks, const std::string& name) : chunks_(chunks), name_(name) {
        const Header& header = chunks.header;
        const bool isPalette = header.colourType == kPalette;
        const bool addsAlpha = chunks.transparent.has_value() || chunks.hasPaletteAlpha;
        out_.width = static_cast<int>(header.width);
        out_.height = static_cast<int>(header.height);
        out_.channels = static_cast<int>((isPalette ? 3 : header.samples()) + (addsAlpha ? 1 : 0));
        const std::size_t count =
            header.width * header.height * static_cast<std::size_t>(out_.channels);
        if (header.depth == 16) {
            out_.depth = StoredImage::Depth::Bits16;
            out_.words.resize(count);
        } else {
            out_.bytes.resize(count);
        }
    }

    void putRow(Bytes row, std::size_t columns, std::size_t y, std::size_t x0, std::size_t dx) {
        const Header& header = chunks_.header;
        const auto channels = static_cast<std::size_t>(out_.channels);
        const std::size_t samples = header.samples();
        if (header.depth == 8 && channels == samples && dx == 1 && header.colourType != kPalette) {
            std::copy(row.begin(), row.end(),
                      out_.bytes.begin() +
                          static_cast<std::ptrdiff_t>((y * header.width + x0) * channels));
            return;
        }
        // 1, 2, 4 bits to 8: multiplied by 255, 85, 17.
        const unsigned toByte = header.depth < 8 ? 255u / ((1u << header.depth) - 1) : 1;
        for (std::size_t i = 0; i < columns; ++i) {
            const std::size_t to = (y * header.width + x0 + i * dx) * channels;
            if (header.colourType == kPalette) {
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
        if (depth == 16) return wordAt(row, 2 * index);
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
            fail(ErrorKind::Input, cat(name_, ": error: a pixel has colour ", index,
                                       ", but the palette has only ", chunks_.palette.size()));
        const Colour8 colour = chunks_.palette[index];
        out_.bytes[at] = colour.r;
        out_.bytes[at + 1] = colour.g;
        out_.bytes[at + 2] = colour.b;
        if (chunks_.hasPaletteAlpha) out_.bytes[at + 3] = colour.alpha;
    }

    const Chunks& chunks_;
    const std::string& name_;
    StoredImage out_;
};

} // namespace

StoredImage decodePng(Bytes file, const std::string& name) {
    const Chunks chunks = ChunkReader(file, name).read();
    const Header& header = chunks.header;
    std::size_t size = 0;
    for (const Pass& pass : passesOf(header)) {
        const std::size_t columns = stepsIn(header.width, pass.x0, pass.dx);
        const std::size_t rows = stepsIn(header.height, pass.y0, pass.dy);
        if (columns > 0) size += rows * (1 + header.rowBytes(columns));
    }
    if (size / kMaxInflation > chunks.packed.size())
        fail(ErrorKind::Input,
             cat(name, ": error: the file is too short for ", header.width, "x", header.height,
                 " pixels: ", chunks.packed.size(), " bytes cannot hold ", size));
    std::vector<std::uint8_t> rows = inflateZlib(chunks.packed, size, name);

    PixelWriter picture(chunks, name);
    const UnfilterRow unfilter = unfilterFor(header.samples() * header.depth / 8);
    const std::vector<std::uint8_t> zeros(header.rowBytes(header.width));
    std::span<std::uint8_t> rest(rows);
    for (const Pass& pass : passesOf(header)) {
        const std::size_t columns = stepsIn(header.width, pass.x0, pass.dx);
        if (columns == 0) continue;
        const std::size_t rowBytes = header.rowBytes(columns);
        Bytes above(zeros);
        for (std::size_t y = pass.y0; y < header.height; y += pass.dy) {
            if (rest[0] >= kPngFilterCount)
                fail(ErrorKind::Input, cat(name, ": error: row ", y, " has the filter ",
                                           rest[0] + 0, "; it must be 0 to 4"));
            const auto row = rest.subspan(1, rowBytes);
            unfilter(static_cast<PngFilter>(rest[0]), row, above);
            picture.putRow(row, columns, y, pass.x0, pass.dx);
            above = row;
            rest = rest.subspan(1 + rowBytes);
        }
    }
    return std::move(picture).result();
}
