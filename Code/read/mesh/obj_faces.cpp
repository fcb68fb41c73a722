#include "read/mesh/obj_faces.h"

#include "base/text.h"
#include "desc/names.h"
#include "read/mesh/mesh_steps.h"

#include <algorithm>
#include <array>

std::span<const MeshBuilder::Corner> CornerReader::readFace() {
    if (const char* const next = readPlainFace(in_.text(), in_.end(), total_, plain_)) {
        in_.moveToLine(next);
        return std::span(plain_.corners).first(plain_.count);
    }
    corners_.clear();
    hasUnknown_ = false;
    const std::size_t start = in_.offset();
    while (!in_.atLineEnd()) {
        if (corners_.size() == kMostCorners)
            in_.failAt(in_.offset(),
                       cat("a face with more than ", kMostCorners, " corners; divide it"));
        readCorner();
    }
    if (!hasUnknown_) return corners_;
    unknown_.add(start);
    using Corner = MeshBuilder::Corner;
    for (const auto member : {&Corner::uv, &Corner::normal}) {
        const auto isMissing = [&](const Corner& c) { return c.*member == MeshBuilder::kMissing; };
        if (std::any_of(corners_.begin(), corners_.end(), isMissing))
            for (Corner& corner : corners_) corner.*member = MeshBuilder::kMissing;
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
    if (!corners_.empty() && !hasUnknown_ &&
        ((corner.uv == kMissing) != (corners_[0].uv == kMissing) ||
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
        if (one.front() == '\'') { // a picture needs no more of a corner than its point
            hasUnknown_ = true;
            p = last;
            return MeshBuilder::kMissing;
        }
        in_.failAt(
            in_.offsetOf(start),
            fromEnd ? cat("there is no ", one, " ", written, "; only ", soFar, " ",
                          soFar == 1 ? "comes" : "come", " before this line")
                    : cat("there is no ", one, " ", written, "; the file has ", total, " ", many));
    }
    p = index.end;
    return static_cast<std::uint32_t>(fromEnd ? soFar - value : value - 1);
}

namespace {

class FaceReader {
public:
    FaceReader(const SourceFile& source, const ObjChunk& chunk, const ObjCounts& total,
               MeshBuilder& to)
        : in_(source, chunk.first, chunk.last), soFar_(chunk.before), total_(total), to_(to) {}

    FacesLeftOut read() {
        CornerReader reader(in_, total_, soFar_);
        while (in_.nextLine()) {
            if (*in_.text() == 'v' && takeVertex(in_, soFar_)) continue;
            const std::size_t start = in_.offset();
            takeFace(in_); // there is nothing else in a plain chunk
            const auto corners = reader.readFace();
            if (corners.size() == 3)
                wait(corners, start);
            else if (corners.size() < 3)
                leftOut_.tooFewCorners.add(start);
            else
                addPolygon(corners, start);
        }
        addWaiting();
        leftOut_.unknown = reader.unknown();
        return leftOut_;
    }

private:
    using Corner = MeshBuilder::Corner;
    struct Triangle {
        std::array<Corner, 3> corners;
        std::size_t start;
    };

    // The points of some triangles come from memory while their lines are read.
    void wait(std::span<const Corner> corners, std::size_t start) {
        for (const Corner& corner : corners) to_.prefetch(corner);
        waiting_[waitingCount_++] = {{corners[0], corners[1], corners[2]}, start};
        if (waitingCount_ == waiting_.size()) addWaiting();
    }
    void addWaiting() {
        for (const Triangle& t : std::span(waiting_).first(waitingCount_))
            if (!to_.addFace(t.corners)) leftOut_.noArea.add(t.start);
        waitingCount_ = 0;
    }
    void addPolygon(std::span<const Corner> corners, std::size_t start) {
        addWaiting();
        if (!to_.addFace(corners)) leftOut_.noArea.add(start);
    }

    LineReader in_;
    ObjCounts soFar_;
    const ObjCounts& total_;
    MeshBuilder& to_;
    FacesLeftOut leftOut_;
    std::array<Triangle, 32> waiting_;
    std::size_t waitingCount_ = 0;
};

} // namespace

FacesLeftOut readPlainFaces(const SourceFile& source, const ObjChunk& chunk, const ObjCounts& total,
                            MeshBuilder& to) {
    if (!chunk.hasFaces) return {};
    return FaceReader(source, chunk, total, to).read();
}
