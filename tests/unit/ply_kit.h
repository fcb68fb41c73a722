// What the tests of the PLY reader share: writing a file in any of its formats, and reading one.
#pragma once

#include "base/text.h"
#include "check.h"
#include "read/mesh/mesh_file.h"
#include "read/mesh/ply_header.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ply_kit {

inline constexpr std::array kFormats{PlyFormat::Ascii, PlyFormat::LittleEndian, PlyFormat::BigEndian};

// Writes the data of a file in any format: the test's own idea of what the bytes are.
class Body {
public:
    explicit Body(PlyFormat format) : format_(format) {}

    // type: a name of the header
    Body& put(std::string_view type, double value) {
        if (format_ == PlyFormat::Ascii) {
            data_ += value == static_cast<double>(static_cast<float>(value))
                         ? cat(shortest(static_cast<float>(value)), " ")
                         : cat(shortest(value), " ");
            return *this;
        }
        std::array<char, 8> bytes{};
        std::size_t size = 0;
        const auto keep = [&](auto number) {
            std::memcpy(bytes.data(), &number, size = sizeof number);
        };
        if (type == "char") keep(static_cast<std::int8_t>(value));
        if (type == "uchar") keep(static_cast<std::uint8_t>(value));
        if (type == "short") keep(static_cast<std::int16_t>(value));
        if (type == "ushort") keep(static_cast<std::uint16_t>(value));
        if (type == "int") keep(static_cast<std::int32_t>(value));
        if (type == "uint") keep(static_cast<std::uint32_t>(value));
        if (type == "float") keep(static_cast<float>(value));
        if (type == "double") keep(value);
        CHECK_INFO(size > 0, type);
        const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(size);
        if ((std::endian::native == std::endian::big) != (format_ == PlyFormat::BigEndian))
            std::reverse(bytes.begin(), end);
        data_.append(bytes.begin(), end);
        return *this;
    }
    Body& row(std::string_view type, std::initializer_list<double> values) {
        for (const double value : values) put(type, value);
        return end();
    }
    // A list and the end of its row.
    Body& list(std::string_view countType, std::string_view type,
               std::initializer_list<double> values) {
        put(countType, static_cast<double>(values.size()));
        return row(type, values);
    }
    Body& end() {
        if (format_ == PlyFormat::Ascii) data_.back() = '\n';
        return *this;
    }
    const std::string& text() const { return data_; }

private:
    PlyFormat format_;
    std::string data_;
};

inline std::string header(PlyFormat format, const std::string& lines) {
    return cat("ply\nformat ", nameOf(format), " 1.0\n", lines, "end_header\n");
}
inline const std::string kXyz = "property float x\nproperty float y\nproperty float z\n";
inline const std::string kFaces = "property list uchar int vertex_indices\n";

struct Reading {
    MeshDesc mesh;
    std::vector<std::string> warnings;
};
inline Reading readWhole(const std::string& text) {
    Diagnostics diagnostics;
    MeshFile file = readPly({"t.ply", text}, {{}, diagnostics});
    CHECK(file.parts.empty() && file.materials.empty() && file.libraries.empty());
    return {std::move(file.mesh), std::move(diagnostics.warnings)};
}
// There are no warnings but of what the picture does not show.
inline MeshDesc readQuietly(const std::string& text) {
    Reading read = readWhole(text);
    std::erase_if(read.warnings, [](const std::string& warning) {
        return warning.find(": warning: left out: '") != std::string::npos;
    });
    CHECK_INFO(read.warnings.empty(), join(read.warnings));
    return std::move(read.mesh);
}
inline std::string replacedAll(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}
// The same file in each format; write(body) puts the data.
template <class Write> MeshDesc readAll(const std::string& lines, const Write& write) {
    std::vector<MeshDesc> meshes;
    for (const PlyFormat format : kFormats) {
        Body body(format);
        write(body);
        meshes.push_back(readQuietly(header(format, lines) + body.text()));
        CHECK_INFO(meshes.back() == meshes.front(), nameOf(format));
    }
    return meshes.front();
}
inline std::string failureOf(const std::string& text) {
    return check::thrown([&] { readWhole(text); });
}
inline constexpr std::array kFiles{"tests/scenes/ply/house_ascii.ply",
                                   "tests/scenes/ply/house_little.ply",
                                   "tests/scenes/ply/house_big.ply"};

} // namespace ply_kit
