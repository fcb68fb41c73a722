// A PNG file as its chunks say it is: everything but the pixels, which are still packed.
#include "base/text.h"
#include "image/bits.h"
#include "image/png.h"
#include "image/zlib.h"

#include <algorithm>
#include <bit>
#include <string_view>
#include <utility>

namespace {

std::uint32_t numberAt(Bytes bytes, std::size_t at) { return loadBig<std::uint32_t>(&bytes[at]); }

class PngChunkReader {
public:
    PngChunkReader(Bytes file, const std::string& name) : file_(file), name_(name) {}

    PngChunks read() {
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
    [[noreturn]] void broken(const std::string& what) const { failPicture(name_, what); }
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
        PngHeader& header = chunks_.header;
        checkSize(numberAt(data, 0), numberAt(data, 4), name_);
        header.width = numberAt(data, 0);
        header.height = numberAt(data, 4);
        header.depth = data[8];
        header.colourType = data[9];
        struct Allowed {
            unsigned colourType;
            std::string_view depths;
        };
        constexpr Allowed kAllowed[] = {{kPngGrey, "1, 2, 4, 8, 16"},
                                        {kPngRgb, "8, 16"},
                                        {kPngPalette, "1, 2, 4, 8"},
                                        {kPngGreyAlpha, "8, 16"},
                                        {kPngRgba, "8, 16"}};
        const auto allowed =
            std::find_if(std::begin(kAllowed), std::end(kAllowed),
                         [&](const Allowed& row) { return row.colourType == header.colourType; });
        if (allowed == std::end(kAllowed))
            broken(cat("the colour type is ", header.colourType, "; it must be 0, 2, 3, 4 or 6"));
        const bool isPower = std::has_single_bit(header.depth) && header.depth <= 16;
        const bool isWhole = header.depth >= 8;
        const bool needsWhole = header.colourType != kPngGrey && header.colourType != kPngPalette;
        if (!isPower || (needsWhole && !isWhole) ||
            (header.colourType == kPngPalette && header.depth == 16))
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
        if (type == kPngPalette) {
            if (chunks_.palette.empty()) broken("the tRNS chunk comes before the PLTE chunk");
            if (data.size() > chunks_.palette.size())
                broken("the tRNS chunk has more entries than the palette");
            for (std::size_t i = 0; i < data.size(); ++i) chunks_.palette[i].alpha = data[i];
            chunks_.hasPaletteAlpha = true;
            return;
        }
        if (type == kPngGreyAlpha || type == kPngRgba)
            broken("there is a tRNS chunk, but the pixels have alpha already");
        const std::size_t samples = chunks_.header.samples();
        if (data.size() != 2 * samples)
            broken(cat("the tRNS chunk has ", data.size(), " bytes; ", 2 * samples));
        chunks_.transparent.emplace();
        for (std::size_t i = 0; i < samples; ++i)
            (*chunks_.transparent)[i] = loadBig<std::uint16_t>(&data[2 * i]);
    }

    void takePixels(Bytes data) {
        if (!chunks_.packed.empty() && previous_ != "IDAT")
            broken("the IDAT chunks do not follow each other");
        if (chunks_.packed.empty()) chunks_.packed.reserve(file_.size());
        chunks_.packed.insert(chunks_.packed.end(), data.begin(), data.end());
    }

    PngChunks finished() {
        if (chunks_.packed.empty()) broken("there is no IDAT chunk: the picture has no pixels");
        if (chunks_.header.colourType == kPngPalette && chunks_.palette.empty())
            broken("the PLTE chunk is missing");
        return std::move(chunks_);
    }

    Bytes file_;
    const std::string& name_;
    PngChunks chunks_;
    std::string_view previous_; // type of the chunk before
};

} // namespace

PngChunks readPngChunks(Bytes file, const std::string& name) {
    return PngChunkReader(file, name).read();
}
