// Damaged OpenEXR files never hurt: they decode to a picture that is whole, or throw Error.
#include "base/error.h"
#include "check.h"
#include "unit/exr_kit.h"
#include "unit/flipped_bytes.h"

#include <cstdio>
#include <random>

namespace test_exr_damage {

namespace {

using exr_kit::Buffer;
using flipped_bytes::Outcomes;

bool isWhole(const StoredImage& image) {
    return image.depth == StoredImage::Depth::Float && flipped_bytes::isSound(image);
}

void decode(const Buffer& file, const std::string& name, std::size_t injury, Outcomes& outcomes) {
    try {
        CHECK_INFO(isWhole(decodeExr(file, name)), name << ", " << injury);
        ++outcomes.read;
    } catch (const Error& error) {
        const std::string message = error.what();
        CHECK_INFO(error.kind() == ErrorKind::Input && message.starts_with(name + ": error: "),
                   message);
        CHECK_INFO(std::all_of(message.begin(), message.end(),
                               [](char c) { return c >= ' ' && c <= '~'; }),
                   name << ", " << injury);
        ++outcomes.refused;
    } catch (const std::exception& error) {
        CHECK_INFO(false, name << ", " << injury << " threw " << error.what());
    }
}

} // namespace

// A file that is cut off lacks a block, unless what is missing are small levels or other parts.
TEST(exr_cut_off_anywhere) {
    const std::vector<std::string> names = exr_kit::names();
    CHECK(names.size() >= 40);
    for (const std::string& name : names) {
        const Buffer file = exr_kit::fileOf(name);
        const bool hasMore = name.starts_with("levels_") || name.starts_with("parts_");
        Outcomes outcomes;
        for (std::size_t size = 0; size < file.size();
             size = flipped_bytes::nextLength(size, file.size()))
            decode(Buffer(file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size)), name,
                   size, outcomes);
        CHECK_INFO(hasMore || outcomes.read == 0, name << ": " << outcomes.read << " read");
    }
}

TEST(exr_random_damage) {
    const std::vector<std::string> names = exr_kit::names();
    Outcomes outcomes;
    for (const std::string& name : names) {
        const Buffer file = exr_kit::fileOf(name);
        for (std::uint32_t seed = 0; seed < check::scaled(40u); ++seed) {
            std::mt19937 random(seed);
            Buffer damaged = file;
            for (auto damages = 1 + random() % 3; damages > 0; --damages) {
                // Every other time in the header, or in the blocks, which are at the end.
                const std::size_t at = random() % (random() % 2 ? file.size() : file.size() / 4);
                const std::size_t place = random() % 2 ? at : file.size() - 1 - at;
                const auto bit = static_cast<std::uint8_t>(1u << random() % 8);
                const auto byte = static_cast<std::uint8_t>(random());
                damaged[place] = random() % 2 ? damaged[place] ^ bit : byte;
            }
            decode(damaged, name, seed, outcomes);
        }
    }
    std::printf("%d pictures read, %d refused\n", outcomes.read, outcomes.refused);
    // Both must happen, or the test tests nothing.
    CHECK(outcomes.read > 100 && outcomes.refused > 500);
}

} // namespace test_exr_damage
