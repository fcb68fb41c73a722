#include "desc/write_txt.h"

#include "desc/names.h"
#include "desc/properties.h"

#include <charconv>
#include <span>
#include <type_traits>

namespace {

constexpr std::string_view kHeader =
    "raytracer 1\n"
    "# Lengths in metres, angles in degrees, light in linear RGB; right-handed, Z up.\n"
    "# Properties that are left out have their defaults, see ASCII/README.md.\n";

class Writer {
public:
    explicit Writer(const SceneDesc& desc) : desc_(desc) {}

    std::string write() {
        out_ = kHeader;
        if (!(desc_.settings == SettingsDesc{})) block(desc_.settings);
        if (!(desc_.world == WorldDesc{})) block(desc_.world);
        for (const auto& camera : desc_.cameras) block(camera);
        for (const auto& light : desc_.lights) block(light);
        for (const auto& texture : desc_.textures) block(texture);
        for (const auto& material : desc_.materials) block(material);
        for (const auto& mesh : desc_.meshes) arrays(mesh);
        for (const auto& object : desc_.objects) block(object);
        return std::move(out_);
    }

private:
    template <class Block> void open(const Block& block) {
        out_ += '\n';
        out_ += wordOf(block);
        if constexpr (requires { block.name; }) name(block.name);
        out_ += " {\n";
    }

    template <class Block> void block(const Block& block) {
        open(block);
        if constexpr (requires { block.worldFromCamera; }) keys(block.worldFromCamera);
        if constexpr (requires { block.worldFromObject; }) keys(block.worldFromObject);
        if constexpr (requires { block.worldFromLight; }) keys(std::span(&block.worldFromLight, 1));
        properties(block);
        out_ += "}\n";
    }

    template <class Block> void properties(const Block& block) {
        static const Block kDefaults{};
        for (const Property<Block>& property : propertiesOf<Block>()) {
            if constexpr (std::is_same_v<Block, ObjectDesc>)
                if (!(property.kinds & kindOf(block))) continue;
            if (sameField(block, kDefaults, property.first) &&
                (!property.second || sameField(block, kDefaults, *property.second)))
                continue;
            if (const auto* list = std::get_if<MaterialList<Block>>(&property.first))
                if (list->many != ((block.*(list->handles)).size() > 1)) continue;
            out_ += "    ";
            out_ += property.keyword;
            values(block, property.first);
            if (property.second) values(block, *property.second);
            out_ += '\n';
        }
    }

    template <class Block> void values(const Block& block, const Field<Block>& field) {
        forEachNumber(block, field, [&](const auto& value) { number(value); });
        if (const auto* flag = std::get_if<bool Block::*>(&field))
            out_ += block.**flag ? " true" : " false";
        else if (const auto* text = std::get_if<std::string Block::*>(&field))
            name(block.**text);
        else if (const auto* reference = std::get_if<Reference<Block>>(&field))
            name(nameOfTarget(reference->target, block.*(reference->handle)));
        else if (const auto* list = std::get_if<MaterialList<Block>>(&field))
            for (const Handle handle : block.*(list->handles))
                name(nameOfTarget(Target::Material, handle));
        else if (const auto* choice = std::get_if<Choice<Block>>(&field)) {
            out_ += ' ';
            out_ += choice->names[choice->get(block)];
        }
    }

    const std::string& nameOfTarget(Target target, Handle handle) const {
        const auto i = static_cast<std::size_t>(handle);
        return target == Target::Texture    ? desc_.textures[i].name
               : target == Target::Material ? desc_.materials[i].name
                                            : desc_.meshes[i].name;
    }

    void keys(std::span<const Rows> keys) {
        for (const Rows& rows : keys) {
            if (&rows != keys.data()) out_ += "    key\n";
            if (rows == kIdentityRows) continue;
            out_ += "    transform";
            for (std::size_t i = 0; i < rows.size(); ++i) {
                if (i == 4 || i == 8) out_ += ' ';
                number(rows[i]);
            }
            out_ += '\n';
        }
    }

    void arrays(const MeshDesc& mesh) {
        open(mesh);
        properties(mesh);
        for (const MeshArray& array : kMeshArrays)
            std::visit(
                [&](auto member) {
                    const auto& groups = mesh.*member;
                    if (groups.empty()) return;
                    out_ += "    ";
                    out_ += array.keyword;
                    number(groups.size());
                    out_ += '\n';
                    for (const auto& g : groups) {
                        out_ += "     ";
                        group(g);
                        out_ += '\n';
                    }
                },
                array.member);
        out_ += "}\n";
    }
    template <class T> void group(const Vec3T<T>& v) { number(v.x), number(v.y), number(v.z); }
    void group(const Vec2& v) { number(v.x), number(v.y); }
    void group(const MeshDesc::Corners& c) { number(c[0]), number(c[1]), number(c[2]); }
    void group(std::uint32_t n) { number(n); }

    // With a blank before it.
    template <class T> void number(T value) {
        char buffer[40] = {' '};
        out_.append(buffer, std::to_chars(buffer + 1, buffer + sizeof buffer, value).ptr);
    }
    void name(std::string_view text) {
        out_ += ' ';
        if (isBareWord(text)) {
            out_ += text;
            return;
        }
        out_ += '"';
        for (const char c : text) {
            if (c == '"' || c == '\\') out_ += '\\';
            out_ += c;
        }
        out_ += '"';
    }

    const SceneDesc& desc_;
    std::string out_;
};

} // namespace

std::string writeTxt(const SceneDesc& desc) { return Writer(desc).write(); }
