#include "read/txt/read_blocks.h"

#include "base/enum_names.h"
#include "base/text.h"
#include "desc/lobes.h"
#include "desc/names.h"
#include "read/txt/property_line.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace {

using Factor = LobeDesc::Factor;

class LobeLine {
public:
    LobeLine(Scanner& in, ErrorList& errors, References& references, const Token& open)
        : in_(in), errors_(errors), references_(references), open_(open) {}

    LobeDesc read() {
        if (!readKind()) return lobe_;
        while (!in_.takeLineEnd()) {
            const Token t = in_.peek();
            if (t.kind != TokenKind::Word && t.kind != TokenKind::Quoted) {
                expectLineEnd(in_, last_, open_);
                break;
            }
            in_.next();
            readWord(t);
        }
        std::stable_sort(lobe_.factors.begin(), lobe_.factors.end(),
                         [](const Factor& a, const Factor& b) { return a.field < b.field; });
        return lobe_;
    }

private:
    bool readKind() {
        const Token t = in_.next();
        const auto names = lobeNames();
        if (t.kind != TokenKind::Word)
            in_.failAt(t.offset, cat("expected the kind of a lobe after 'lobe', got ", described(t),
                                     "; known: ", join(listOf(names))));
        const auto found = std::find(names.begin(), names.end(), t.text);
        last_ = t.text;
        if (found != names.end()) {
            form_ = &lobeForms()[static_cast<std::size_t>(found - names.begin())];
            lobe_ = form_->usual;
            return true;
        }
        errors_.add(locOf(t), [&] { return unknownValue("lobe", shown(t.text), names); });
        for (Token rest = in_.peek();
             rest.kind == TokenKind::Word || rest.kind == TokenKind::Quoted; rest = in_.peek())
            in_.next();
        expectLineEnd(in_, last_, open_);
        return false;
    }

    void readWord(const Token& t) {
        const auto is = [&](std::string_view word) { return isSameWord(word, t.text); };
        if (is(kTimesWord) || is(kWithoutWord)) return readFactor(t);
        last_ = t.text;
        if (is(kCoversWord)) {
            if (lobe_.covers) failTwice(t);
            lobe_.covers = true;
            value_ = kNoValue;
            return;
        }
        if (is(kWeightWord)) {
            std::array<double, 3> rgb{lobe_.weight.r, lobe_.weight.g, lobe_.weight.b};
            readNumbers(t, Factor::kWeight, rgb, kColor);
            lobe_.weight = {rgb[0], rgb[1], rgb[2]};
            return;
        }
        const auto& fields = form_->fields;
        const auto field = std::find_if(fields.begin(), fields.end(),
                                        [&](const LobeFieldForm& f) { return is(f.name); });
        if (field == fields.end()) failUnknown(t);
        readNumbers(t, static_cast<std::int8_t>(field - fields.begin()),
                    std::span(lobe_.numbers).subspan(field->first, field->count), field->range);
    }

    void readNumbers(const Token& t, std::int8_t value, std::span<double> numbers,
                     const Range& range) {
        const std::uint32_t bit = std::uint32_t{1} << (value + 1);
        if (given_ & bit) failTwice(t);
        given_ |= bit;
        value_ = value;
        NumberLine line(in_, errors_, last_, numbers.size());
        for (double& number : numbers) line.read(number, range);
        line.expectNoMore();
    }

    void readFactor(const Token& t) {
        if (value_ == kNoValue)
            in_.failAt(t.offset, cat("there is no value before '", t.text,
                                     "' that it multiplies; write such as 'weight 1 1 1 ", t.text,
                                     " TEXTURE'"));
        last_ = t.text;
        const Token name = in_.next();
        if (name.kind != TokenKind::Word && name.kind != TokenKind::Quoted)
            in_.failAt(name.offset, cat("expected the name of a texture after '", t.text, "', got ",
                                        described(name)));
        Factor& factor = lobe_.factors.emplace_back();
        factor.field = value_;
        factor.texture = references_.use(BlockType::Texture, name);
        factor.without = t.text == kWithoutWord;
        if (!factor.without || !isNumber(in_.peek())) return;
        NumberLine line(in_, errors_, last_, 1);
        line.read(factor.strength, kFactorStrength);
        line.expectNoMore();
    }

    static std::vector<std::string> listOf(std::span<const std::string_view> names) {
        return {names.begin(), names.end()};
    }
    static SourceLoc locOf(const Token& t) { return {static_cast<std::uint32_t>(t.offset)}; }

    [[noreturn]] void failTwice(const Token& t) const {
        in_.failAt(t.offset, cat("'", t.text, "' was given already for this lobe"));
    }
    [[noreturn]] void failUnknown(const Token& t) const {
        std::vector<std::string> known{std::string(kWeightWord)};
        for (const LobeFieldForm& field : form_->fields) known.emplace_back(field.name);
        for (const std::string_view word : {kTimesWord, kWithoutWord, kCoversWord})
            known.emplace_back(word);
        const std::string name = shown(t.text);
        in_.failAt(t.offset, cat("unknown field '", name, "' of the lobe ", form_->name,
                                 unknownName(name, known).substr(name.size() + 2)));
    }

    static constexpr std::int8_t kNoValue = -2;
    Scanner& in_;
    ErrorList& errors_;
    References& references_;
    const Token& open_;
    const LobeForm* form_ = nullptr;
    LobeDesc lobe_;
    std::string_view last_;        // the word before, for messages
    std::int8_t value_ = kNoValue; // what a factor would multiply
    std::uint32_t given_ = 0;      // a bit for each value
};

} // namespace

LobeDesc readLobeLine(Scanner& in, ErrorList& errors, References& references, const Token& open) {
    return LobeLine(in, errors, references, open).read();
}
