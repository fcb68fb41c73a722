#include "read/txt/property_line.h"

#include "base/text.h"
#include "desc/names.h"
#include "read/plain_number.h"

#include <algorithm>

namespace {

bool isName(const Token& t) { return t.kind == TokenKind::Word || t.kind == TokenKind::Quoted; }
SourceLoc locOf(const Token& t) { return {static_cast<std::uint32_t>(t.offset)}; }

} // namespace

bool isNumber(const Token& t) {
    if (t.kind != TokenKind::Word) return false;
    const auto number = readDouble(t.text.data());
    return number.fault != NumberFault::NotANumber;
}

void failUnclosed(const Scanner& in, const Token& open, const Token& found) {
    in.failAt(found.offset,
              cat("block '", open.text, "' is not closed; expected '}' before ", described(found),
                  " (it was opened at line ", in.lineOf(open.offset), ")"));
}

void failUnknownProperty(Scanner& in, const Token& word, const Token& open,
                         std::span<const std::string> known) {
    Token t = in.peek();
    while (t.kind == TokenKind::Word || t.kind == TokenKind::Quoted) t = in.next();
    if (t.kind == TokenKind::Open) failUnclosed(in, open, word);
    const std::string name = shown(word.text);
    const bool vowel = std::string_view("aeiou").find(open.text.front()) != std::string_view::npos;
    const std::string_view article = open.text == "settings" ? "" : vowel ? "an " : "a ";
    in.failAt(word.offset, cat("unknown property '", name, "' of ", article, open.text,
                               unknownName(name, known).substr(name.size() + 2)));
}

void expectLineEnd(Scanner& in, std::string_view after, const Token& open) {
    if (in.takeLineEnd()) return;
    const Token t = in.peek();
    if (t.kind == TokenKind::Open) failUnclosed(in, open, t);
    if (t.kind != TokenKind::LineEnd && t.kind != TokenKind::FileEnd)
        in.failAt(t.offset,
                  cat("expected the end of the line after '", after, "', got ", described(t)));
    in.next();
}

std::string NumberLine::expected() const {
    return count_ == 1 ? cat("expected a number after '", keyword_, "'")
                       : cat("expected ", count_, " numbers after '", keyword_, "'");
}

Token NumberLine::nextNumber() {
    const Token t = in_.peek();
    if (t.kind != TokenKind::Word) {
        const bool ends = t.kind == TokenKind::LineEnd || t.kind == TokenKind::FileEnd;
        in_.failAt(t.offset,
                   ends ? cat(expected(), ", got ", got_ == 0 ? "none" : std::to_string(got_))
                        : cat(expected(), ", got ", described(t)));
    }
    ++got_;
    return in_.next();
}

void NumberLine::read(double& value, const Range& range) {
    // What is plain and right needs no token.
    double plain = 0;
    const char* const end = readPlainNumber(in_.skipToWord(), in_.textEnd(), plain);
    if (!end || isBareChar(*end) || !range.contains(plain)) return readAny(value, range);
    in_.moveTo(end);
    ++got_;
    value = plain;
}

void NumberLine::readAny(double& value, const Range& range) {
    const Token t = nextNumber();
    const auto number = readDouble(t.text.data());
    const SourceLoc loc = locOf(t);
    if (number.fault == NumberFault::TooLarge)
        return errors_.add(loc, [&] { return cat(described(t), " is too large"); });
    if (t.text == "inf" && range.contains(kEndless)) {
        value = kEndless;
        return;
    }
    if (isNotFinite(t.text))
        return errors_.add(loc, [&] { return cat(described(t), " is not a finite number"); });
    if (number.fault != NumberFault::None || number.end != t.text.data() + t.text.size())
        in_.failAt(t.offset, cat(expected(), ", got ", described(t)));
    if (!range.contains(number.value))
        return errors_.add(loc, [&] {
            return cat("'", keyword_, "' ", mustBe(range, number.value), ", got ", shown(t.text));
        });
    value = number.value;
}

