// Damage to files that are not text, for the tests of the readers of pictures: a file cut off at
// every length, and with some bytes changed.
#pragma once

#include "base/error.h"
#include "check.h"
#include "image/formats.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

namespace flipped_bytes {

// The names of all files of a folder that end so, in order.
inline std::vector<std::string> filesIn(const std::string& folder, const std::string& extension) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == extension) names.push_back(entry.path().string());
    std::sort(names.begin(), names.end());
    return names;
}

// Tells whether the size of a picture fits its samples, and all of these are finite.
inline bool isSound(const StoredImage& image) {
    if (image.width < 1 || image.width > Image::kMaxSide || image.height < 1 ||
        image.height > Image::kMaxSide || image.channels < 1 || image.channels > 4)
        return false;
    const std::size_t count = static_cast<std::size_t>(image.width) *
                              static_cast<std::size_t>(image.height) *
                              static_cast<std::size_t>(image.channels);
    using Depth = StoredImage::Depth;
    return image.bytes.size() == (image.depth == Depth::Bits8 ? count : 0) &&
           image.words.size() == (image.depth == Depth::Bits16 ? count : 0) &&
           image.floats.size() == (image.depth == Depth::Float ? count : 0) &&
           std::all_of(image.floats.begin(), image.floats.end(),
                       [](float value) { return std::isfinite(value); });
}

// Returns the next length to cut a file off at: every one within the header and at the end, every
// seventh between, where pixels are alike.
inline std::size_t nextLength(std::size_t size, std::size_t whole) {
    return size + (size < 400 || size + 20 > whole ? 1 : 7);
}

// How many damaged files were read after all, and how many were refused with an Error.
struct Outcomes {
    int read = 0, refused = 0;
};

// The file must give a sound picture, or one Error of its input that names it.
template <class Decode>
void tryOne(Bytes file, const Decode& decode, const std::string& info, Outcomes& outcomes) {
    try {
        CHECK_INFO(isSound(decode(file, "damaged")), info);
        ++outcomes.read;
    } catch (const Error& error) {
        CHECK_INFO(error.kind() == ErrorKind::Input &&
                       std::string(error.what()).starts_with("damaged:"),
                   info << ": " << error.what());
        ++outcomes.refused;
    }
}

// Decodes the file cut off at every length.
template <class Decode>
void cutOff(const std::vector<std::uint8_t>& whole, const Decode& decode, const std::string& name,
            Outcomes& outcomes) {
    for (std::size_t length = 0; length < whole.size(); ++length) {
        // A copy of its own: what is read behind its end is seen by the sanitizers.
        const std::vector<std::uint8_t> part(whole.begin(),
                                             whole.begin() + static_cast<std::ptrdiff_t>(length));
        tryOne(part, decode, name + " cut off at " + std::to_string(length), outcomes);
    }
}

// Decodes the file `cases` times with one to four bytes changed, every other time near its start.
template <class Decode>
void change(const std::vector<std::uint8_t>& whole, const Decode& decode, const std::string& name,
            std::uint32_t cases, Outcomes& outcomes) {
    constexpr std::size_t kStart = 90;
    for (std::uint32_t seed = 0; seed < cases; ++seed) {
        std::mt19937 random(seed);
        std::vector<std::uint8_t> bytes = whole;
        const std::size_t places = random() % 2 ? bytes.size() : std::min(bytes.size(), kStart);
        for (auto changes = 1 + random() % 4; changes > 0; --changes) {
            std::uint8_t& byte = bytes[random() % places];
            byte = static_cast<std::uint8_t>(random() % 2 ? random() : byte ^ 1u << random() % 8);
        }
        tryOne(bytes, decode, name + " with seed " + std::to_string(seed), outcomes);
    }
}

} // namespace flipped_bytes
