#include "read/txt/property_line.h"

#include "read/plain_number.h"

#include <algorithm>

namespace {

bool isNumber(const Token& t) {
    if (t.kind != TokenKind::Word) return false;
    const auto number = readDouble(t.text.data());
    return number.fault != NumberFault::NotANumber;
}

// What from_chars of other programs writes and reads as numbers, but no scene can mean.
bool isNotFinite(std::string_view word) {
    std::string lower;
    for (const char c : word)
        if (c != '+' && c != '-') lower += static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
    return lower == "nan" || lower == "inf" || lower == "infinity";
}

} // namespace

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
        in_.failAt(t.offset, ends ? cat(expected(), ", got ", got_)
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
    const SourceLoc loc{static_cast<std::uint32_t>(t.offset)};
    if (number.fault == NumberFault::TooLarge)
        return errors_.add(loc, [&] { return cat(described(t), " is too large"); });
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

std::optional<long long> NumberLine::readWhole(const Range& range) {
    const Token t = nextNumber();
    const auto value = parseInteger(t.text);
    if (value && range.contains(static_cast<double>(*value))) return value;
    const auto what = [&] {
        return cat("expected a whole number from ", range.lo, " to ",
                   static_cast<long long>(range.hi), " after '", keyword_, "', got ", described(t));
    };
    if (!isNumber(t)) in_.failAt(t.offset, what());
    errors_.add({static_cast<std::uint32_t>(t.offset)}, what);
    return {};
}

void NumberLine::finish(const Token& open) {
    if (in_.takeLineEnd()) return;
    const Token extra = in_.peek();
    if (!isNumber(extra)) return expectLineEnd(in_, keyword_, open);
    while (isNumber(in_.peek())) {
        in_.next();
        ++got_;
    }
    in_.failAt(extra.offset, cat(expected(), ", got ", got_));
}
