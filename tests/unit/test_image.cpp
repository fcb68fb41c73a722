// Code/image/image.h: pictures and their files.
#include "check.h"

#include "base/error.h"
#include "base/file_text.h"
#include "base/text.h"
#include "image/image.h"
#include "temporary_folder.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

namespace test_image {

namespace {

namespace fs = std::filesystem;

Image gradient(int width, int height) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.setPixel(x, y, {static_cast<float>(x) / 20, static_cast<float>(y) / 20, 0.5f});
    return image;
}

ErrorKind kindOf(const std::function<void()>& body) {
    try {
        body();
    } catch (const Error& error) {
        return error.kind();
    }
    return {};
}

} // namespace

TEST(image_sizes_are_checked) {
    CHECK_THROWS(Image(0, 1), "the size 0x1 is not possible; both sides must be 1 to 65535");
    CHECK_THROWS(Image(1, -1), "the size 1x-1 is not possible");
    CHECK_THROWS(Image(65536, 1), "the size 65536x1 is not possible");
    CHECK_THROWS(Image(65535, 65535), "the size 65535x65535 is too large");
    CHECK_EQUAL(Image(65535, 1).width(), 65535);
}

TEST(image_pixels_are_rows_from_the_top) {
    Image image(3, 2);
    image.setPixel(2, 1, {1, 2, 3});
    CHECK((image.pixels()[5] == Rgb{1, 2, 3}));
    CHECK((image.pixel(2, 1) == Rgb{1, 2, 3}));
    CHECK(isBlack(image.pixel(1, 1)));
}

TEST(image_writes_by_extension_and_reads_by_content) {
    const TemporaryFolder folder("write");
    const Image image = gradient(20, 11);
    image.write(folder / "a.pfm");
    CHECK(Image(folder / "a.pfm") == image);
    image.write(folder / "a.PNG", {Encoding::Transfer::Srgb, 16});
    image.write(folder / "a.ppm", {Encoding::Transfer::Srgb, 16});
    CHECK(Image(folder / "a.PNG") == Image(folder / "a.ppm"));
    fs::rename(folder / "a.PNG", folder / "misnamed.ppm");
    CHECK_EQUAL(Image(folder / "misnamed.ppm").height(), 11);
    image.write(folder / "a.ppm"); // replaces
    CHECK(readStoredImage(folder / "a.ppm").depth == StoredImage::Depth::Bits8);
    CHECK_EQUAL(folder.files(), 3); // no temporary files are left
}

TEST(image_write_fails_with_reason) {
    const TemporaryFolder folder("fail");
    const Image image(1, 1);
    CHECK_THROWS(image.write(folder / "a.pngg"),
                 "a.pngg: error: unknown picture extension 'pngg'; did you mean 'png'? known: ppm");
    CHECK_THROWS(image.write(folder / "a"), "unknown picture extension ''");
    CHECK_THROWS(image.write(folder / "none/a.png"), "none' must exist");
    CHECK_THROWS(image.write(folder / "a.png", {Encoding::Transfer::Srgb, 12}), "12 bits");
    fs::create_directory(folder / "b.png");
    CHECK_THROWS(image.write(folder / "b.png"), "cannot write: Is a directory");
    CHECK(kindOf([&] { image.write(folder / "none/a.png"); }) == ErrorKind::Output);
    CHECK(kindOf([&] { image.write(folder / "a.jpg"); }) == ErrorKind::Output);
    CHECK_EQUAL(folder.files(), 1);
    if (fs::exists("/dev/full")) {
        fs::create_symlink("/dev/full", folder / "full.ppm");
        CHECK_THROWS(image.write(folder / "full.ppm"), "cannot write: No space left on device");
    }
}

TEST(file_reads_whole_files) {
    const TemporaryFolder folder("read");
    CHECK_THROWS(readWholeFile(folder / "none"), "none: error: cannot read: No such file");
    CHECK_THROWS(readWholeFile("/"), "it is a folder");
    CHECK_THROWS(readWholeFile("/dev/zero"), "it is a device");
    CHECK(kindOf([&] { readWholeFile(folder / "none"); }) == ErrorKind::Input);
    for (const std::size_t size : {0u, 1u, 65535u, 65536u, 65537u, 300000u}) {
        const std::vector<std::uint8_t> bytes(size, 42);
        writeFileAtomically(folder / "f", bytes);
        CHECK(readWholeFile(folder / "f") == bytes);
    }
}

// In parts of half a megabyte, of which the last one may be short.
TEST(file_reads_text_with_many_threads) {
    const TemporaryFolder folder("threads");
    for (const std::size_t size : {70000u, 1u << 19, 1u << 20, 3500001u}) {
        std::vector<std::uint8_t> bytes(size);
        for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * i >> 7);
        writeFileAtomically(folder / "f", bytes);
        const FileText text = readWholeText(folder / "f");
        CHECK(std::equal(text.begin(), text.end(), bytes.begin(), bytes.end(),
                         [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; }));
        for (const int threads : {2, 7}) {
            const FileText again = readWholeText(folder / "f", threads);
            CHECK(std::string_view(again) == std::string_view(text) && *again.end() == 0);
        }
    }
}

// Pieces are gathered up to 2^18 bytes.
TEST(file_is_written_in_pieces_of_any_size) {
    const TemporaryFolder folder("pieces");
    constexpr std::size_t kGathered = 1 << 18;
    for (const std::size_t size : {std::size_t{100000}, kGathered - 1, kGathered, kGathered + 1,
                                   std::size_t{3} * kGathered + 5}) {
        std::vector<std::uint8_t> bytes(size);
        for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::uint8_t>(i * i >> 9);
        for (const std::size_t piece : {size / 4, size, size - 1, std::size_t{70001}}) {
            writeFileAtomically(folder / "f", [&](ByteSink write) {
                for (std::size_t at = 0; at < size; at += piece)
                    write(std::span(bytes).subspan(at, std::min(piece, size - at)));
            });
            CHECK_INFO(readWholeFile(folder / "f") == bytes, size << " bytes by " << piece);
        }
    }
    CHECK_EQUAL(folder.files(), 1);
}

TEST(file_write_keeps_links_and_old_content) {
    const TemporaryFolder folder("links");
    const std::vector<std::uint8_t> first{1}, second{2, 2};
    writeFileAtomically(folder / "real", first);
    fs::create_symlink("real", folder / "link");
    writeFileAtomically(folder / "link", second);
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(readWholeFile(folder / "real") == second);
    writeFileAtomically("/dev/null", first);
    CHECK(fs::is_character_file("/dev/null"));
    CHECK(pendingTemporaryFile() == nullptr);
    CHECK_EQUAL(folder.files(), 2);
}

// What an interrupt has to remove.
TEST(file_pending_name_is_known_while_writing) {
    const TemporaryFolder folder("pending");
    const std::vector<std::uint8_t> bytes(16 << 20);
    std::atomic<bool> done = false;
    std::string seen;
    std::thread watcher([&] {
        while (!done && seen.empty())
            if (const char* name = pendingTemporaryFile()) seen = name;
    });
    for (int i = 0; i < 20; ++i) writeFileAtomically(folder / "large", bytes);
    done = true;
    watcher.join();
    CHECK_INFO(seen.starts_with(folder / "large."), seen);
    CHECK_INFO(seen.ends_with(".tmp"), seen);
    CHECK(pendingTemporaryFile() == nullptr);
}

} // namespace test_image
