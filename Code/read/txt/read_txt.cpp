#include "read/txt/read_txt.h"

#include "base/text.h"
#include "desc/error_list.h"
#include "desc/name_table.h"
#include "desc/names.h"
#include "desc/properties.h"
#include "read/txt/property_line.h"
#include "read/txt/read_mesh.h"
#include "read/txt/scanner.h"
#include "read/txt/transform_lines.h"

#include <algorithm>
#include <array>
#include <utility>

namespace {

constexpr int kVersion = 1;

template <class Block>
constexpr bool kHasPlace = std::is_same_v<Block, CameraDesc> || std::is_same_v<Block, LightDesc> ||
                           std::is_same_v<Block, ObjectDesc>;

void place(CameraDesc& camera, Keys keys) { camera.worldFromCamera = std::move(keys); }
void place(LightDesc& light, Keys keys) { light.worldFromLight = keys.front(); }
void place(ObjectDesc& object, Keys keys) { object.worldFromObject = std::move(keys); }

// The words that open blocks, in the order of the README.
std::vector<std::string> blockWords() {
    std::vector<std::string> words = {"settings", "world", "camera", "texture",
                                      "material", "light", "mesh"};
    for (const auto& row : kEnumNames<ObjectDesc::Kind>) words.emplace_back(row.name);
    return words;
}

class TxtReader {
public:
    explicit TxtReader(const SourceFile& source) : in_(source), errors_(source) {}

    SceneDesc read() {
        try {
            readFirstLine();
            readBlocks();
            resolveNames();
        } catch (const Error& error) {
            errors_.addComplete(error.what());
        }
        errors_.throwIfAny();
        return std::move(desc_);
    }

private:
    void readFirstLine() {
        const std::string_view text = in_.source().text;
        if (text.empty())
            in_.failAt(0, "the file is empty; expected 'raytracer 1' as its first line");
        constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf"; // some editors on Windows
        if (text.starts_with(kByteOrderMark)) in_.moveTo(kByteOrderMark.size());
        const std::size_t start = in_.offset();
        if (!text.substr(start).starts_with("raytracer"))
            in_.failAt(start, "expected 'raytracer 1' as the first line of a native scene file");
        const Token word = in_.next(), version = in_.next();
        const auto number = parseInteger(version.text);
        if (word.text != "raytracer" || !number || *number < 1)
            in_.failAt(start, "expected 'raytracer 1' as the first line of a native scene file");
        if (*number > kVersion)
            in_.failAt(version.offset, cat("the file has version ", *number,
                                           " of the format; this program reads version ", kVersion,
                                           ", a newer one is needed"));
        expectLineEnd(in_, "raytracer 1", word);
    }

