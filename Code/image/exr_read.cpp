// Reads OpenEXR pictures (OpenEXR File Layout, "Offset Tables", "Pixel data"): follows the table of
// offsets to the blocks of one part, and takes the colour out of them.
#include "base/text.h"
#include "image/bits.h"
#include "image/exr_blocks.h"
#include "image/exr_half.h"
#include "image/formats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace {

class ExrReader {
public:
    ExrReader(Bytes file, const std::string& name)
        : file_(file), name_(name), headers_(readExrHeaders(file, name)),
          colour_(chooseExrColour(headers_, name)), part_(headers_.parts[colour_.part]) {}

    StoredImage read() {
        checkPart();
        const std::vector<Chunk> chunks = findChunks();
        StoredImage out =
            blankPicture(width_, height_, colour_.channels.size(), StoredImage::Depth::Float);
        for (const Chunk& chunk : chunks)
            put(unpackExrBlock(compression_, chunk.block, chunk.packed, name_), chunk, out);
        return out;
    }

private:
    struct Chunk {
        std::size_t x0 = 0, y0 = 0; // in the data window
        ExrBlock block;
        Bytes packed;
    };

    [[noreturn]] void broken(const std::string& what) const { failPicture(name_, what); }

    // Sets the compression and the sizes of the picture and its blocks, or fails.
    void checkPart() {
        checkCompression();
        for (const ExrChannel& channel : part_.channels)
            if (channel.isSubsampled)
                broken(cat("the channel ", printable(channel.name),
                           " is subsampled, which is not read; both samplings must be 1"));
        if (!part_.dataWindow) broken("the attribute dataWindow is missing; each part needs one");
        const ExrWindow& window = *part_.dataWindow;
        const auto sides = [](std::int32_t from, std::int32_t to) {
            return static_cast<long long>(to) - from + 1;
        };
        const long long width = sides(window.x0, window.x1), height = sides(window.y0, window.y1);
        checkSize(width, height, name_);
        width_ = static_cast<std::size_t>(width);
        height_ = static_cast<std::size_t>(height);
        blockWidth_ = width_;
        blockHeight_ = exrRowsOf(compression_);
        if (part_.isTiled) {
            if (!part_.tiles) broken("the attribute tiles is missing; a part of tiles needs it");
            blockWidth_ = part_.tiles->width;
            blockHeight_ = part_.tiles->height;
            if (blockWidth_ == 0 || blockHeight_ == 0)
                broken(cat("the tiles have ", blockWidth_, "x", blockHeight_,
                           " pixels; both sides must be at least 1"));
        }
    }

    void checkCompression() {
        constexpr std::array<std::string_view, 14> kNames{
            "NONE", "RLE",  "ZIPS", "ZIP",      "PIZ",     "PXR24", "B44",
            "B44A", "DWAA", "DWAB", "HTJ2K256", "HTJ2K32", "LJ2K",  "ZSTD"};
        if (!part_.compression) broken("the attribute compression is missing; each part needs one");
        const unsigned code = *part_.compression;
        if (code > kExrPiz)
            broken(cat("the compression ",
                       code < kNames.size() ? std::string(kNames[code]) : cat("number ", code),
                       " is not read; what can be read: NONE, RLE, ZIPS, ZIP, PIZ"));
        compression_ = static_cast<ExrCompression>(code);
    }

