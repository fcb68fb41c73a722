// CornerReader: the corners of the faces of an OBJ file, whose indices count from the start of the
// file or back from the line.
#pragma once

#include "read/mesh/plain_lines.h"

#include <span>
#include <vector>

class CornerReader {
public:
    // `soFar` counts the vertices in front of the line that the reader is in.
    CornerReader(LineReader& in, const ObjCounts& total, const ObjCounts& soFar)
        : in_(in), total_(total), soFar_(soFar) {}

    // Those of one face, until the next call; the reader is behind the keyword.
    std::span<const MeshBuilder::Corner> readFace();

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
};
