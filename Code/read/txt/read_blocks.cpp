#include "read/txt/read_blocks.h"

#include "base/math.h"
#include "base/text.h"
#include "desc/lobes.h"
#include "desc/names.h"
#include "desc/properties.h"
#include "read/load.h"
#include "read/txt/property_line.h"
#include "read/txt/scanner.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>
#include <vector>

namespace {

bool isBlank(char c) { return c == ' ' || c == '\t'; }

// Behind the line of the first '}' from `p` on that is the first of its line; the end when there is
// none. A line does not begin in a name or comment: they end with their lines.
const char* blockEndFrom(const char* begin, const char* p, const char* end) {
    while (true) {
        const void* const found = std::memchr(p, '}', static_cast<std::size_t>(end - p));
        if (!found) return end;
        const char* const brace = static_cast<const char*>(found);
        const char* before = brace;
        while (before > begin && isBlank(before[-1])) --before;
        p = brace + 1;
        if (before > begin && before[-1] != '\n') continue;
        const void* const newline = std::memchr(p, '\n', static_cast<std::size_t>(end - p));
        return newline ? static_cast<const char*>(newline) + 1 : end;
    }
}

// The words that open blocks, in the order of the README.
std::vector<std::string> blockWords() {
    std::vector<std::string> words = {"settings", "world", "camera", "texture",
                                      "material", "light", "mesh"};
    for (const std::string_view kind : kNamesByValue<ObjectDesc::Kind>) words.emplace_back(kind);
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
        SceneDesc& desc = blocks_.desc;
        for (const auto kind : kValuesOf<ObjectDesc::Kind>) {
            if (!is(nameOf(kind))) continue;
            // Objects have the properties of their kind. Lights and cameras say their kind in a
            // property, perhaps after others: they have all of them, and validate() warns of those
            // without effect.
            ObjectDesc& object = added(desc.objects);
            object.kind = kind;
            readHeading(object, word);
            return readProperties(object, word, &object.worldFromObject, only(kind));
        }
        if (is("material")) return readReferred(desc.materials, word);
        if (is("light")) return readLight(added(desc.lights), word);
        if (is("mesh")) return readReferred(desc.meshes, word);
        if (is("camera")) return readCamera(added(desc.cameras), word);
        if (is("texture")) return readReferred(desc.textures, word);
        if (is("settings")) return readSingle(desc.settings, word);
        if (is("world")) return readSingle(desc.world, word);
        in_.failAt(word.offset, cat("unknown block ", unknownName(shown(word.text), blockWords())));
    }

    template <class Block> Block& added(std::vector<Block>& blocks) const {
        return addedByText(blocks, in_.offset(), part_.last);
    }

    template <class Block> void readSingle(Block& block, const Token& word) {
        if (block.loc.offset != SourceLoc::kUnknown)
            in_.failAt(word.offset, cat("'", word.text, "' was given already at line ",
                                        in_.lineOf(block.loc.offset)));
        block.loc = {static_cast<std::uint32_t>(word.offset)};
        const Token t = in_.next();
        if (t.kind != TokenKind::Open)
            in_.failAt(t.offset, cat("expected '{' after '", word.text,
                                     "', which has no name, got ", described(t)));
        expectNewLine();
        readProperties(block, word);
    }

    // A block whose name others use.
    template <class Block> void readReferred(std::vector<Block>& blocks, const Token& word) {
        Block& block = added(blocks);
        blocks_.references.define(Block::kType, readHeading(block, word), blocks.size() - 1);
        if constexpr (Block::kType == BlockType::Mesh)
            readMesh(in_, errors_, word, block, part_.threads);
        else
            readProperties(block, word);
    }

