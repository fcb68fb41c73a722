// Faces of an OBJ file: their corners, and those of a chunk that has nothing but vertices and
// faces.
#pragma once

#include "read/mesh/mesh_builder.h"
#include "read/mesh/obj_chunks.h"
#include "read/mesh/plain_lines.h"

#include <span>
#include <vector>

// CornerReader: the corners of the faces of an OBJ file, whose indices count from the start of the
// file or back from the line.
class CornerReader {
public:
    // `soFar` counts the vertices in front of the line that the reader is in.
    CornerReader(LineReader& in, const ObjCounts& total, const ObjCounts& soFar)
        : in_(in), total_(total), soFar_(soFar) {}

    // Those of one face, until the next call; the reader is behind the keyword.
    std::span<const MeshBuilder::Corner> readFace();
    // Faces so far with a 'vt' or 'vn' that the file does not have: they have none of that kind.
    const Counted& unknown() const { return unknown_; }

private:
    void readCorner();
    std::uint32_t readIndex(const char*& p, std::size_t total, std::size_t soFar,
                            std::string_view one, std::string_view many);
    std::uint32_t readOtherIndex(const char*& p, std::size_t total, std::size_t soFar,
                                 std::string_view one, std::string_view many);
    [[noreturn]] void failCorner(std::size_t start);

    LineReader& in_;
    const ObjCounts& total_;
    const ObjCounts& soFar_;
    PlainFace plain_;
    std::vector<MeshBuilder::Corner> corners_;
    bool hasUnknown_ = false; // of the face that is read
    Counted unknown_;
};

// What was left out of the faces.
struct FacesLeftOut {
    Counted tooFewCorners, noArea;
    Counted unknown; // CornerReader::unknown(): only some numbers of theirs
    void add(const FacesLeftOut& others) {
        tooFewCorners.add(others.tooFewCorners);
        noArea.add(others.noArea);
        unknown.add(others.unknown);
    }
};

// Those of a plain chunk, for a builder that knows the points of the file; `total` are its
// vertices.
FacesLeftOut readPlainFaces(const SourceFile& source, const ObjChunk& chunk, const ObjCounts& total,
                            MeshBuilder& to);
