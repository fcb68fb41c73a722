// PLY files that threads read in chunks of rows are what one thread reads, in every bit and every
// message: also where rows are not where they were taken to be.
#include "base/text.h"
#include "check.h"
#include "read/mesh/mesh_file.h"

#include <bit>
#include <string>

namespace test_ply_chunks {

namespace {

constexpr int kThreads[] = {2, 5};
constexpr std::uint32_t kVertices = 30'000, kFaces = 40'000; // some chunks in each format

struct Outcome {
    MeshDesc mesh;
    std::string said;
    bool operator==(const Outcome&) const = default;
};
Outcome readWith(int threads, const std::string& text) {
    Outcome out;
    Diagnostics diagnostics;
    ReadOptions options;
    options.threads = threads;
    out.said = check::thrown([&] {
        out.mesh = readPly({"t.ply", text}, {options, diagnostics}).mesh;
    });
    for (const std::string& warning : diagnostics.warnings) out.said += warning + "\n";
    return out;
}
Outcome checkSame(const std::string& text, const std::string& what) {
    Outcome one = readWith(1, text);
    for (const int threads : kThreads)
        CHECK_INFO(readWith(threads, text) == one,
                   what << ", " << threads << " threads: " << readWith(threads, text).said
                        << " instead of " << one.said);
    return one;
}

enum class Format { Ascii, Little, Big };
struct File {
    Format format;
    std::string lineEnd = "\n";
    std::string text;

