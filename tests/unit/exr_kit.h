// Files for the tests of OpenEXR: those in tests/scenes/exr, and small ones that are made byte by
// byte, so that any part of them can be wrong.
#pragma once

#include "base/file_text.h"
#include "image/formats.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace exr_kit {

using Buffer = std::vector<std::uint8_t>;

inline std::string pathOf(const std::string& name) { return "tests/scenes/exr/" + name + ".exr"; }
inline Buffer fileOf(const std::string& name) { return readWholeFile(pathOf(name)); }

// The names of all files in tests/scenes/exr.
inline std::vector<std::string> names() {
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator("tests/scenes/exr"))
        if (entry.path().extension() == ".exr") all.push_back(entry.path().stem().string());
    std::sort(all.begin(), all.end());
    return all;
}

// Returns what value() of tests/scenes/exr/make.py wrote there.
inline float valueAt(int x, int y, int c) {
    return static_cast<float>(x * 3 + y * 5 + c * 40 + (x * y % 7 == 0 ? 9 : 0)) / 16;
}

inline void put(Buffer& out, std::uint64_t value, unsigned bytes) {
    for (unsigned i = 0; i < bytes; ++i) out.push_back(static_cast<std::uint8_t>(value >> 8 * i));
}
inline void put(Buffer& out, std::string_view text) {
    out.insert(out.end(), text.begin(), text.end());
    out.push_back(0);
}
inline void put(Buffer& out, const Buffer& bytes) {
    out.insert(out.end(), bytes.begin(), bytes.end());
}

struct Channel {
    std::string name;
    unsigned type = 1, sampling = 1;
};

// A file of one part. The defaults are a grey picture of 2 x 1 pixels, 1 and 2, in one block.
struct File {
    std::uint32_t magic = 20000630, version = 2;
    std::vector<Channel> channels = {{"Y"}};
    unsigned compression = 0;
    std::int32_t x0 = 0, y0 = 0, x1 = 1, y1 = 0;
    Buffer tiles = {};           // the value of the attribute, if there is one
    Buffer place = {0, 0, 0, 0}; // of the block: its row, or the numbers of a tile
    Buffer pixels = {0x00, 0x3C, 0x00, 0x40};
    std::string without = {}; // an attribute that is left out

    Buffer bytes() const {
        Buffer out;
        put(out, magic, 4);
        put(out, version, 4);
        Buffer list;
        for (const Channel& channel : channels) {
            put(list, channel.name);
            put(list, channel.type, 4);
            put(list, 0, 4);
            put(list, channel.sampling, 4);
            put(list, channel.sampling, 4);
        }
        put(list, 0, 1);
        attribute(out, "channels", "chlist", list);
        attribute(out, "compression", "compression", {static_cast<std::uint8_t>(compression)});
        Buffer window;
        for (const std::int32_t side : {x0, y0, x1, y1})
            put(window, static_cast<std::uint32_t>(side), 4);
        attribute(out, "dataWindow", "box2i", window);
        if (!tiles.empty()) attribute(out, "tiles", "tiledesc", tiles);
        put(out, 0, 1);
        put(out, out.size() + 8, 8); // the only offset
        put(out, place);
        put(out, pixels.size(), 4);
        put(out, pixels);
        return out;
    }
    void attribute(Buffer& out, std::string_view name, std::string_view type,
                   const Buffer& value) const {
        if (name == without) return;
        put(out, name);
        put(out, type);
        put(out, value.size(), 4);
        put(out, value);
    }
};

} // namespace exr_kit
