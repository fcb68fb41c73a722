// The header of a PLY file: what its data are and how they are laid out. Knows no meshes.
#pragma once

#include "base/enum_names.h"
#include "base/source.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

enum class PlyFormat { Ascii, LittleEndian, BigEndian };
constexpr auto wordsOf(PlyFormat) {
    return words("ascii", "binary_little_endian", "binary_big_endian");
}

enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

constexpr std::size_t sizeOf(PlyType type) {
    constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}
constexpr bool isWhole(PlyType type) { return type < PlyType::Float32; }

struct PlyProperty {
    std::string_view name; // in the text of the file
    std::size_t offset = 0;
    PlyType type = PlyType::Float32;  // of a list: its items
    std::optional<PlyType> countType; // lists only
};

struct PlyElement {
    std::string_view name;
    std::size_t offset = 0; // of its line
    std::uint32_t count = 0;
    std::vector<PlyProperty> properties;

    const PlyProperty* property(std::string_view wanted) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::Ascii;
    std::vector<PlyElement> elements;
    std::vector<std::string_view> pictures; // the last words of comments 'TextureFile NAME'
    std::size_t dataOffset = 0;             // the byte behind the line end_header

    const PlyElement* element(std::string_view wanted) const;
};

PlyHeader readPlyHeader(const SourceFile& source);

// What the properties of a vertex of a PLY file are to us.
enum class PlyRole { X, Y, Z, NormalX, NormalY, NormalZ, U, V, None };
inline constexpr std::size_t kPlyRoleCount = static_cast<std::size_t>(PlyRole::None);

struct VertexRoles {
    std::vector<PlyRole> roles; // per property
    std::array<bool, kPlyRoleCount> has{};
    bool hasRole(PlyRole role) const { return has[static_cast<std::size_t>(role)]; }
};
// Of several names for the same the first ones known.
VertexRoles rolesOf(const PlyElement& vertex);

// Some rows of an element of a PLY file, where they are taken to be.
struct RowChunk {
    const char* first = nullptr;
    std::size_t firstRow = 0, count = 0;
};
