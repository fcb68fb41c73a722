// Blocks of OpenEXR pixels, and how they are packed. A block has the bytes of some rows (of a whole
// part or of a tile), row after row from the top, in each row one channel after the other. Private
// to image/.
#pragma once

#include "image/exr_header.h"
#include "image/zlib.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

// A rectangle of pixels that is packed on its own.
struct ExrBlock {
    std::size_t columns = 0, rows = 0;
    std::span<const ExrChannel> channels;

    std::size_t rowBytes() const {
        std::size_t pixel = 0;
        for (const ExrChannel& channel : channels) pixel += channel.bytes();
        return columns * pixel;
    }
    std::size_t bytes() const { return rowBytes() * rows; }
};

// Returns how many rows of a part of scan lines make a block.
std::size_t exrRowsOf(ExrCompression compression);

// Returns how many bytes one packed byte can stand for: RLE makes 128 of two bytes, PIZ 510 of nine
// bits.
constexpr std::size_t maxExrInflation(ExrCompression compression) {
    switch (compression) {
    case kExrNone: return 1;
    case kExrRle: return 64;
    case kExrPiz: return 512;
    default: return kMaxInflation;
    }
}

// Returns the block.bytes() bytes that `packed` stands for. As many packed bytes are the block
// itself. The caller checks the size against maxExrInflation() before: memory is taken at once.
// Fails (ErrorKind::Input) with `name` when the packed bytes are damaged.
std::vector<std::uint8_t> unpackExrBlock(ExrCompression compression, const ExrBlock& block,
                                         Bytes packed, const std::string& name);
// Does the same for PIZ, whose packed bytes are fewer than those of the block.
std::vector<std::uint8_t> unpackExrPiz(const ExrBlock& block, Bytes packed,
                                       const std::string& name);
[[noreturn]] void brokenPiz(const std::string& name, std::string_view what);
// Fills `out` with the 16-bit numbers of a Huffman code as PIZ has it. Fails as above.
void unpackExrHuffman(Bytes packed, std::span<std::uint16_t> out, const std::string& name);

// Does to the bytes of a block what ZIP and RLE do before they pack them, so that more of them are
// equal. The bytes at even places come first, then those at odd places; then 128 and the difference
// to the byte before stand for each byte but the first. `out` is as long as `bytes`.
void splitExrBytes(Bytes bytes, std::span<std::uint8_t> out);
// Undoes splitExrBytes(); the split bytes are overwritten.
void joinExrBytes(std::span<std::uint8_t> split, std::span<std::uint8_t> out);
