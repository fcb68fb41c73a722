// The data of an ascii PLY file as numbers: one line per row of an element. The same steps as
// PlyBytes: one loop reads both.
#pragma once

#include "read/mesh/ply_rows.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

class PlyText : public PlyInput {
public:
    PlyText(const SourceFile& source, std::size_t offset) : PlyInput(source, offset) {}

    void begin(const PlyElement& element) {
        // A value and what is between it and the next one.
        PlyInput::begin(element, 2 * element.properties.size(), bytesLeft() + 1);
    }
    // Where the row ended that was read last, or would end if it took one line of its own.
    const char* rowEnd() const { return p_ < end_ ? p_ + 1 : end_; }
    // The rows of the element that has begun in parts, if each has one line.
    std::vector<RowChunk> chunks(int threads) const;

    void beginRow(); // moves over empty lines
    void endRow();

    double number(PlyType type); // float32 is rounded to float, as the binary formats are
    void skip(PlyType) { skipWord(); }
    void list(const PlyProperty& property, std::size_t most, std::vector<std::uint32_t>& items);
    void numbers(const PlyProperty& property, std::size_t most, std::vector<double>& items);
    void skipList(const PlyProperty& property);

    [[noreturn]] void fail(std::string_view what) const { failAtText(last_, what); }
    [[noreturn]] void failAtItem(const PlyProperty& property, std::size_t i, std::string_view what);
    std::optional<std::pair<std::size_t, std::string>> rest();

private:
    static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
    bool isAtEnd(const char* p) const { return *p == '\n' || p == end_; }

    void skipBlanks() {
        while (isBlank(*p_)) ++p_;
    }
    // Moves to the next value of the line.
    void toValue() {
        skipBlanks();
        last_ = p_;
        if (isAtEnd(p_)) failMissing();
    }
    void skipWord() {
        toValue();
        while (!isBlank(*p_) && !isAtEnd(p_)) ++p_;
    }
    bool endsValue(const char* p) const { return isBlank(*p) || isAtEnd(p); }
    std::string word(const char* p) const;
    std::uint32_t whole();
    std::size_t listCount(const PlyProperty& property, std::size_t most);

    [[noreturn]] void failMissing() const;
    [[noreturn]] void failAtText(const char* p, std::string_view what) const {
        failAt(*source_, static_cast<std::size_t>(p - source_->text.data()), what);
    }
};