    void readBlocks() {
        while (true) {
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
        if (word.text == "settings") return readSingle(desc_.settings, word);
        if (word.text == "world") return readSingle(desc_.world, word);
        if (word.text == "camera") return readProperties(added(desc_.cameras), word);
        if (word.text == "texture") return readProperties(added(desc_.textures), word);
        if (word.text == "material") return readProperties(added(desc_.materials), word);
        if (word.text == "light") return readProperties(added(desc_.lights), word);
        if (word.text == "mesh") {
            MeshDesc& mesh = added(desc_.meshes);
            readHeading(mesh, word);
            return readMesh(in_, errors_, word, mesh);
        }
        if (const auto kind = valueNamed<ObjectDesc::Kind>(word.text)) {
            ObjectDesc& object = added(desc_.objects);
            object.kind = *kind;
            return readProperties(object, word);
        }
        in_.failAt(word.offset, cat("unknown block ", unknownName(shown(word.text), blockWords())));
    }

    // One block more. Doubling touches memory twice, which for many blocks costs as much as reading
    // them; the part of the text that the blocks so far took says how many there will be.
    template <class Block> Block& added(std::vector<Block>& blocks) const {
        constexpr std::size_t kMany = 1000, kMostGrowth = 16;
        if (blocks.size() == blocks.capacity() && blocks.size() >= kMany) {
            const double part = static_cast<double>(in_.offset()) /
                                static_cast<double>(in_.offset() + in_.bytesLeft());
            const double growth = std::clamp(1.05 / part, 1.5, double{kMostGrowth});
            blocks.reserve(static_cast<std::size_t>(static_cast<double>(blocks.size()) * growth));
        }
        return blocks.emplace_back();
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

    template <class Block> void readProperties(Block& block, const Token& word) {
        readHeading(block, word);
        constexpr std::span<const Property<Block>> rows = propertiesOf<Block>();
        std::array<std::size_t, rows.size()> given;
        given.fill(kNotGiven);
        PropertyLine<Block> line(in_, errors_, names_, word);
        Keys keys{kIdentityRows};
        while (true) {
            const Token t = in_.next();
            if (t.kind == TokenKind::LineEnd) continue;
            if (t.kind == TokenKind::Close) break;
            if (t.kind == TokenKind::FileEnd || t.kind == TokenKind::Open)
                failUnclosed(in_, word, t);
            if (t.kind != TokenKind::Word)
                in_.failAt(t.offset, cat("expected a property or '}', got ", described(t)));
            if constexpr (kHasPlace<Block>)
                if (readTransformLine(t, word, keys)) continue;
            const auto row = std::find_if(rows.begin(), rows.end(), [&](const Property<Block>& p) {
                return isSameWord(p.keyword, t.text) && isHere(p, block);
            });
            if (row == rows.end()) failUnknown(block, t, word);
            std::size_t& before = given[static_cast<std::size_t>(row - rows.begin())];
            if (before != kNotGiven)
                in_.failAt(t.offset,
                           cat("'", t.text, "' was given already at line ", in_.lineOf(before)));
            before = t.offset;
            line.read(block, *row);
        }
        if constexpr (kHasPlace<Block>) place(block, std::move(keys));
        expectLineEnd(in_, "}", word);
    }

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
        if (isSameWord(t.text, "key")) {
            if (word.text == "light")
                in_.failAt(t.offset, "lights stand still; 'key' is for cameras and objects");
            keys.push_back(kIdentityRows);
            expectLineEnd(in_, t.text, word);
            return true;
        }
        for (const TransformLine& line : transformLines()) {
            if (!isSameWord(line.keyword, t.text)) continue;
            std::array<double, 12> numbers{};
            const std::size_t faultsBefore = errors_.count();
            NumberLine reader(in_, errors_, line.keyword, line.count);
            for (std::size_t i = 0; i < line.count; ++i)
                reader.read(numbers[i], line.keyword == "rotate" && i == 0 ? kTurn : kAnyNumber);
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

    // References hold positions in names_ up to here.
    void resolveNames() {
        const auto tableOf = [](const auto& blocks) {
            // Of equal names the first counts; validate() complains about the others.
            NameTable table(blocks.size());
            for (std::size_t i = 0; i < blocks.size(); ++i)
                table.insert(blocks[i].name, static_cast<std::uint32_t>(i));
            return table;
        };
        const std::array<NameTable, kEnumNames<Target>.size()> tables{
            tableOf(desc_.textures), tableOf(desc_.materials), tableOf(desc_.meshes)};
        static_assert(kEnumNames<Target>[0].value == Target::Texture &&
                      kEnumNames<Target>[1].value == Target::Material &&
                      kEnumNames<Target>[2].value == Target::Mesh);
        forEachBlock(desc_, [&](auto& block) {
            forEachReference(block, [&](Handle& handle, Target target, std::string_view) {
                if (handle == kNone) return;
                const Token t = names_[static_cast<std::size_t>(handle)];
                const std::string quoted = t.kind == TokenKind::Word ? "" : in_.nameIn(t);
                const std::string_view name = t.kind == TokenKind::Word ? t.text : quoted;
                const auto found = tables[static_cast<std::size_t>(target)].find(name);
                handle = found ? static_cast<Handle>(*found) : kNone;
                if (!found)
                    errors_.add({static_cast<std::uint32_t>(t.offset)},
                                [&] { return unknownReference(target, name); });
            });
        });
    }

    std::string unknownReference(Target target, std::string_view name) const {
        // The nearest name is looked for among so many and so short ones that it cannot take long.
        constexpr std::size_t kCandidates = 1000, kLength = 100;
        std::vector<std::string> known;
        const auto collect = [&](const auto& blocks) {
            for (const auto& block : blocks)
                if (known.size() < kCandidates && block.name.size() <= kLength)
                    known.push_back(block.name);
        };
        if (target == Target::Texture)
            collect(desc_.textures);
        else if (target == Target::Material)
            collect(desc_.materials);
        else
            collect(desc_.meshes);
        return cat("unknown ", nameOf(target), " ", unknownName(shown(name), known));
    }

    static constexpr std::size_t kNotGiven = static_cast<std::size_t>(-1);
    Scanner in_;
    ErrorList errors_;
    std::vector<Token> names_;
    SceneDesc desc_;
};

} // namespace

SceneDesc readTxt(const SourceFile& source) {
    // Locations are 32 bits wide.
    if (source.text.size() >= SourceLoc::kUnknown)
        fail(ErrorKind::Input, cat(source.name, ": error: the file is larger than 4 GiB"));
    return TxtReader(source).read();
}
