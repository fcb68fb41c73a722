#include "read/txt/read_blocks.h"

#include "base/text.h"
#include "desc/names.h"
#include "desc/properties.h"
#include "read/number.h"
#include "read/txt/array_lines.h"
#include "read/txt/property_line.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace {

// What was read of an array, for the check of the indices when the whole block is known.
struct ArrayRead {
    std::string_view keyword, indexes; // see forEachArray()
    bool given = false;
    std::size_t offset = 0; // of its keyword, then of its first number
    std::size_t numbers = 0;
    std::size_t groups = 0;
    std::uint32_t largestIndex = 0; // of index arrays
};

class MeshReader {
public:
    MeshReader(Scanner& in, ErrorList& errors, const Token& open, MeshDesc& mesh, int threads)
        : in_(in), errors_(errors), open_(open), mesh_(mesh), threads_(threads) {
        forEachArray(mesh, [&](std::string_view keyword, auto&, std::string_view indexes) {
            reads_.push_back({keyword, indexes});
        });
    }

    void read() {
        while (true) {
            const Token t = in_.next();
            if (t.kind == TokenKind::LineEnd) continue;
            if (t.kind == TokenKind::Close) break;
            if (t.kind == TokenKind::FileEnd || t.kind == TokenKind::Open)
                failUnclosed(in_, open_, t);
            if (t.kind != TokenKind::Word)
                in_.failAt(t.offset, cat("expected a property or '}', got ", described(t)));
            if (!readProperty(t)) readArray(t, arrayNamed(t));
        }
        expectLineEnd(in_, "}", open_);
        checkFile();
        for (const ArrayRead& array : reads_) checkIndices(array);
        shareCorners(mesh_.normals.size(), mesh_.normalTriangles);
        shareCorners(mesh_.uvs.size(), mesh_.uvTriangles);
    }

private:
    // Values without corners of their own, one for each point, are those of the points.
    void shareCorners(std::size_t values, RawVector<MeshDesc::Corners>& corners) const {
        if (corners.empty() && values > 0 && values == mesh_.points.size())
            corners = mesh_.triangles;
    }

    bool readProperty(const Token& t) {
        const auto row = std::find_if(properties_.begin(), properties_.end(),
                                      [&](const Property& p) { return p.keyword == t.text; });
        if (row == properties_.end()) return false;
        std::size_t& before = given_[static_cast<std::size_t>(row - properties_.begin())];
        if (before > 0)
            in_.failAt(t.offset,
                       cat("'", t.text, "' was given already at line ", in_.lineOf(before)));
        before = t.offset;
        References none(in_.source(), false); // a mesh names nothing
        PropertyLine(in_, errors_, none, open_).read(&mesh_, *row);
        if (row->keyword == "file") mesh_.fileLoc = {static_cast<std::uint32_t>(t.offset)};
        return true;
    }

    // A mesh has arrays or a file.
    void checkFile() {
        if (mesh_.file.empty()) {
            for (std::size_t i = 0; i < properties_.size(); ++i)
                if (given_[i] > 0)
                    errors_.add({static_cast<std::uint32_t>(given_[i])}, [&] {
                        return cat("'", properties_[i].keyword, "' needs the name of a file");
                    });
            return;
        }
        for (const ArrayRead& array : reads_)
            if (array.given)
                errors_.add({static_cast<std::uint32_t>(array.offset)},
                            [] { return "a mesh has a 'file' or arrays, not both"; });
    }

    ArrayRead& arrayNamed(const Token& t) {
        for (ArrayRead& array : reads_)
            if (array.keyword == t.text) return array;
        if (!last_.empty() && readDouble(t.text.data()).fault != NumberFault::NotANumber)
            in_.failAt(t.offset, cat("'", last_, "' has more numbers than its count says"));
        std::vector<std::string> known;
        for (const Property& property : properties_) known.emplace_back(property.keyword);
        for (const ArrayRead& array : reads_) known.emplace_back(array.keyword);
        failUnknownProperty(in_, t, open_, known);
    }

    void readArray(const Token& keyword, ArrayRead& read) {
        if (read.given)
            in_.failAt(keyword.offset, cat("'", keyword.text, "' was given already at line ",
                                           in_.lineOf(read.offset)));
        read.given = true;
        read.offset = keyword.offset;
        last_ = keyword.text;
        forEachArray(mesh_, [&](std::string_view name, auto& groups, std::string_view) {
            if (name == read.keyword) readGroups(groups, read);
        });
        expectLineEnd(in_, keyword.text, open_);
    }

