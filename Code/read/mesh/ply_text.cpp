#include "read/mesh/ply_text.h"

#include "base/text.h"
#include "desc/names.h"
#include "read/line_chunks.h"
#include "read/number.h"

#include <algorithm>
#include <limits>

std::vector<RowChunk> PlyText::chunks(int threads) const {
    const char* first = p_;
    while (isBlank(*first) || *first == '\n') ++first;
    std::vector<RowChunk> out;
    for (const LineChunk& lines : chunksOfLines(first, end_, element_->count, threads))
        out.push_back({lines.first, lines.before, lines.lines});
    return out;
}

void PlyText::beginRow() {
    while (isBlank(*p_) || *p_ == '\n') ++p_;
    last_ = p_;
    if (p_ == end_)
        fail(cat("the file ends after ", row_, " of ", element_->count, " rows of '",
                 shown(element_->name), "'"));
}

void PlyText::endRow() {
    skipBlanks();
    if (!isAtEnd(p_))
        failAtText(p_, cat("expected the end of the line, got ", word(p_), "; row ", row_, " of '",
                           shown(element_->name), "' has all its values"));
    ++row_;
}

double PlyText::number(PlyType type) {
    toValue();
    double value = 0;
    const char* end = nullptr;
    NumberFault fault = NumberFault::None;
    const auto keep = [&](const auto& read) {
        value = static_cast<double>(read.value);
        end = read.end;
        fault = read.fault;
    };
    if (type == PlyType::Float32)
        keep(readFloat(p_));
    else
        keep(readDouble(p_));
    if (fault != NumberFault::None || !endsValue(end)) {
        const char* start = p_;
        skipWord();
        if (fault != NumberFault::TooLarge &&
            !isNotFinite({start, static_cast<std::size_t>(p_ - start)}))
            fail(cat("expected a number, got ", word(start)));
        return std::numeric_limits<double>::quiet_NaN();
    }
    p_ = end;
    return value;
}

std::uint32_t PlyText::whole() {
    toValue();
    const bool isNegative = *p_ == '-';
    const auto read = readUnsigned(p_ + (isNegative ? 1 : 0));
    if (read.fault == NumberFault::TooLarge) fail(cat(word(p_), " is too large"));
    if (read.fault != NumberFault::None || !endsValue(read.end))
        fail(cat("expected a whole number, got ", word(p_)));
    p_ = read.end;
    // Negative ones wrap around, as they do in PlyBytes.
    if (isNegative && read.value > 0x80000000u) fail(cat(word(last_), " is too large"));
    const auto value = static_cast<std::int64_t>(read.value);
    return static_cast<std::uint32_t>(isNegative ? -value : value);
}

std::size_t PlyText::listCount(const PlyProperty& property, std::size_t most) {
    const std::uint32_t count = whole();
    const std::size_t possible = std::min(most, bytesLeft() / 2);
    if (count > possible || *last_ == '-')
        fail(tooManyItems(property, word(last_), possible, most));
    listStart_ = p_;
    return count;
}

void PlyText::list(const PlyProperty& property, std::size_t most,
                   std::vector<std::uint32_t>& items) {
    const std::size_t count = listCount(property, most);
    items.clear();
    for (std::size_t i = 0; i < count; ++i) items.push_back(whole());
}

void PlyText::numbers(const PlyProperty& property, std::size_t most, std::vector<double>& items) {
    items.resize(listCount(property, most));
    for (double& item : items) item = number(property.type);
}

void PlyText::skipList(const PlyProperty& property) {
    for (std::size_t left = listCount(property, bytesLeft()); left > 0; --left) skipWord();
}

void PlyText::failAtItem(const PlyProperty&, std::size_t i, std::string_view what) {
    p_ = listStart_;
    for (std::size_t before = 0; before < i; ++before) skipWord();
    toValue();
    fail(what);
}

std::optional<std::pair<std::size_t, std::string>> PlyText::rest() {
    while (isBlank(*p_) || *p_ == '\n') ++p_;
    if (p_ == end_) return {};
    return std::pair(static_cast<std::size_t>(p_ - source_->text.data()),
                     std::string("this follows the last element and was not read"));
}

std::string PlyText::word(const char* p) const {
    const char* end = p;
    while (!endsValue(end)) ++end;
    return cat("'", shown({p, static_cast<std::size_t>(end - p)}), "'");
}

void PlyText::failMissing() const {
    fail(cat("the line ends too early: row ", row_, " of '", shown(element_->name),
             "' has more values"));
}
