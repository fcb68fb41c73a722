#include "read/txt/read_blocks.h"

#include "base/text.h"
#include "desc/names.h"
#include "desc/properties.h"
#include "read/added_by_text.h"
#include "read/txt/property_line.h"
#include "read/txt/read_mesh.h"
#include "read/txt/scanner.h"
#include "read/txt/transform_lines.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

namespace {

template <class Block>
constexpr bool kHasPlace = std::is_same_v<Block, CameraDesc> || std::is_same_v<Block, LightDesc> ||
                           std::is_same_v<Block, ObjectDesc>;

// The words that open blocks, in the order of the README.
std::vector<std::string> blockWords() {
    std::vector<std::string> words = {"settings", "world", "camera", "texture",
                                      "material", "light", "mesh"};
    for (const auto& row : kEnumNames<ObjectDesc::Kind>) words.emplace_back(row.name);
    return words;
}

class BlockReader {
public:
    BlockReader(const SourceFile& source, const TxtPart& part, ErrorList& errors, Blocks& blocks)
        : in_(source), part_(part), errors_(errors), blocks_(blocks) {
        in_.moveTo(part.first);
    }

    // Returns where the reading ended.
    std::size_t read() {
        readBlocks();
        return in_.offset();
    }

private:
    void readBlocks() {
        while (in_.offset() < part_.last) {
            const Token t = in_.next();
            if (t.kind == TokenKind::FileEnd) return;
            if (t.kind == TokenKind::LineEnd) continue;
            if (t.kind == TokenKind::Close)
                in_.failAt(t.offset, "there is no open block to close with '}'");
            if (t.kind != TokenKind::Word)
                in_.failAt(t.offset,
                           cat("expected a block such as 'sphere NAME {', got ", described(t)));
            readBlock(t);
        }
    }

    void readBlock(const Token& word) {
        const auto is = [&](std::string_view kind) { return isSameWord(kind, word.text); };
        for (const auto& row : kEnumNames<ObjectDesc::Kind>) {
            if (!is(row.name)) continue;
            ObjectDesc& object = added(blocks_.desc.objects);
            object.kind = row.value;
            return readProperties(object, word);
        }
        if (is("material")) return readProperties(added(blocks_.desc.materials), word);
        if (is("light")) return readProperties(added(blocks_.desc.lights), word);
        if (is("mesh")) {
            MeshDesc& mesh = added(blocks_.desc.meshes);
            readHeading(mesh, word);
            return readMesh(in_, errors_, word, mesh, part_.threads);
        }
        if (is("camera")) return readProperties(added(blocks_.desc.cameras), word);
        if (is("texture")) return readProperties(added(blocks_.desc.textures), word);
        if (is("settings")) return readSingle(blocks_.desc.settings, word);
        if (is("world")) return readSingle(blocks_.desc.world, word);
        in_.failAt(word.offset, cat("unknown block ", unknownName(shown(word.text), blockWords())));
    }

    template <class Block> Block& added(std::vector<Block>& blocks) const {
        return addedByText(blocks, in_.offset(), part_.last);
    }

    template <class Block> void readSingle(Block& block, const Token& word) {
        if (block.loc.offset != SourceLoc::kUnknown)
            in_.failAt(word.offset, cat("'", word.text, "' was given already at line ",
                                        in_.lineOf(block.loc.offset)));
        readProperties(block, word);
    }

    // kind name {
    template <class Block> void readHeading(Block& block, const Token& word) {
        block.loc = {static_cast<std::uint32_t>(word.offset)};
        Token t = in_.next();
        if constexpr (requires { block.name; }) {
            if (t.kind != TokenKind::Word && t.kind != TokenKind::Quoted)
                in_.failAt(t.offset,
                           cat("expected a name after '", word.text, "', got ", described(t)));
            block.name = in_.nameIn(t);
            if (block.name.empty()) in_.failAt(t.offset, "a name has at least one letter");
            define(block, t);
            t = in_.next();
            if (t.kind != TokenKind::Open)
                in_.failAt(t.offset, cat("expected '{' after the name of the ", word.text, ", got ",
                                         described(t)));
        } else if (t.kind != TokenKind::Open) {
            in_.failAt(t.offset, cat("expected '{' after '", word.text,
                                     "', which has no name, got ", described(t)));
        }
        t = in_.peek();
        if (t.kind != TokenKind::LineEnd && t.kind != TokenKind::FileEnd)
            in_.failAt(t.offset, cat("expected a new line after '{', got ", described(t)));
    }

    void define(const MaterialDesc&, const Token& name) {
        blocks_.references.define(Target::Material, name, blocks_.desc.materials.size() - 1);
    }
    void define(const TextureDesc&, const Token& name) {
        blocks_.references.define(Target::Texture, name, blocks_.desc.textures.size() - 1);
    }
    void define(const MeshDesc&, const Token& name) {
        blocks_.references.define(Target::Mesh, name, blocks_.desc.meshes.size() - 1);
    }
    template <class Block> void define(const Block&, const Token&) {}

