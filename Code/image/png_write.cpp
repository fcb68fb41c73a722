// Writes PNG: 8- or 16-bit RGB, filtered row by row, packed by deflate.h.
#include "base/for_each.h"
#include "base/in_order.h"
#include "base/raw_vector.h"
#include "image/byte_lanes.h"
#include "image/checksum.h"
#include "image/deflate.h"
#include "image/formats.h"
#include "image/png.h"

#include <algorithm>
#include <cstring>
#include <optional>
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

// The rows of a picture as codes: where they lie, or encoded here, each behind the one above it.
class RowCodes {
public:
    explicit RowCodes(const PixelSource& picture)
        : picture_(picture), pixelBytes_(picture.pixelBytes()),
          width_(static_cast<std::size_t>(picture.width)),
          height_(static_cast<std::size_t>(picture.height)) {}

    // There until the next but one is asked for. Rows follow each other, from any one on.
    Bytes at(std::size_t y) {
        const std::size_t size = pixelBytes_ * width_;
        if (!picture_.codes.empty()) return picture_.codes.subspan(y * size, size);
        Buffer &row = encoded_[y % 2], &above = encoded_[(y + 1) % 2];
        row.resize(size);
        if (above.empty())
            encodePixels(pixelsOf(y), picture_.encoding, row);
        else
            encodeBelow(y, above, row);
        return row;
    }

private:
    // Row y > 0, `above` with the codes of the one before. Where its pixels are the same, as in a
    // plain background, so are the codes, and comparing is faster than encoding.
    void encodeBelow(std::size_t y, Bytes above, std::span<std::uint8_t> row) const {
        constexpr std::size_t kRun = 32;
        const std::span<const Rgb> here = pixelsOf(y), up = pixelsOf(y - 1);
        for (std::size_t x = 0; x < width_; x += kRun) {
            const std::size_t count = std::min(kRun, width_ - x), at = pixelBytes_ * x;
            const std::span<std::uint8_t> out = row.subspan(at, pixelBytes_ * count);
            if (y + 1 < height_) fetch(pixelsOf(y + 1).subspan(x, count));
            if (std::memcmp(here.data() + x, up.data() + x, count * sizeof(Rgb)) == 0)
                std::memcpy(out.data(), above.data() + at, out.size());
            else
                encodePixels(here.subspan(x, count), picture_.encoding, out);
        }
    }
    // Pixels of the row that comes next: the processor does not guess across pages.
    static void fetch(std::span<const Rgb> pixels) {
        const auto bytes = std::as_bytes(pixels);
        for (std::size_t at = 0; at < bytes.size(); at += 64) __builtin_prefetch(&bytes[at]);
    }
    std::span<const Rgb> pixelsOf(std::size_t y) const {
        return picture_.pixels.subspan(y * width_, width_);
    }

    const PixelSource& picture_;
    std::size_t pixelBytes_, width_, height_;
    Buffer encoded_[2]; // by turns
};

// The picture in parts, which threads can work on: as many rows each as give kPartBytes, so that
// the file does not depend on how many threads there are. The rows of a part fit into a cache.
class PartEncoder {
public:
    explicit PartEncoder(const PixelSource& picture)
        : picture_(picture), pixelBytes_(picture.pixelBytes()),
          height_(static_cast<std::size_t>(picture.height)),
          rowBytes_(pixelBytes_ * static_cast<std::size_t>(picture.width) + 1),
          rows_(std::max<std::size_t>(1, kPartBytes / rowBytes_)) {}

    std::size_t count() const { return (height_ + rows_ - 1) / rows_; }

    // The chunk is made in `memory`, of any content.
    Part part(std::size_t i, Buffer memory) const {
        const std::size_t first = i * rows_, end = std::min(height_, first + rows_);
        thread_local RawVector<std::uint8_t> filtered; // the system need not clear it every time
        filterRows(first, end, filtered);
        const bool isLast = end == height_;
        memory.clear();
        const std::size_t start = beginChunk(memory, "IDAT");
        if (i == 0) memory.insert(memory.end(), kZlibHeader.begin(), kZlibHeader.end());
        const Packing packing =
            picture_.encoding.isDraft ? Packing::ZeroWords : choosePacking(filtered);
        Buffer chunk = deflatePiece(filtered, isLast, packing, std::move(memory));
        endChunk(chunk, start);
        return {std::move(chunk), {filtered.size(), adler32(filtered)}};
    }

private:
    static constexpr std::size_t kPartBytes = std::size_t{1} << 17;

    // Rows of a draft that are filtered alike: to find the best filter takes more time than to use
    // it.
    static constexpr std::size_t kRowsPerFilter = 4;

    // With their filter types in front.
    void filterRows(std::size_t first, std::size_t end, RawVector<std::uint8_t>& out) const {
        RowCodes rows(picture_);
        const Buffer zeros(first == 0 ? rowBytes_ - 1 : 0);
        Bytes above = first == 0 ? Bytes(zeros) : rows.at(first - 1);
        out.resize(rowBytes_ * (end - first));
        const ByteLanes& lanes = byteLanes();
        std::span<std::uint8_t> left = out;
        std::optional<PngFilter> filter; // none: to be found
        for (std::size_t y = first; y < end; ++y, left = left.subspan(rowBytes_)) {
            const Bytes row = rows.at(y);
            if (!picture_.encoding.isDraft || (y - first) % kRowsPerFilter == 0) filter.reset();
            filter = lanes.filterRow(row, above, pixelBytes_, filter, left.subspan(1));
            left[0] = static_cast<std::uint8_t>(*filter);
            above = row;
        }
    }

    const PixelSource& picture_;
    std::size_t pixelBytes_, height_, rowBytes_, rows_;
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
