// A property of a block of a scene: its keyword, where it is stored, what it may be. The tables of
// them are in properties.h.
#pragma once

#include "desc/enum_tables.h"
#include "desc/range.h"
#include "desc/scene_desc.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

enum class Target { Texture, Material, Mesh }; // what a reference names
template <>
inline constexpr auto kEnumNames<Target> = std::to_array<EnumName<Target>>(
    {{Target::Texture, "texture"}, {Target::Material, "material"}, {Target::Mesh, "mesh"}});
static_assert(isInOrder<Target>());

template <class Block> struct Reference {
    Handle Block::*handle;
    Target target;
};
// The same list under two keywords: one name for all, or a name per material slot.
template <class Block> struct MaterialList {
    OneOrMore<Handle> Block::*handles;
    bool many;
};
// An enum whose type is forgotten; values are positions in `names`.
template <class Block> struct Choice {
    std::size_t (*get)(const Block&);
    void (*set)(Block&, std::size_t);
    std::span<const std::string_view> names;
};

template <class Block, class E> Block blockOf(E Block::*);
template <class Block, class E> E memberOf(E Block::*);

template <auto member> constexpr auto choice() {
    using Block = decltype(blockOf(member));
    using E = decltype(memberOf(member));
    return Choice<Block>{[](const Block& block) { return static_cast<std::size_t>(block.*member); },
                         [](Block& block, std::size_t i) { block.*member = static_cast<E>(i); },
                         kNamesByValue<E>};
}

using Corners4 = std::array<Vec3d, 4>;
using SeldomCorners = decltype(ObjectDesc::corners);
using Crop = std::optional<std::array<int, 4>>;
template <class Block>
using Field = std::variant<double Block::*, Vec2d Block::*, Vec3d Block::*, Rgbd Block::*,
                           SeldomCorners Block::*, int Block::*, std::uint32_t Block::*,
                           Crop Block::*, bool Block::*, std::string Block::*, Reference<Block>,
                           MaterialList<Block>, Choice<Block>>;

using KindMask = std::uint32_t;
inline constexpr KindMask kAllKinds = ~KindMask{0};
template <class... Kinds> constexpr KindMask only(Kinds... kinds) {
    return (... | (KindMask{1} << static_cast<unsigned>(kinds)));
}

template <class Block> struct Property {
    std::string_view keyword;
    Field<Block> first;
    std::optional<Field<Block>> second; // on the same line
    Range range;                        // of all its numbers
    KindMask kinds = kAllKinds; // objects: where the keyword exists; lights: where it has an effect
};