    template <class Block> void readProperties(Block& block, const Token& word) {
        readHeading(block, word);
        constexpr std::span<const Property<Block>> rows = propertiesOf<Block>();
        std::array<std::size_t, rows.size()> given;
        given.fill(kNotGiven);
        PropertyLine<Block> line(in_, errors_, blocks_.references, word);
        Habits<Block>& habits = std::get<Habits<Block>>(habits_);
        std::size_t* next = &habits.first;
        while (true) {
            const Token t = in_.next();
            if (t.kind == TokenKind::LineEnd) continue;
            if (t.kind == TokenKind::Close) break;
            if (t.kind == TokenKind::FileEnd || t.kind == TokenKind::Open)
                failUnclosed(in_, word, t);
            if (t.kind != TokenKind::Word)
                in_.failAt(t.offset, cat("expected a property or '}', got ", described(t)));
            if constexpr (kHasPlace<Block>)
                if (readTransformLine(t, word, keysOf(block))) continue;
            const auto isMeant = [&](const Property<Block>& p) {
                return isSameWord(p.keyword, t.text) && isHere(p, block);
            };
            if (!isMeant(rows[*next])) {
                const auto row = std::find_if(rows.begin(), rows.end(), isMeant);
                if (row == rows.end()) failUnknown(block, t, word);
                *next = static_cast<std::size_t>(row - rows.begin());
            }
            const std::size_t number = *next;
            next = &habits.after[number];
            std::size_t& before = given[number];
            if (before != kNotGiven)
                in_.failAt(t.offset,
                           cat("'", t.text, "' was given already at line ", in_.lineOf(before)));
            before = t.offset;
            line.read(block, rows[number], habits.before[number]);
        }
        if constexpr (std::is_same_v<Block, LightDesc>)
            block.worldFromLight = std::exchange(lightKeys_.front(), kIdentityRows);
        expectLineEnd(in_, "}", word);
    }

    // The rows of the properties that came first, and behind each other, the last time: blocks of a
    // file have theirs in the same order. And what they said.
    template <class Block> struct Habits {
        std::size_t first = 0;
        std::array<std::size_t, propertiesOf<Block>().size()> after{};
        std::array<LineBefore, propertiesOf<Block>().size()> before{};
    };

    // Where the keys of a block are read to. Lights stand still and have no keys of their own.
    Keys& keysOf(CameraDesc& camera) { return camera.worldFromCamera; }
    Keys& keysOf(ObjectDesc& object) { return object.worldFromObject; }
    Keys& keysOf(LightDesc&) { return lightKeys_; }

    // Objects have the properties of their kind. Lights and cameras say their kind in a property,
    // perhaps after others: they have all of them, and validate() warns of those without effect.
    template <class Block> static bool isHere(const Property<Block>& property, const Block& block) {
        if constexpr (std::is_same_v<Block, ObjectDesc>)
            return (property.kinds & kindOf(block)) != 0;
        else
            return true;
    }

    template <class Block>
    [[noreturn]] void failUnknown(const Block& block, const Token& t, const Token& word) {
        std::vector<std::string> known;
        for (const Property<Block>& property : propertiesOf<Block>())
            if (isHere(property, block)) known.emplace_back(property.keyword);
        if constexpr (kHasPlace<Block>)
            for (const TransformLine& line : transformLines()) known.emplace_back(line.keyword);
        failUnknownProperty(in_, t, word, known);
    }

    bool readTransformLine(const Token& t, const Token& word, Keys& keys) {
        if (!mayPlace(t.text.front())) return false;
        if (isSameWord(t.text, "key")) {
            if (word.text == "light")
                in_.failAt(t.offset, "lights stand still; 'key' is for cameras and objects");
            keys.push_back(kIdentityRows);
            expectLineEnd(in_, t.text, word);
            return true;
        }
        for (const TransformLine& line : transformLines()) {
            if (!isSameWord(line.keyword, t.text)) continue;
            std::array<double, 12> numbers;
            const std::size_t faultsBefore = errors_.count();
            NumberLine reader(in_, errors_, line.keyword, line.count);
            for (std::size_t i = 0; i < line.count; ++i)
                reader.read(numbers[i], i == 0 && line.startsWithTurn ? kTurn : kAnyNumber);
            reader.finish(word);
            if (errors_.count() > faultsBefore) return true;
            std::string_view fault;
            keys.back() = line.apply(keys.back(), std::span(numbers).first(line.count), fault);
            if (!fault.empty())
                errors_.add({static_cast<std::uint32_t>(t.offset)},
                            [&] { return std::string(fault); });
            return true;
        }
        return false;
    }

    static constexpr std::size_t kNotGiven = static_cast<std::size_t>(-1);
    Scanner in_;
    const TxtPart& part_;
    ErrorList& errors_;
    Blocks& blocks_;
    Keys lightKeys_{kIdentityRows};
    std::tuple<Habits<SettingsDesc>, Habits<WorldDesc>, Habits<CameraDesc>, Habits<TextureDesc>,
               Habits<MaterialDesc>, Habits<LightDesc>, Habits<ObjectDesc>>
        habits_;
};

} // namespace

std::size_t readBlocks(const SourceFile& source, const TxtPart& part, ErrorList& errors,
                       Blocks& blocks) {
    return BlockReader(source, part, errors, blocks).read();
}
