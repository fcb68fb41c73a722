// Damaged pictures never hurt (promise P6): a file with random damage decodes to a picture that is
// whole, or throws Error.
#include "base/error.h"
#include "base/file_text.h"
#include "check.h"
#include "image/image.h"
#include "image/zlib.h"
#include "unit/flipped_bytes.h"

#include <algorithm>
#include <filesystem>
#include <random>

namespace test_image_damage {

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

struct File {
    std::string name;
    Bytes bytes;
    bool isPng = false;
};

Bytes bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

// Small valid files of every format.
std::vector<File> wholeFiles() {
    std::vector<File> files;
    files.push_back({"P2", bytesOf("P2\n# grey\n3 2\n15\n0 1 2 3\n14 15\n")});
    files.push_back(
        {"P3", bytesOf("P3\n2 2 # wide, high\n255\n1 2 3  40 50 60\n255 0 7  8 9 10\n")});
    files.push_back({"P5", bytesOf("P5 3 2 255\nabcdef")});
    files.push_back({"P6 16 bit", bytesOf("P6\n2 1\n65535\nabcdefghijkl")});
    files.push_back({"Pf", bytesOf("Pf\n2 1\n1.0\n?@@@@@@@")});
    Image image(5, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 5; ++x)
            image.setPixel(x, y, {static_cast<float>(x) / 5, static_cast<float>(y) / 4, 0.5f});
    for (const char* extension : {"ppm", "pfm", "png"})
        files.push_back(
            {extension, encodeImage(image, extension, {}), extension == std::string("png")});
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator("tests/scenes/png"))
        if (entry.path().extension() == ".png") names.push_back(entry.path().string());
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) files.push_back({name, readWholeFile(name), true});
    return files;
}

struct Chunk { // length, type, data, CRC
    std::size_t at = 0, size = 0;
};

// As far as they can be followed.
std::vector<Chunk> chunksOf(const Bytes& png) {
    std::vector<Chunk> chunks;
    for (std::size_t at = 8; at + 12 <= png.size();) {
        const std::size_t length = std::size_t{png[at]} << 24 | std::size_t{png[at + 1]} << 16 |
                                   std::size_t{png[at + 2]} << 8 | png[at + 3];
        if (length > png.size() - at - 12) break;
        chunks.push_back({at, length + 12});
        at += length + 12;
    }
    return chunks;
}

// So that damage gets past the checksums.
void repairChecksums(Bytes& png) {
    for (const Chunk& chunk : chunksOf(png)) {
        const std::size_t end = chunk.at + chunk.size - 4;
        const std::uint32_t crc = crc32(std::span(png).subspan(chunk.at + 4, chunk.size - 8));
        for (std::size_t i = 0; i < 4; ++i)
            png[end + i] = static_cast<std::uint8_t>(crc >> (24 - 8 * i));
    }
}

void damage(File& file, std::mt19937& random) {
    Bytes& bytes = file.bytes;
    const auto below = [&](std::size_t count) { return count > 0 ? random() % count : 0; };
    const auto place = [&](std::size_t at) {
        return bytes.begin() + static_cast<std::ptrdiff_t>(std::min(at, bytes.size()));
    };
    const auto insert = [&](std::size_t at, const Bytes& piece) {
        bytes.insert(place(at), piece.begin(), piece.end());
    };
    const std::vector<Chunk> chunks = file.isPng ? chunksOf(bytes) : std::vector<Chunk>{};
    // Often near the start, where the header is.
    const std::size_t at =
        below(random() % 2 ? bytes.size() : std::min(bytes.size(), std::size_t{40}));
    const std::size_t length = 1 + below(20);
    switch (below(chunks.empty() ? 6 : 8)) {
    case 0:
    case 1:
        if (!bytes.empty()) bytes[at] = static_cast<std::uint8_t>(bytes[at] ^ (1u << below(8)));
        break;
    case 2:
        if (!bytes.empty()) bytes[at] = static_cast<std::uint8_t>(random());
        break;
    case 3: bytes.erase(place(at), place(at + length)); break;
    case 4: bytes.resize(at); break;
    case 5:
        if (below(2) == 0)
            insert(at, Bytes(place(at), place(at + length)));
        else
            insert(at, Bytes(length, static_cast<std::uint8_t>(random())));
        break;
    default: { // a chunk again, or one less
        const Chunk chunk = chunks[below(chunks.size())], before = chunks[below(chunks.size())];
        const Bytes piece(place(chunk.at), place(chunk.at + chunk.size));
        if (below(4) == 0)
            bytes.erase(place(chunk.at), place(chunk.at + chunk.size));
        else
            insert(before.at, piece);
        break;
    }
    }
}

} // namespace

TEST(image_random_damage) {
    const std::vector<File> files = wholeFiles();
    CHECK(files.size() >= 60);
    for (const File& file : files)
        CHECK_INFO(flipped_bytes::isSound(decodeImage(file.bytes, file.name)), file.name);
    int read = 0, refused = 0;
    for (std::uint32_t seed = 0; seed < check::scaled(2000u); ++seed) {
        std::mt19937 random(seed);
        // Every other time one of the first 8, as most files are PNGs.
        const std::size_t choices = random() % 2 ? files.size() : 8;
        File file = files[random() % choices];
        for (auto damages = 1 + random() % 3; damages > 0; --damages) damage(file, random);
        if (file.isPng && random() % 4 != 0) repairChecksums(file.bytes);
        try {
            const StoredImage image = decodeImage(file.bytes, file.name);
            CHECK_INFO(flipped_bytes::isSound(image),
                       "seed " << seed << ", " << file.name << ": " << image.width << " x "
                               << image.height << " x " << image.channels);
            ++read;
        } catch (const Error& error) {
            CHECK_INFO(error.kind() == ErrorKind::Input &&
                           std::string(error.what()).find(file.name) != std::string::npos,
                       "seed " << seed << ": " << error.what());
            ++refused;
        } catch (const std::exception& error) {
            CHECK_INFO(false, "seed " << seed << ", " << file.name << " threw " << error.what());
        }
    }
    std::printf("%d pictures read, %d refused, seeds 0 to %u\n", read, refused,
                check::scaled(2000u) - 1);
    // Both must happen, or the test tests nothing.
    CHECK_INFO(read > 100 && refused > 500, "read " << read << ", refused " << refused);
}

} // namespace test_image_damage
