// Unpacks the blocks of OpenEXR pixels that are stored as they are or packed by RLE or ZIP.
#include "image/exr_blocks.h"

#include "base/text.h"
#include "image/zlib.h"

#include <algorithm>
#include <utility>

namespace {

// Undoes RLE. A signed byte n from 0 says that the next byte comes n + 1 times, a negative one that
// -n bytes follow as they are.
std::vector<std::uint8_t> expandExrRuns(Bytes packed, std::size_t size, const std::string& name) {
    const auto broken = [&](std::string_view what) {
        failPicture(name, cat("broken RLE data: ", what, "; the file is damaged"));
    };
    std::vector<std::uint8_t> out;
    out.reserve(size);
    while (!packed.empty()) {
        const std::size_t code = packed[0];
        const bool isPlain = code >= 128;
        const std::size_t count = isPlain ? 256 - code : code + 1;
        const std::size_t taken = isPlain ? count : 1;
        packed = packed.subspan(1);
        if (taken > packed.size()) broken("it ends in the middle of a run");
        if (count > size - out.size()) broken(cat("it unpacks to more than ", size, " bytes"));
        if (isPlain)
            out.insert(out.end(), packed.begin(),
                       packed.begin() + static_cast<std::ptrdiff_t>(count));
        else
            out.insert(out.end(), count, packed[0]);
        packed = packed.subspan(taken);
    }
    if (out.size() != size) broken(cat("it unpacks to ", out.size(), " bytes instead of ", size));
    return out;
}

} // namespace

std::size_t exrRowsOf(ExrCompression compression) {
    switch (compression) {
    case kExrZip: return kExrZipLines;
    case kExrPiz: return 32;
    default: return 1;
    }
}

void splitExrBytes(Bytes bytes, std::span<std::uint8_t> out) {
    const std::size_t half = (bytes.size() + 1) / 2;
    for (std::size_t i = 0; i < bytes.size(); ++i) out[i % 2 * half + i / 2] = bytes[i];
    for (std::size_t i = out.size(); i > 1; --i)
        out[i - 1] = static_cast<std::uint8_t>(out[i - 1] - out[i - 2] + 128);
}

void joinExrBytes(std::span<std::uint8_t> split, std::span<std::uint8_t> out) {
    for (std::size_t i = 1; i < split.size(); ++i)
        split[i] = static_cast<std::uint8_t>(split[i - 1] + split[i] - 128);
    const std::size_t half = (split.size() + 1) / 2;
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = split[i % 2 * half + i / 2];
}

std::vector<std::uint8_t> unpackExrBlock(ExrCompression compression, const ExrBlock& block,
                                         Bytes packed, const std::string& name) {
    const std::size_t size = block.bytes();
    if (packed.size() > size)
        failPicture(name, cat("a block has ", packed.size(), " bytes; its pixels need ", size));
    if (packed.size() == size) return {packed.begin(), packed.end()};
    if (compression == kExrPiz) return unpackExrPiz(block, packed, name);
    std::vector<std::uint8_t> split = compression == kExrRle ? expandExrRuns(packed, size, name)
                                                             : inflateZlib(packed, size, name);
    std::vector<std::uint8_t> out(size);
    joinExrBytes(split, out);
    return out;
}
