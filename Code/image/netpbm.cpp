#include "image/netpbm.h"

#include "base/error.h"
#include "base/text.h"

#include <algorithm>
#include <cmath>

namespace {

bool isSpace(std::uint8_t c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool isDigit(std::uint8_t c) { return c >= '0' && c <= '9'; }
std::string shown(std::string_view word) { return quotedPart(word, 20); }

} // namespace

void NetpbmHeader::failHere(const std::string& what) const {
    const auto before = file_.first(wordStart_);
    const auto lines = std::count(before.begin(), before.end(), '\n');
    const auto lineStart = std::find(before.rbegin(), before.rend(), '\n');
    fail(ErrorKind::Input,
         cat(name_, ":", lines + 1, ":", lineStart - before.rbegin() + 1, ": error: ", what));
}

void NetpbmHeader::skipComment() {
    while (at_ < file_.size() && file_[at_] != '\n' && file_[at_] != '\r') ++at_;
}

bool NetpbmHeader::hasMore() {
    while (at_ < file_.size() && (isSpace(file_[at_]) || file_[at_] == '#')) {
        if (file_[at_] == '#')
            skipComment();
        else
            ++at_;
    }
    wordStart_ = at_;
    return at_ < file_.size();
}

std::string_view NetpbmHeader::word(std::string_view what) {
    if (!hasMore()) failHere(cat("the file ends where the ", what, " should be"));
    while (at_ < file_.size() && !isSpace(file_[at_]) && file_[at_] != '#') ++at_;
    return text(wordStart_, at_ - wordStart_);
}

long long NetpbmHeader::number(std::string_view what) {
    const std::string_view found = word(what);
    const auto value = parseInteger(found);
    constexpr long long kMost = 1'000'000'000;
    if (!value || *value > kMost || *value < 0)
        failHere(cat("the ", what, " is ", shown(found), "; it must be a whole number from 1"));
    return *value;
}

double NetpbmHeader::real(std::string_view what) {
    const std::string_view found = word(what);
    const auto value = parseDouble(found);
    constexpr double kLeast = 1e-30, kMost = 1e30; // far inside float
    if (!value || !(std::fabs(*value) >= kLeast && std::fabs(*value) <= kMost))
        failHere(cat("the ", what, " is ", shown(found), "; it must be a number that is not 0"));
    return *value;
}

std::uint32_t NetpbmHeader::sample(std::uint32_t most) {
    if (!hasMore()) failHere("the file ends too early; more samples must follow");
    std::uint32_t value = 0;
    while (at_ < file_.size() && isDigit(file_[at_]) && value <= most)
        value = 10 * value + static_cast<std::uint32_t>(file_[at_++] - '0');
    const bool isWhole = at_ == file_.size() || isSpace(file_[at_]) || file_[at_] == '#';
    if (!isWhole || value > most) {
        at_ = wordStart_;
        failHere(cat("the sample ", shown(word("sample")), " is not a whole number from 0 to ",
                     most, " (the maxval)"));
    }
    return value;
}

Bytes NetpbmHeader::data(std::size_t size) {
    if (at_ < file_.size() && file_[at_] == '#') skipComment();
    const bool isReturn = at_ < file_.size() && file_[at_] == '\r';
    if (at_ < file_.size()) ++at_; // white space: the words end there
    // A header with Windows line ends: recognised by the one byte that is too many.
    if (isReturn && left() == size + 1 && file_[at_] == '\n') ++at_;
    if (left() < size)
        failPicture(name_, cat("the file ends too early: the header promises ", size,
                               " bytes of pixels, ", left(), " follow it"));
    return file_.subspan(at_, size);
}