    void readCamera(CameraDesc& camera, const Token& word) {
        readHeading(camera, word);
        camera.lensMm = 0; // not given
        fovDeg_ = 0;
        readProperties(camera, word, &camera.worldFromCamera);
        if (fovDeg_ > 0 && camera.lensMm > 0)
            in_.failAt(word.offset, "a camera has 'fov' or 'lens', not both");
        if (fovDeg_ > 0) {
            const bool isUpright = camera.sensorFit == CameraDesc::SensorFit::Vertical;
            const double side = isUpright ? camera.sensorHeightMm : camera.sensorWidthMm;
            camera.lensMm = side / (2 * exact::tan(radians(fovDeg_) / 2));
        } else if (camera.lensMm == 0) {
            camera.lensMm = CameraDesc{}.lensMm;
        }
    }
    // The angle of the fitted side of the sensor, another way to say how long the lens is.
    void readFieldOfView() {
        NumberLine line(in_, errors_, kFov, 1);
        line.read(fovDeg_, {0, 179, true});
    }

    // Lights stand still and have one key.
    void readLight(LightDesc& light, const Token& word) {
        readHeading(light, word);
        Keys keys{kIdentityRows};
        readProperties(light, word, &keys);
        light.worldFromLight = keys.front();
    }

    // kind name {; returns the name as it is written.
    template <class Block> Token readHeading(Block& block, const Token& word) {
        block.loc = {static_cast<std::uint32_t>(word.offset)};
        return readName(word, block.name);
    }
    Token readName(const Token& word, std::string& name) {
        const Token written = in_.next();
        if (written.kind != TokenKind::Word && written.kind != TokenKind::Quoted)
            in_.failAt(written.offset,
                       cat("expected a name after '", word.text, "', got ", described(written)));
        name = in_.nameIn(written);
        if (name.empty()) in_.failAt(written.offset, "a name has at least one letter");
        const Token t = in_.next();
        if (t.kind != TokenKind::Open)
            in_.failAt(t.offset, cat("expected '{' after the name of the ", word.text, ", got ",
                                     described(t)));
        expectNewLine();
        return written;
    }
    void expectNewLine() {
        const Token t = in_.peek();
        if (t.kind != TokenKind::LineEnd && t.kind != TokenKind::FileEnd)
            in_.failAt(t.offset, cat("expected a new line after '{', got ", described(t)));
    }

    // `keys`: where those of its place are read to, if it has one. `kinds`: of properties.
    template <class Block>
    void readProperties(Block& block, const Token& word, Keys* keys = nullptr,
                        KindMask kinds = kAllKinds) {
        const std::uint32_t text = readProperties(&block, Block::kType, word, keys, kinds);
        if constexpr (requires { block.fileLoc; }) block.fileLoc = {text};
    }
    // Returns where the value of the last property stands that is a text, such as a file's name.
    std::uint32_t readProperties(void* block, BlockType type, const Token& word, Keys* keys,
                                 KindMask kinds) {
        const std::span<const Property> rows = propertiesOf(type);
        std::array<std::size_t, kMostProperties> given;
        std::fill_n(given.begin(), rows.size(), kNotGiven);
        PropertyLine line(in_, errors_, blocks_.references, word);
        while (true) {
            const Token t = in_.next();
            if (t.kind == TokenKind::LineEnd) continue;
            if (t.kind == TokenKind::Close) break;
            if (t.kind == TokenKind::FileEnd || t.kind == TokenKind::Open)
                failUnclosed(in_, word, t);
            if (t.kind != TokenKind::Word)
                in_.failAt(t.offset, cat("expected a property or '}', got ", described(t)));
            if (keys && readTransformLine(t, word, *keys)) continue;
            if (type == BlockType::Camera && isSameWord(kFov, t.text)) {
                if (fovDeg_ > 0) in_.failAt(t.offset, "'fov' was given already");
                readFieldOfView();
                expectLineEnd(in_, kFov, word);
                continue;
            }
            if (type == BlockType::Material && isSameWord(kLobeWord, t.text)) {
                readLobe(*static_cast<MaterialDesc*>(block), t, word, given);
                continue;
            }
            const auto row = std::find_if(rows.begin(), rows.end(), [&](const Property& p) {
                return isSameWord(p.keyword, t.text) && (p.kinds & kinds);
            });
            if (row == rows.end()) failUnknown(rows, kinds, keys != nullptr, t, word);
            std::size_t& before = given[static_cast<std::size_t>(row - rows.begin())];
            if (before != kNotGiven)
                in_.failAt(t.offset,
                           cat("'", t.text, "' was given already at line ", in_.lineOf(before)));
            before = t.offset;
            line.read(block, *row);
        }
        expectLineEnd(in_, "}", word);
        return line.textOffset();
    }

