// Writes PNG: 8- or 16-bit RGB, filtered row by row, packed by zlib.h.
#include "base/for_each.h"
#include "base/parallel.h"
#include "image/png.h"
#include "image/zlib.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace {

using Buffer = std::vector<std::uint8_t>;

void putNumber(Buffer& out, std::size_t value) {
    for (const int shift : {24, 16, 8, 0}) out.push_back(static_cast<std::uint8_t>(value >> shift));
}

// The data follow, and endChunk(), which wants to know where it began.
std::size_t beginChunk(Buffer& out, std::string_view type) {
    const std::size_t start = out.size();
    putNumber(out, 0); // how many data
    out.insert(out.end(), type.begin(), type.end());
    return start;
}
void endChunk(Buffer& out, std::size_t start) {
    Buffer size;
    putNumber(size, out.size() - start - 8);
    std::copy(size.begin(), size.end(), out.begin() + static_cast<std::ptrdiff_t>(start));
    putNumber(out, crc32(std::span(out).subspan(start + 4)));
}
void putChunk(Buffer& out, std::string_view type, Bytes data) {
    const std::size_t start = beginChunk(out, type);
    out.insert(out.end(), data.begin(), data.end());
    endChunk(out, start);
}

// Some rows, filtered and packed as an IDAT chunk of their own.
struct Part {
    // Of the rows before they were packed.
    struct Sum {
        std::size_t bytes = 0;
        std::uint32_t adler = 1;
    };
    Buffer chunk;
    Sum sum;
};

// The picture in parts, which threads can work on: as many rows each as give kPartBytes, so that
// the file does not depend on how many threads there are. The rows of a part fit into a cache.
class PartEncoder {
public:
    explicit PartEncoder(const PixelSource& picture)
        : picture_(picture), height_(static_cast<std::size_t>(picture.height)),
          rowBytes_(picture.pixelBytes() * static_cast<std::size_t>(picture.width) + 1),
          rows_(std::max<std::size_t>(1, kPartBytes / rowBytes_)) {}

    std::size_t count() const { return (height_ + rows_ - 1) / rows_; }

    // The chunk is made in `memory`, of any content.
    Part part(std::size_t i, Buffer memory) const {
        const std::size_t first = i * rows_, end = std::min(height_, first + rows_);
        thread_local Buffer codes, filtered; // the system need not clear them every time
        filterRows(first, end, codes, filtered);
        memory.clear();
        const std::size_t start = beginChunk(memory, "IDAT");
        if (i == 0) memory.insert(memory.end(), kZlibHeader.begin(), kZlibHeader.end());
        const Packing packing = picture_.encoding.isDraft ? Packing::Runs : choosePacking(filtered);
        Buffer chunk = deflatePiece(filtered, end == height_, packing, std::move(memory));
        endChunk(chunk, start);
        return {std::move(chunk), {filtered.size(), adler32(filtered)}};
    }

private:
    static constexpr std::size_t kPartBytes = std::size_t{1} << 17;

    // With their filter types in front.
    void filterRows(std::size_t first, std::size_t end, Buffer& codes, Buffer& out) const {
        const std::size_t codeBytes = rowBytes_ - 1;
        const auto width = static_cast<std::size_t>(picture_.width);
        // Of the row above, zeros for the first of all, and of these rows.
        codes.assign(codeBytes * (end - first + 1), 0);
        const std::size_t above = first == 0 ? 0 : 1;
        picture_.encode(width * (first - above), width * (end - first + above),
                        std::span(codes).subspan(first == 0 ? codeBytes : 0));
        out.resize(rowBytes_ * (end - first));
        for (std::size_t y = 0; y < end - first; ++y) {
            const Bytes two = Bytes(codes).subspan(codeBytes * y, 2 * codeBytes);
            const auto row = std::span(out).subspan(rowBytes_ * y, rowBytes_);
            row[0] = static_cast<std::uint8_t>(filterRow(two.last(codeBytes), two.first(codeBytes),
                                                         picture_.pixelBytes(), row.subspan(1)));
        }
    }

    const PixelSource& picture_;
    std::size_t height_, rowBytes_, rows_; // a row with its filter
};

} // namespace

void encodePng(const PixelSource& picture, int threads, ByteSink use) {
    Buffer start(kPngSignature.begin(), kPngSignature.end());
    Buffer header;
    putNumber(header, static_cast<std::size_t>(picture.width));
    putNumber(header, static_cast<std::size_t>(picture.height));
    constexpr std::uint8_t kRgb = 2;
    header.insert(header.end(), {static_cast<std::uint8_t>(picture.encoding.bits), kRgb, 0, 0, 0});
    putChunk(start, "IHDR", header);
    if (picture.encoding.transfer == Encoding::Transfer::Srgb) {
        putChunk(start, "sRGB", std::array<std::uint8_t, 1>{0}); // intent: perceptual
    } else {
        Buffer gamma;
        putNumber(gamma, 100000); // 1.0
        putChunk(start, "gAMA", gamma);
    }
    use(start);

    const PartEncoder encoder(picture);
    std::vector<Part::Sum> sums(encoder.count());
    InOrder inOrder(encoder.count(), use);
    forEachOn(threads, encoder.count(), [&](std::size_t i) {
        Part part = encoder.part(i, inOrder.buffer());
        sums[i] = part.sum;
        inOrder.put(i, std::move(part.chunk));
    });

    std::uint32_t adler = 1;
    for (const Part::Sum& sum : sums) adler = adler32Joined(adler, sum.adler, sum.bytes);
    Buffer end;
    putChunk(end, "IDAT", zlibEnd(adler));
    putChunk(end, "IEND", {});
    use(end);
}
