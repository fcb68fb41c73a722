// What the headers of an OpenEXR file say (OpenEXR File Layout, "Header"), and which channels of it
// make the picture.
// Private to image/.
#pragma once

#include "image/formats.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

constexpr std::uint32_t kExrMagic = 20000630;
constexpr std::uint32_t kExrVersion = 2;
// Bits of the version field, above the number of the version.
enum ExrFlag : std::uint32_t {
    kExrTiled = 0x200,
    kExrLongNames = 0x400, // of more than 31 bytes
    kExrDeep = 0x800,
    kExrMultiPart = 0x1000
};
inline constexpr std::size_t kExrShortName = 31, kExrLongName = 255;

enum ExrPixelType : std::uint32_t { kExrUint = 0, kExrHalf = 1, kExrFloat = 2 };

// The compressions that are read; others have larger numbers.
enum ExrCompression : unsigned { kExrNone, kExrRle, kExrZips, kExrZip, kExrPiz };
inline constexpr std::size_t kExrZipLines = 16; // in a block

struct ExrChannel {
    std::string name;
    std::uint32_t type = kExrHalf;
    bool isSubsampled = false;

    std::size_t bytes() const { return type == kExrHalf ? 2 : 4; }
};

// A rectangle of pixels with both corners inside it; y grows downwards.
struct ExrWindow {
    std::int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

// The size of a tile, which those at the right and lower border need not reach.
struct ExrTileSize {
    std::uint32_t width = 0, height = 0;
};

struct ExrPart {
    std::vector<ExrChannel> channels; // in the order of their values in a row
    std::optional<unsigned> compression;
    std::optional<ExrWindow> dataWindow;
    std::optional<ExrTileSize> tiles;
    std::optional<std::uint32_t> chunkCount;
    bool isTiled = false, isDeep = false;
};

struct ExrHeaders {
    std::vector<ExrPart> parts;
    bool isMultiPart = false;
    std::size_t end = 0; // in the file: the tables of offsets follow
};

// Reads the version field and all headers; attributes that the picture does not depend on are
// skipped. Fails with "name: error: what".
ExrHeaders readExrHeaders(Bytes file, const std::string& name);

// The part that has the picture, and which of its channels: R, G, B or Y, and perhaps A.
struct ExrColour {
    std::size_t part = 0;
    std::vector<std::size_t> channels;
};
// Chooses as decodeExr() says. Fails with "name: error: what" when no part has a colour, or one
// that is not read.
ExrColour chooseExrColour(const ExrHeaders& headers, const std::string& name);