    // Returns the blocks that the table of offsets leads to, row by row. The table of a part with
    // several levels begins with the full resolution.
    std::vector<Chunk> findChunks() const {
        const std::size_t columns = (width_ - 1) / blockWidth_ + 1;
        const std::size_t rows = (height_ - 1) / blockHeight_ + 1;
        const std::size_t count = columns * rows, start = tableStart();
        if (count > (file_.size() - start) / 8)
            broken(cat("the file is too short for the offsets of ", count,
                       " blocks; it is cut off or damaged"));
        const std::size_t size = ExrBlock{width_, height_, part_.channels}.bytes();
        if (size / maxExrInflation(compression_) > file_.size())
            broken(cat("the file is too short for ", width_, "x", height_, " pixels: ",
                       file_.size(), " bytes cannot hold ", size, "; it is cut off or damaged"));
        std::vector<Chunk> chunks;
        chunks.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            const auto offset = loadLittle<std::uint64_t>(file_.data() + start + 8 * i);
            chunks.push_back(chunkAt(offset, i % columns, i / columns));
        }
        return chunks;
    }

    // Returns where the offsets of the part are: behind those of the parts before it.
    std::size_t tableStart() const {
        std::size_t start = headers_.end;
        for (std::size_t i = 0; i < colour_.part; ++i) {
            if (!headers_.parts[i].chunkCount)
                broken(cat("the attribute chunkCount of part ", i,
                           " is missing; each part of several needs it"));
            start += std::size_t{8} * *headers_.parts[i].chunkCount;
            if (start > file_.size())
                broken("the file ends in the middle of the offsets; it is cut off or damaged");
        }
        return start;
    }

    // Returns the block in a column and a row of blocks. Its bytes come after the number of its
    // part, where there are several, its place, and its size.
    Chunk chunkAt(std::uint64_t offset, std::size_t column, std::size_t row) const {
        constexpr std::size_t kMostNumbers = 6;
        std::array<std::int64_t, kMostNumbers> right{};
        std::size_t numbers = 0;
        if (headers_.isMultiPart) right[numbers++] = static_cast<std::int64_t>(colour_.part);
        if (part_.isTiled) {
            right[numbers++] = static_cast<std::int64_t>(column);
            right[numbers++] = static_cast<std::int64_t>(row);
            numbers += 2; // the level is 0, 0
        } else {
            right[numbers++] = part_.dataWindow->y0 + static_cast<std::int64_t>(row * blockHeight_);
        }
        const auto missing = [&](std::string_view why) {
            broken(cat("the block ", column, ",", row, " is missing: ", why,
                       "; the file is cut off or damaged"));
        };
        if (offset < headers_.end || offset > file_.size() ||
            4 * (numbers + 1) > file_.size() - offset)
            missing(cat("its offset ", offset, " is not in the file"));
        const Bytes header = file_.subspan(static_cast<std::size_t>(offset), 4 * (numbers + 1));
        for (std::size_t i = 0; i < numbers; ++i)
            if (static_cast<std::int32_t>(loadLittle<std::uint32_t>(header.data() + 4 * i)) !=
                right[i])
                missing("another one is at its offset");
        const std::size_t size = loadLittle<std::uint32_t>(header.data() + 4 * numbers);
        const Bytes rest = file_.subspan(static_cast<std::size_t>(offset) + header.size());
        if (size > rest.size()) missing("the file ends in the middle of it");
        Chunk chunk{column * blockWidth_, row * blockHeight_, {}, rest.first(size)};
        chunk.block = {std::min(blockWidth_, width_ - chunk.x0),
                       std::min(blockHeight_, height_ - chunk.y0), part_.channels};
        if (chunk.block.bytes() / maxExrInflation(compression_) > size)
            missing(cat(size, " bytes cannot hold ", chunk.block.bytes()));
        return chunk;
    }

    // Copies the colour of an unpacked block to its place in the picture.
    void put(Bytes bytes, const Chunk& chunk, StoredImage& out) const {
        const std::size_t channels = colour_.channels.size(), rowBytes = chunk.block.rowBytes();
        const std::size_t colours = channels < 3 ? 1 : 3; // alpha follows
        std::size_t start = 0;                            // of a channel in a row of the block
        for (std::size_t i = 0; i < part_.channels.size(); ++i) {
            const auto place = std::find(colour_.channels.begin(), colour_.channels.end(), i);
            const std::size_t perValue = part_.channels[i].bytes();
            for (std::size_t y = 0; place != colour_.channels.end() && y < chunk.block.rows; ++y) {
                const std::uint8_t* from = bytes.data() + y * rowBytes + start;
                std::size_t to = ((chunk.y0 + y) * width_ + chunk.x0) * channels +
                                 static_cast<std::size_t>(place - colour_.channels.begin());
                for (std::size_t x = 0; x < chunk.block.columns; ++x, to += channels) {
                    const float value =
                        perValue == 2 ? halfAt(from + 2 * x) : floatAt(from + 4 * x);
                    if (std::isnan(value) && to % channels < colours)
                        out.noNumber = std::min(to, out.noNumber.value_or(to));
                    out.floats[to] = finite(value);
                }
            }
            start += perValue * chunk.block.columns;
        }
    }
    static float halfAt(const std::uint8_t* from) {
        return floatFromHalf(loadLittle<std::uint16_t>(from));
    }
    static float floatAt(const std::uint8_t* from) {
        return std::bit_cast<float>(loadLittle<std::uint32_t>(from));
    }
    static float finite(float value) {
        if (std::isfinite(value)) return value;
        return std::isnan(value) ? 0 : std::copysign(std::numeric_limits<float>::max(), value);
    }

    Bytes file_;
    const std::string& name_;
    ExrHeaders headers_;
    ExrColour colour_;
    const ExrPart& part_;
    ExrCompression compression_ = kExrNone;
    std::size_t width_ = 0, height_ = 0;
    std::size_t blockWidth_ = 0, blockHeight_ = 0; // those at the border may be smaller
};

} // namespace

StoredImage decodeExr(Bytes file, const std::string& name) { return ExrReader(file, name).read(); }