void NumberLine::readWhole(double& value, const Range& range) {
    const Token t = nextNumber();
    const auto whole = parseInteger(t.text);
    if (whole && range.contains(static_cast<double>(*whole))) {
        value = static_cast<double>(*whole);
        return;
    }
    const auto what = [&] {
        return cat("expected a whole number from ", range.lo, " to ",
                   static_cast<long long>(range.hi), " after '", keyword_, "', got ", described(t));
    };
    if (!isNumber(t)) in_.failAt(t.offset, what());
    errors_.add(locOf(t), what);
}

void NumberLine::finish(const Token& open) {
    if (in_.takeLineEnd()) return;
    expectNoMore();
    expectLineEnd(in_, keyword_, open);
}

void NumberLine::expectNoMore() {
    const Token extra = in_.peek();
    if (!isNumber(extra)) return;
    while (isNumber(in_.peek())) {
        in_.next();
        ++got_;
    }
    in_.failAt(extra.offset, cat(expected(), ", got ", got_));
}

void PropertyLine::read(void* block, const Property& property) {
    keyword_ = property.keyword;
    if (property.hasWord()) readWord(block, property.first);
    if (property.numberCount() > 0) return readNumbers(block, property);
    expectLineEnd(in_, keyword_, open_);
}

void PropertyLine::readNumbers(void* block, const Property& property) {
    const std::size_t count = property.numberCount(), faultsBefore = errors_.count();
    NumberLine line(in_, errors_, keyword_, count);
    std::array<double, kMostNumbers> numbers;
    for (std::size_t i = 0; i < count; ++i)
        property.isWhole() ? line.readWhole(numbers[i], property.range)
                           : line.read(numbers[i], property.range);
    line.finish(open_);
    if (errors_.count() == faultsBefore) setNumbers(property, block, numbers.data());
}

void PropertyLine::readWord(void* block, const Field& field) {
    switch (field.kind) {
    case FieldKind::Flag: {
        const Token t = in_.next();
        if (t.text != "true" && t.text != "false") failExpected(t, "true or false");
        at<bool>(field, block) = t.text == "true";
        return;
    }
    case FieldKind::Text: {
        const Token t = nextName("a text");
        textOffset_ = static_cast<std::uint32_t>(t.offset);
        at<std::string>(field, block) = in_.nameIn(t);
        return;
    }
    case FieldKind::Name: {
        const Token t = in_.next();
        if (!isName(t)) failExpected(t, cat("the name of a ", nameOf(field.target)));
        at<Handle>(field, block) = references_.use(field.target, t);
        return;
    }
    case FieldKind::Choice: return readChoice(block, field);
    default: readMaterials(at<OneOrMore<Handle>>(field, block), field.kind == FieldKind::Materials);
    }
}

void PropertyLine::readChoice(void* block, const Field& field) {
    const Token t = in_.next();
    const auto names = field.names;
    if (t.kind != TokenKind::Word)
        failExpected(t, "one of " + join(std::vector<std::string>(names.begin(), names.end())));
    for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == t.text) {
            at<std::uint8_t>(field, block) = static_cast<std::uint8_t>(i);
            return;
        }
    errors_.add(locOf(t), [&] { return unknownValue(keyword_, shown(t.text), names); });
}

void PropertyLine::readMaterials(OneOrMore<Handle>& handles, bool many) {
    const Token first = nextName("the name of a material");
    if (!handles.empty())
        errors_.add(locOf(first), [] { return "give 'material' or 'materials', not both"; });
    handles.assign(1, references_.use(BlockType::Material, first));
    while (many && isName(in_.peek()))
        handles.push_back(references_.use(BlockType::Material, in_.next()));
}

Token PropertyLine::nextName(std::string_view what) {
    const Token t = in_.next();
    if (!isName(t)) failExpected(t, what);
    return t;
}

void PropertyLine::failExpected(const Token& t, std::string_view what) const {
    in_.failAt(t.offset, cat("expected ", what, " after '", keyword_, "', got ", described(t)));
}
