#include "read/mesh/obj_faces.h"

#include "read/mesh/obj_corners.h"

#include <algorithm>
#include <array>

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