    void put(std::uint32_t value, int bytes) {
        for (int i = 0; i < bytes; ++i)
            text += static_cast<char>(value >> 8 * (format == Format::Big ? bytes - 1 - i : i));
    }
    void number(float value) {
        if (format == Format::Ascii)
            text += shortest(value) + " ";
        else
            put(std::bit_cast<std::uint32_t>(value), 4);
    }
    void whole(std::uint32_t value, int bytes) {
        if (format == Format::Ascii)
            text += std::to_string(value) + " ";
        else
            put(value, bytes);
    }
    void endRow() {
        if (format == Format::Ascii) text += lineEnd;
    }
};

enum class Faces { Triangles, OneQuad, Mixed };
// `flat`: every so many faces one has two equal corners.
File file(Format format, Faces faces, std::uint32_t flat = 0, const std::string& lineEnd = "\n") {
    File f{format, lineEnd, {}};
    const char* const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    f.text = cat("ply", lineEnd, "format ", names[static_cast<int>(format)], " 1.0", lineEnd,
                 "element vertex ", kVertices, lineEnd, "property float x", lineEnd,
                 "property float y", lineEnd, "property float z", lineEnd, "element face ", kFaces,
                 lineEnd, "property list uchar uint vertex_indices", lineEnd, "property uchar red",
                 lineEnd, "end_header", lineEnd);
    for (std::uint32_t i = 0; i < kVertices; ++i) {
        for (const std::uint32_t factor : {7u, 11u, 13u})
            f.number(static_cast<float>(i * factor % 1000) * 0.37f);
        f.endRow();
    }
    for (std::uint32_t i = 0; i < kFaces; ++i) {
        const bool isQuad = faces == Faces::Mixed ? i % 3 == 1 : faces == Faces::OneQuad && i == 99;
        const bool isFlat = flat > 0 && i % flat == flat - 1;
        f.whole(isQuad ? 4 : 3, 1);
        for (std::uint32_t k = 0; k < (isQuad ? 4u : 3u); ++k)
            f.whole((i * 3 + (isFlat ? 0 : k * k)) % kVertices, 4);
        f.whole(200, 1);
        f.endRow();
    }
    return f;
}

// Faces with texture coordinates of their corners; every so many have none.
std::string fileWithCoordinates(Format format, std::uint32_t without) {
    File f = file(format, Faces::Triangles);
    const std::size_t data = f.text.find("end_header\n") + 11;
    const std::string flags = "property uchar red\n";
    f.text.replace(f.text.find(flags), flags.size(), "property list uchar float texcoord\n");
    const std::size_t shift =
        std::string("property list uchar float texcoord\n").size() - flags.size();
    File rows{format, "\n", {}};
    for (std::uint32_t i = 0; i < kFaces; ++i) {
        rows.whole(3, 1);
        for (std::uint32_t k = 0; k < 3; ++k) rows.whole((i + k) % kVertices, 4);
        const std::uint32_t count = i % without == without - 1 ? 0 : 6;
        rows.whole(count, 1);
        for (std::uint32_t k = 0; k < count; ++k)
            rows.number(static_cast<float>((i + k) % 100) * 0.01f);
        rows.endRow();
    }
    // The vertices stay, in front of the old faces.
    const std::size_t old = file(format, Faces::Triangles).text.size() - data;
    File faces{format, "\n", {}};
    for (std::uint32_t i = 0; i < kFaces; ++i) {
        faces.whole(3, 1);
        for (std::uint32_t k = 0; k < 3; ++k) faces.whole((i * 3 + k * k) % kVertices, 4);
        faces.whole(200, 1);
        faces.endRow();
    }
    return f.text.substr(0, data + shift + old - faces.text.size()) + rows.text;
}

} // namespace

TEST(ply_chunks_have_the_same_texture_coordinates) {
    for (const Format format : {Format::Ascii, Format::Little, Format::Big})
        for (const std::uint32_t without : {7u, kFaces + 1}) {
            const Outcome one = checkSame(fileWithCoordinates(format, without), "coordinates");
            CHECK_INFO(one.mesh.uvTriangles.size() == kFaces, one.said);
            CHECK_EQUAL(one.mesh.uvs.size(), std::size_t{3} * kFaces);
            CHECK((one.mesh.uvs.at(one.mesh.uvTriangles.at(3)[0]) == Vec2{0.03f, 0.04f}));
        }
}

TEST(ply_chunks_give_the_same_mesh) {
    for (const Format format : {Format::Ascii, Format::Little, Format::Big})
        for (const Faces faces : {Faces::Triangles, Faces::OneQuad, Faces::Mixed}) {
            const std::string what = cat(static_cast<int>(format), " ", static_cast<int>(faces));
            const Outcome one = checkSame(file(format, faces).text, what);
            CHECK_INFO(one.mesh.triangles.size() >= kFaces, what << one.said);
        }
}

TEST(ply_chunks_count_the_same_flat_faces) {
    for (const Format format : {Format::Ascii, Format::Little}) {
        const Outcome one = checkSame(file(format, Faces::Triangles, 12'345).text, "flat faces");
        CHECK_INFO(one.said.find("left out 3 of 40000 faces") != std::string::npos &&
                       one.said.find("the first is face 12344") != std::string::npos,
                   one.said);
    }
}

// Empty lines move the rows behind them; a line in two is not a row.
TEST(ply_chunks_of_other_lines) {
    checkSame(file(Format::Ascii, Faces::Triangles, 0, "\r\n").text, "line ends of Windows");
    const std::string text = file(Format::Ascii, Faces::Triangles).text;
    const std::size_t header = text.find("end_header\n") + 11;
    for (const std::string line : {"\n", "  \n", "\n\n\n", "1 2\n", "x 0 0\n", "#\n"})
        for (const std::size_t part : {0u, 1u, 30u, 60u, 99u}) {
            const std::size_t near = header + (text.size() - header) / 100 * part;
            std::string changed = text;
            changed.insert(part == 0 ? header : text.find('\n', near) + 1, line);
            const Outcome one = checkSame(changed, cat("'", line, "' at part ", part));
            const bool isEmpty = line.find_first_not_of(" \n") == std::string::npos;
            CHECK_INFO((one.said.find(" error: ") == std::string::npos) == isEmpty, one.said);
        }
}

TEST(ply_chunks_find_the_same_mistake) {
    for (const Format format : {Format::Ascii, Format::Little, Format::Big}) {
        const std::string text = file(format, Faces::Triangles).text;
        const std::size_t header = text.find("end_header\n") + 11;
        for (std::size_t part = 0; part < 20; ++part) {
            std::string damaged = text;
            const std::size_t at = header + (text.size() - header) / 20 * part;
            for (std::size_t i = at; i < at + 4; ++i) damaged[i] = static_cast<char>(0xff);
            checkSame(damaged, cat("damage at ", at));
            checkSame(text.substr(0, at), cat("cut off at ", at));
        }
        // Two mistakes: the first one counts, in whichever chunk it is.
        std::string damaged = text;
        for (const std::size_t at : {text.size() / 2, text.size() - 90'000, text.size() - 50})
            for (std::size_t i = at; i < at + 10; ++i) damaged[i] = static_cast<char>(0xff);
        CHECK(!checkSame(damaged, "three mistakes").said.empty());
        checkSame(text + "0 0", "more behind it");
    }
}

} // namespace test_ply_chunks
