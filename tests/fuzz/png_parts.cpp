#include "fuzz/png_parts.h"

#include "image/zlib.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace fuzz {

namespace {

using Bytes = std::span<const std::uint8_t>;
using Buffer = std::vector<std::uint8_t>;

constexpr std::size_t kSignature = 8;

void append(Buffer& out, Bytes bytes) { out.insert(out.end(), bytes.begin(), bytes.end()); }
void appendWord(Buffer& out, std::size_t word) {
    for (int shift = 24; shift >= 0; shift -= 8)
        out.push_back(static_cast<std::uint8_t>(word >> shift));
}

// typeAndData: the four letters and what follows them. `length` as it is to stand in the file.
void appendChunk(Buffer& out, std::size_t length, Bytes typeAndData) {
    appendWord(out, length);
    append(out, typeAndData);
    appendWord(out, crc32(typeAndData));
}

// The file taken apart and put together again, each chunk as `putChunk(out, typeAndData)` says;
// what is cut off at the end stays as it is.
template <class PutChunk> Buffer rebuilt(Bytes png, PutChunk putChunk) {
    Buffer out;
    out.reserve(png.size());
    std::size_t at = std::min(kSignature, png.size());
    append(out, png.first(at));
    while (at + 12 <= png.size()) {
        const std::size_t length = std::size_t{png[at]} << 24 | std::size_t{png[at + 1]} << 16 |
                                   std::size_t{png[at + 2]} << 8 | png[at + 3];
        if (length > png.size() - at - 12) break;
        putChunk(out, png.subspan(at + 4, 4 + length));
        at += 12 + length;
    }
    append(out, png.subspan(at));
    return out;
}

} // namespace

std::vector<std::uint8_t> withRightChecksums(Bytes png) {
    return rebuilt(png, [](Buffer& out, Bytes typeAndData) {
        appendChunk(out, typeAndData.size() - 4, typeAndData);
    });
}

std::vector<std::uint8_t> withPackedRows(Bytes png) {
    constexpr std::array<std::uint8_t, 4> kRows{'I', 'D', 'A', 'T'};
    return rebuilt(png, [&](Buffer& out, Bytes typeAndData) {
        if (!std::equal(kRows.begin(), kRows.end(), typeAndData.begin()))
            return appendChunk(out, typeAndData.size() - 4, typeAndData);
        Buffer packed(kRows.begin(), kRows.end());
        append(packed, kZlibHeader);
        const Bytes rows = typeAndData.subspan(4);
        packed = deflatePiece(rows, true, choosePacking(rows), std::move(packed));
        append(packed, zlibEnd(adler32(rows)));
        appendChunk(out, packed.size() - 4, packed);
    });
}

} // namespace fuzz
