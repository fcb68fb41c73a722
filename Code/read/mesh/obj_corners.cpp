#include "read/mesh/obj_corners.h"

#include "base/text.h"
#include "desc/names.h"
#include "read/mesh/triangulate.h"

std::span<const MeshBuilder::Corner> CornerReader::readFace() {
    if (const char* const next = readPlainFace(in_.text(), in_.end(), total_, plain_)) {
        in_.moveToLine(next);
        return std::span(plain_.corners).first(plain_.count);
    }
    corners_.clear();
    while (!in_.atLineEnd()) {
        if (corners_.size() == kMostCorners)
            in_.failAt(in_.offset(),
                       cat("a face with more than ", kMostCorners, " corners; divide it"));
        readCorner();
    }
    return corners_;
}

inline std::uint32_t CornerReader::readIndex(const char*& p, std::size_t total, std::size_t soFar,
                                             std::string_view one, std::string_view many) {
    // Most are: a number from 1 that there is.
    constexpr std::ptrdiff_t kDigits = 9;
    std::uint32_t value = 0;
    const char* end = p;
    for (; *end >= '0' && *end <= '9' && end - p < kDigits; ++end)
        value = value * 10 + static_cast<std::uint32_t>(*end - '0');
    if (value == 0 || value > total || end - p == kDigits)
        return readOtherIndex(p, total, soFar, one, many);
    p = end;
    return value - 1;
}

// v, v/vt, v//vn, v/vt/vn; as some programs write it also v/ v// v/vt/
void CornerReader::readCorner() {
    const std::size_t start = in_.offset();
    const char* p = in_.text();
    MeshBuilder::Corner corner;
    corner.point = readIndex(p, total_.points, soFar_.points, "vertex", "vertices");
    if (*p == '/') {
        ++p;
        if (*p != '/' && !in_.isNumberEnd(p))
            corner.uv = readIndex(p, total_.uvs, soFar_.uvs, "'vt'", "of them");
        if (*p == '/' && !in_.isNumberEnd(++p))
            corner.normal = readIndex(p, total_.normals, soFar_.normals, "'vn'", "of them");
    }
    if (!in_.isNumberEnd(p)) failCorner(start);
    constexpr std::uint32_t kMissing = MeshBuilder::kMissing;
    if (!corners_.empty() && ((corner.uv == kMissing) != (corners_[0].uv == kMissing) ||
                              (corner.normal == kMissing) != (corners_[0].normal == kMissing)))
        in_.failAt(start, cat("corner ", in_.nextWord(),
                              " is not written as the first one of its face; all are v, v/vt, "
                              "v//vn or v/vt/vn"));
    corners_.push_back(corner);
    in_.moveTo(p);
}

void CornerReader::failCorner(std::size_t start) {
    in_.failAt(start, cat("expected a corner of a face (v, v/vt, v//vn or v/vt/vn), got ",
                          in_.nextWord()));
}

// From 1, or from -1 for the last one so far. The reader still stands at the corner.
std::uint32_t CornerReader::readOtherIndex(const char*& p, std::size_t total, std::size_t soFar,
                                           std::string_view one, std::string_view many) {
    const char* const start = p;
    const bool fromEnd = *p == '-';
    const auto index = readUnsigned(p + (fromEnd ? 1 : 0));
    if (index.fault == NumberFault::NotANumber) failCorner(in_.offset());
    const std::uint32_t value = index.value;
    if (index.fault == NumberFault::TooLarge || value == 0 || value > (fromEnd ? soFar : total)) {
        const char* last = start + (fromEnd ? 1 : 0);
        while (*last >= '0' && *last <= '9') ++last;
        const std::string written = shown({start, static_cast<std::size_t>(last - start)});
        if (value == 0 && index.fault == NumberFault::None)
            in_.failAt(in_.offsetOf(start), "there is no index 0; the first is 1, the last -1");
        in_.failAt(
            in_.offsetOf(start),
            fromEnd ? cat("there is no ", one, " ", written, "; only ", soFar, " ",
                          soFar == 1 ? "comes" : "come", " before this line")
                    : cat("there is no ", one, " ", written, "; the file has ", total, " ", many));
    }
    p = index.end;
    return static_cast<std::uint32_t>(fromEnd ? soFar - value : value - 1);
}