    template <class Group> void readGroups(RawVector<Group>& groups, ArrayRead& read) {
        read.groups = readCount(GroupOf<Group>::kSize);
        read.numbers = read.groups * GroupOf<Group>::kSize;
        groups.resize(read.groups);
        const std::size_t start = in_.offset();
        if (threads_ > 1) {
            const char* const text = in_.source().text.data();
            if (const auto lines = readLines(text + start, text + in_.source().text.size(),
                                             std::span(groups), threads_)) {
                read.offset = start;
                read.largestIndex = lines->largestIndex;
                return in_.moveTo(lines->end);
            }
        }
        for (Group& group : groups)
            for (std::size_t i = 0; i < GroupOf<Group>::kSize; ++i) {
                const char* const p = in_.skipToValue();
                const auto number = GroupOf<Group>::read(p);
                if (number.fault != NumberFault::None || !Scanner::endsNumber(*number.end))
                    failNumber<Group>(static_cast<std::size_t>(&group - groups.data()) *
                                              GroupOf<Group>::kSize +
                                          i,
                                      read);
                if constexpr (requires { GroupOf<Group>::kLargest; }) {
                    if (!(std::fabs(number.value) <= GroupOf<Group>::kLargest))
                        errors_.add({static_cast<std::uint32_t>(in_.offset())}, [&] {
                            return cat(described(in_.peek()), " is too large; at most ",
                                       shortest(GroupOf<Group>::kLargest));
                        });
                } else {
                    read.largestIndex = std::max(read.largestIndex, number.value);
                }
                GroupOf<Group>::number(group, i) = number.value;
                in_.moveTo(number.end);
            }
        read.offset = start;
    }

    // A group takes at least two bytes per number, so a count that the rest of the file cannot hold
    // is found before memory is asked for.
    std::size_t readCount(std::size_t groupSize) {
        const Token t = in_.peek();
        const auto count = t.kind == TokenKind::Word ? parseInteger(t.text) : std::nullopt;
        if (!count || *count < 0)
            in_.failAt(t.offset, cat("expected a count after '", last_, "', got ", described(t)));
        in_.next();
        const std::size_t possible = (in_.bytesLeft() + 1) / (2 * groupSize);
        if (static_cast<std::uint64_t>(*count) > possible)
            in_.failAt(t.offset, cat("'", last_, " ", *count,
                                     "' is more than the rest of the file can hold (", possible,
                                     " at most)"));
        return static_cast<std::size_t>(*count);
    }

    template <class Group> [[noreturn]] void failNumber(std::size_t got, const ArrayRead& read) {
        const Token t = in_.next();
        constexpr bool kIndex = !requires { GroupOf<Group>::kLargest; };
        if (t.kind == TokenKind::Word && readDouble(t.text.data()).fault == NumberFault::TooLarge)
            in_.failAt(t.offset, cat(described(t), " is too large"));
        in_.failAt(t.offset,
                   cat("expected ", read.groups, " times ", GroupOf<Group>::kSize,
                       kIndex ? " whole numbers after '" : " numbers after '", last_, "', got ",
                       described(t), " as number ", got + 1, " of ", read.numbers));
    }

    // The largest index was noted while reading; the place of a wrong one is looked for only now.
    void checkIndices(const ArrayRead& read) {
        if (read.indexes.empty() || read.groups == 0) return;
        const std::size_t count =
            std::find_if(reads_.begin(), reads_.end(), [&](const ArrayRead& array) {
                return array.keyword == read.indexes;
            })->groups;
        if (read.largestIndex < count) return;
        const std::size_t after = in_.offset();
        in_.moveTo(read.offset);
        for (std::size_t i = 0; i < read.numbers; ++i) {
            const auto index = readUnsigned(in_.skipToValue());
            if (index.value >= count)
                errors_.add({static_cast<std::uint32_t>(in_.offset())}, [&] {
                    return cat("there is no ", index.value, " in '", read.indexes, "': it has ",
                               count, ", counted from 0");
                });
            in_.moveTo(index.end);
        }
        in_.moveTo(after);
    }

    Scanner& in_;
    ErrorList& errors_;
    const Token& open_;
    MeshDesc& mesh_;
    int threads_;
    const std::span<const Property> properties_ = propertiesOf(BlockType::Mesh);
    std::vector<ArrayRead> reads_;
    std::array<std::size_t, kMostProperties> given_{}; // where; no property stands at 0
    std::string_view last_; // the keyword of the array that was begun last
};

} // namespace

void readMesh(Scanner& in, ErrorList& errors, const Token& open, MeshDesc& mesh, int threads) {
    MeshReader(in, errors, open, mesh, threads).read();
}