    // Where a material says lobes, a diffuse one has to be said too. `given`: where its properties
    // stood so far.
    void readLobe(MaterialDesc& material, const Token& t, const Token& word,
                  const std::array<std::size_t, kMostProperties>& given) {
        const auto diffuse =
            static_cast<std::size_t>(&propertyNamed(BlockType::Material, "diffuse") -
                                     propertiesOf(BlockType::Material).data());
        if (material.lobes.empty() && given[diffuse] == kNotGiven) material.diffuse = {};
        LobeDesc lobe = readLobeLine(in_, errors_, blocks_.references, word);
        lobe.loc = {static_cast<std::uint32_t>(t.offset)};
        if (material.lobes.size() < LobeDesc::kMost)
            return material.lobes.push_back(std::move(lobe));
        errors_.add(lobe.loc, [] {
            return cat("a material has at most ", LobeDesc::kMost, " lobes; leave this one out");
        });
    }

    [[noreturn]] void failUnknown(std::span<const Property> rows, KindMask kinds, bool hasPlace,
                                  const Token& t, const Token& word) {
        std::vector<std::string> known;
        for (const Property& property : rows)
            if (property.kinds & kinds) known.emplace_back(property.keyword);
        if (word.text == "camera") known.emplace_back(kFov);
        if (word.text == "material") known.emplace_back(kLobeWord);
        if (hasPlace)
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
            for (std::size_t i = 0; i < line.count; ++i) {
                if (i == 1 && line.mayBeOne && in_.peek().kind != TokenKind::Word) {
                    std::fill_n(numbers.begin() + 1, line.count - 1, numbers[0]);
                    break;
                }
                reader.read(numbers[i], i == 0 && line.startsWithTurn ? kTurn : kAnyNumber);
            }
            reader.finish(word);
            if (errors_.count() > faultsBefore) return true;
            std::string_view fault;
            keys.back() = line.apply(keys.back(), std::span(numbers).first(line.count), fault);
            if (word.text == "camera" && line.keyword == "look_at" && fault.empty() &&
                isViewAlong(std::span(numbers)))
                fault = "the up direction of 'look_at' is parallel to the view; choose another, "
                        "such as 0 1 0";
            if (!fault.empty())
                errors_.add({static_cast<std::uint32_t>(t.offset)},
                            [&] { return std::string(fault); });
            return true;
        }
        return false;
    }

    static constexpr std::string_view kFov = "fov";
    static constexpr std::size_t kNotGiven = static_cast<std::size_t>(-1);
    Scanner in_;
    const TxtPart& part_;
    ErrorList& errors_;
    Blocks& blocks_;
    double fovDeg_ = 0; // of the camera that is read; 0: not given
};

} // namespace

std::vector<TxtPart> partsOf(std::string_view text, std::size_t first, std::size_t partBytes,
                             int threads) {
    std::vector<TxtPart> parts;
    const char* const begin = text.data();
    const char* const end = begin + text.size();
    for (const char* p = begin + first; p < end;) {
        const auto left = static_cast<std::size_t>(end - p);
        const char* const last = left <= partBytes ? end : blockEndFrom(begin, p + partBytes, end);
        TxtPart part;
        part.first = static_cast<std::size_t>(p - begin);
        part.last = static_cast<std::size_t>(last - begin);
        if ((part.last - part.first) * static_cast<std::size_t>(threads) > text.size())
            part.threads = threads;
        parts.push_back(part);
        p = last;
    }
    return parts;
}

std::size_t readBlocks(const SourceFile& source, const TxtPart& part, ErrorList& errors,
                       Blocks& blocks) {
    return BlockReader(source, part, errors, blocks).read();
}
