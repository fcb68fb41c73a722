#include "desc/write_txt.h"

#include "desc/lobes.h"
#include "desc/names.h"
#include "desc/properties.h"

#include <algorithm>
#include <charconv>
#include <span>

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
    void open(const AnyBlock& block) {
        out_ += '\n';
        out_ += block.word;
        if (block.name) name(*block.name);
        out_ += " {\n";
    }

    template <class Block> void block(const Block& block) {
        open(block);
        if constexpr (requires { block.worldFromCamera; }) keys(block.worldFromCamera);
        if constexpr (requires { block.worldFromObject; }) keys(block.worldFromObject);
        if constexpr (requires { block.worldFromLight; }) keys(std::span(&block.worldFromLight, 1));
        properties(block);
        if constexpr (requires { block.lobes; })
            for (const LobeDesc& lobe : block.lobes) this->lobe(lobe);
        out_ += "}\n";
    }

    template <class Block> void properties(const Block& block) {
        static const Block kDefaults{};
        properties(block, kDefaults);
    }
    // Where there are lobes, nothing is diffuse unless it is said.
    void properties(const MaterialDesc& material) {
        static const MaterialDesc kDefaults{};
        static const MaterialDesc kDefaultsBesideLobes = [] {
            MaterialDesc out;
            out.diffuse = {};
            return out;
        }();
        properties(material, material.lobes.empty() ? kDefaults : kDefaultsBesideLobes);
    }
    void properties(const AnyBlock& block, const AnyBlock& defaults) {
        const KindMask kinds = block.type == BlockType::Object ? block.kind : kAllKinds;
        for (const Property& property : propertiesOf(block.type))
            if ((property.kinds & kinds) && !isSame(property, block.data, defaults.data))
                this->property(property, block.data);
    }
    void property(const Property& property, const void* block) {
        const Field& field = property.first;
        const bool many = field.kind == FieldKind::Materials;
        if (many || field.kind == FieldKind::Material)
            if (many != (at<OneOrMore<Handle>>(field, block).size() > 1)) return;
        out_ += "    ";
        out_ += property.keyword;
        if (property.hasWord()) words(field, block);
        std::array<double, kMostNumbers> numbers;
        for (std::size_t i = 0, count = getNumbers(property, block, numbers.data()); i < count; ++i)
            property.isWhole() ? number(static_cast<long long>(numbers[i])) : number(numbers[i]);
        out_ += '\n';
    }

    void words(const Field& field, const void* block) {
        switch (field.kind) {
        case FieldKind::Flag: out_ += at<bool>(field, block) ? " true" : " false"; break;
        case FieldKind::Text: name(at<std::string>(field, block)); break;
        case FieldKind::Name: name(nameOfTarget(field.target, at<Handle>(field, block))); break;
        case FieldKind::Choice:
            out_ += ' ';
            out_ += field.names[at<std::uint8_t>(field, block)];
            break;
        default:
            for (const Handle handle : at<OneOrMore<Handle>>(field, block))
                name(nameOfTarget(BlockType::Material, handle));
        }
    }

    void lobe(const LobeDesc& lobe) {
        const LobeForm& form = lobeForms()[lobe.kind];
        out_ += "    ";
        out_ += kLobeWord;
        word(form.name);
        const double weight[] = {lobe.weight.r, lobe.weight.g, lobe.weight.b};
        value(lobe, LobeDesc::Factor::kWeight, kWeightWord, weight, lobe.weight == Rgbd{1, 1, 1});
        for (std::size_t i = 0; i < form.fields.size(); ++i) {
            const auto& [name, first, count, range] = form.fields[i];
            const auto numbers = std::span(lobe.numbers).subspan(first, count);
            const auto usual = std::span(form.usual.numbers).subspan(first, count);
            value(lobe, static_cast<std::int8_t>(i), name, numbers,
                  std::equal(numbers.begin(), numbers.end(), usual.begin()));
        }
        if (lobe.covers) word(kCoversWord);
        out_ += '\n';
    }
    // A weight or field with what multiplies it, unless it is as it would be without.
    void value(const LobeDesc& lobe, std::int8_t field, std::string_view keyword,
               std::span<const double> numbers, bool isUsual) {
        const auto isOfField = [&](const auto& factor) { return factor.field == field; };
        const auto& factors = lobe.factors;
        if (isUsual && std::none_of(factors.begin(), factors.end(), isOfField)) return;
        word(keyword);
        for (const double x : numbers) number(x);
        for (const LobeDesc::Factor& factor : factors) {
            if (!isOfField(factor)) continue;
            word(factor.without ? kWithoutWord : kTimesWord);
            name(nameOfTarget(BlockType::Texture, factor.texture));
            if (factor.strength != 1) number(factor.strength);
        }
    }
    void word(std::string_view text) {
        out_ += ' ';
        out_ += text;
    }

    const std::string& nameOfTarget(BlockType target, Handle handle) const {
        const auto i = static_cast<std::size_t>(handle);
        return target == BlockType::Texture    ? desc_.textures[i].name
               : target == BlockType::Material ? desc_.materials[i].name
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
        forEachArray(mesh, [&](std::string_view keyword, const auto& groups, std::string_view) {
            if (groups.empty()) return;
            out_ += "    ";
            out_ += keyword;
            number(groups.size());
            out_ += '\n';
            for (const auto& g : groups) {
                out_ += "     ";
                group(g);
                out_ += '\n';
            }
        });
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
