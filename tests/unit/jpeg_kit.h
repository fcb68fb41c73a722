// JPEG files for tests: those of tests/scenes/jpeg, their segments, and files of one's own.
#pragma once

#include "base/file_text.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

namespace jpeg_kit {

using File = std::vector<std::uint8_t>;

inline constexpr unsigned kFrame = 0xC0, kProgressiveFrame = 0xC2, kHuffman = 0xC4, kEnd = 0xD9,
                          kScan = 0xDA, kSteps = 0xDB, kInterval = 0xDD, kJfif = 0xE0, kExif = 0xE1,
                          kAdobe = 0xEE;

inline File fixture(const std::string& name) {
    return readWholeFile("tests/scenes/jpeg/" + name + ".jpg");
}
// The names of all fixtures but those that are refused.
inline std::vector<std::string> fixtures() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator("tests/scenes/jpeg")) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() == ".jpg" && name != "cmyk" && name != "arithmetic")
            names.push_back(name);
    }
    std::sort(names.begin(), names.end());
    return names;
}

inline void append(File& file, const File& piece) {
    file.insert(file.end(), piece.begin(), piece.end());
}
inline File bytes(std::initializer_list<unsigned> values) {
    File out;
    for (const unsigned value : values) out.push_back(static_cast<std::uint8_t>(value));
    return out;
}
inline File segment(unsigned marker, const File& data) {
    const auto length = static_cast<unsigned>(data.size()) + 2;
    File out = bytes({0xFF, marker, length >> 8, length & 255});
    append(out, data);
    return out;
}
// The position of the first segment with this marker, up to the first scan; the file's size when
// there is none.
inline std::size_t find(const File& file, unsigned marker) {
    for (std::size_t at = 2; at + 4 <= file.size();) {
        if (file[at + 1] == marker) return at;
        if (file[at + 1] == kScan) break;
        at += 2 + static_cast<std::size_t>(file[at + 2] << 8 | file[at + 3]);
    }
    return file.size();
}
inline File inserted(File file, std::size_t at, const File& piece) {
    file.insert(file.begin() + static_cast<std::ptrdiff_t>(at), piece.begin(), piece.end());
    return file;
}
inline File without(File file, unsigned marker) {
    const std::size_t at = find(file, marker);
    const auto start = file.begin() + static_cast<std::ptrdiff_t>(at);
    file.erase(start, start + 2 + (file[at + 2] << 8 | file[at + 3]));
    return file;
}
// The file with another byte, which is counted from the marker.
inline File changed(File file, unsigned marker, std::size_t byte, unsigned value) {
    file[find(file, marker) + byte] = static_cast<std::uint8_t>(value);
    return file;
}

// The segments before the scans of a grey picture whose quantisation steps are 8. In its Huffman
// tables the code of one zero bit stands for `dc` and for `ac`.
inline File greyStart(unsigned frame, unsigned width, unsigned height, unsigned dc, unsigned ac) {
    File file = bytes({0xFF, 0xD8}), steps = bytes({0});
    steps.resize(65, 8);
    append(file, segment(kSteps, steps));
    append(file, segment(frame, bytes({8, height >> 8, height & 255, width >> 8, width & 255, 1, 1,
                                       0x11, 0})));
    for (const unsigned use : {0u, 1u}) {
        File table = bytes({use << 4, 1});
        table.resize(17);
        table.push_back(static_cast<std::uint8_t>(use == 0 ? dc : ac));
        append(file, segment(kHuffman, table));
    }
    return file;
}
// A scan of the component 1 with its data.
inline File scan(unsigned first, unsigned last, unsigned high, unsigned low, const File& data) {
    File out = segment(kScan, bytes({1, 1, 0, first, last, high << 4 | low}));
    append(out, data);
    return out;
}

} // namespace jpeg_kit
