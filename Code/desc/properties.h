// The properties of every kind of block: keyword, where it is stored, what it may be. Reader,
// writer, validation and tests walk the tables in properties.cpp, so a new property is a new row
// there (and its line in ASCII/README.md). Transforms and the arrays of meshes are not properties.
#pragma once

#include "desc/enum_tables.h"
#include "desc/range.h"
#include "desc/scene_desc.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

// How a value is stored and written: one to twelve numbers, or a word.
enum class FieldKind : std::uint8_t {
    None,
    Number,   // double
    Pair,     // Vec2d
    Triple,   // Vec3d
    Color,    // Rgbd
    Corners,  // of a quadrilateral
    Int,      // whole numbers from here on
    Unsigned, // std::uint32_t
    Crop,     // four or nothing
    Flag,     // words from here on: true or false
    Text,     // std::string
    Choice,   // a byte, the position of one of the field's names
    Name,     // Handle of the target
    Material, // OneOrMore<Handle>: one name for all,
    Materials // or one for each material slot
};

// Where a value is in a block whose type is forgotten.
struct Field {
    FieldKind kind = FieldKind::None;
    const void* (*in)(const void* block) = nullptr;
    std::span<const std::string_view> names; // of a choice, by value
    BlockType target{};
};

// T is the type that the field has.
template <class T> const T& at(const Field& field, const void* block) {
    return *static_cast<const T*>(field.in(block));
}
template <class T> T& at(const Field& field, void* block) {
    return const_cast<T&>(at<T>(field, static_cast<const void*>(block)));
}

using KindMask = std::uint32_t;
inline constexpr KindMask kAllKinds = ~KindMask{0};
template <class... Kinds> constexpr KindMask only(Kinds... kinds) {
    return (... | (KindMask{1} << static_cast<unsigned>(kinds)));
}

struct Property {
    std::string_view keyword;
    Field first, second; // the second one is a number on the same line
    Range range;         // of all its numbers
    KindMask kinds = kAllKinds; // objects: where the keyword exists; lights: where it has an effect

    std::size_t numberCount() const { return numbersOf(first.kind) + numbersOf(second.kind); }
    bool hasWord() const { return first.kind >= FieldKind::Flag; }
    bool hasNumbers() const { return !hasWord() || second.kind != FieldKind::None; }
    bool isWhole() const { return first.kind >= FieldKind::Int && first.kind <= FieldKind::Crop; }

    static std::size_t numbersOf(FieldKind kind) {
        constexpr std::uint8_t kNumbers[] = {0, 1, 2, 3, 3, 12, 1, 1, 4, 0, 0, 0, 0, 0, 0};
        return kNumbers[static_cast<std::size_t>(kind)];
    }
};
inline constexpr std::size_t kMostProperties = 24;
std::span<const Property> propertiesOf(BlockType type);
// The first one with this keyword, which there is.
const Property& propertyNamed(BlockType type, std::string_view keyword);

// The numbers of a property as they stand on its line. A crop that is not there has none; else as
// many as numberCount() says are got, and are set.
inline constexpr std::size_t kMostNumbers = 12;
std::size_t getNumbers(const Property& property, const void* block, double* numbers);
void setNumbers(const Property& property, void* block, const double* numbers);

// Does the property have the same value in two blocks of its type?
bool isSame(const Property& property, const void* a, const void* b);

// A block whose type is forgotten.
struct AnyBlock {
    template <class Block>
    AnyBlock(const Block& block)
        : data(&block), type(Block::kType), loc(block.loc), word(nameOf(Block::kType)) {
        if constexpr (requires { block.kind; }) kind = only(block.kind);
        if constexpr (Block::kType == BlockType::Object) word = nameOf(block.kind);
        if constexpr (requires { block.name; }) name = &block.name;
    }
    const void* data;
    BlockType type;
    SourceLoc loc;
    KindMask kind = kAllKinds;         // where all are alike
    std::string_view word;             // "camera", "sphere"
    const std::string* name = nullptr; // where there is one only
};

// Calls with every reference of a block (void* or const void*) and what it names: call(handle,
// BlockType, keyword).
template <class Data, class Call>
void forEachReference(BlockType type, Data* block, const Call& call) {
    for (const Property& property : propertiesOf(type)) {
        if (property.first.kind == FieldKind::Name)
            call(at<Handle>(property.first, block), property.first.target, property.keyword);
        if (property.first.kind == FieldKind::Materials)
            for (auto& handle : at<OneOrMore<Handle>>(property.first, block))
                call(handle, BlockType::Material, property.keyword);
    }
    if (type != BlockType::Material) return;
    using Material = std::conditional_t<std::is_const_v<Data>, const MaterialDesc, MaterialDesc>;
    for (auto& lobe : static_cast<Material*>(block)->lobes)
        for (auto& factor : lobe.factors) call(factor.texture, BlockType::Texture, "lobe");
}

// Calls with every block that has properties.
template <class Scene, class Call> void forEachBlock(Scene& desc, Call&& call) {
    call(desc.settings);
    call(desc.world);
    for (auto& camera : desc.cameras) call(camera);
    for (auto& texture : desc.textures) call(texture);
    for (auto& material : desc.materials) call(material);
    for (auto& light : desc.lights) call(light);
    for (auto& mesh : desc.meshes) call(mesh);
    for (auto& object : desc.objects) call(object);
}

// Calls with every array of numbers that a mesh has: call(keyword, array, keyword of the array that
// its numbers are indices of; empty where they are none).
template <class Mesh, class Call> void forEachArray(Mesh& mesh, Call&& call) {
    call("points", mesh.points, "");
    call("triangles", mesh.triangles, "points");
    call("normals", mesh.normals, "");
    call("normal_triangles", mesh.normalTriangles, "normals");
    call("uvs", mesh.uvs, "");
    call("uv_triangles", mesh.uvTriangles, "uvs");
    call("triangle_materials", mesh.triangleMaterials, "");
}
