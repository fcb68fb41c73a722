// The text of an OBJ file in chunks of whole lines, which threads can read at the same time: where
// they are, how much is in each, and their vertices.
#pragma once

#include "desc/scene_desc.h"
#include "read/mesh/line_reader.h"
#include "read/read_context.h"

#include <cstddef>
#include <vector>

struct ObjCounts {
    std::size_t points = 0, uvs = 0, normals = 0;
    bool operator==(const ObjCounts&) const = default;
};

struct ObjChunk {
    const char *first = nullptr, *last = nullptr;
    ObjCounts before, behind;  // how many vertices come up to here: in front of it, and with it
    std::size_t triangles = 0; // at most
    bool hasFaces = false;
    bool isPlain = true; // vertices and faces only, which need to know nothing else
    bool hasVertices() const { return before != behind; }
};

struct ObjChunks {
    std::vector<ObjChunk> chunks; // they do not depend on the number of threads
    ObjCounts total;
    std::size_t triangles = 0;
};

ObjChunks chunksOf(const SourceFile& source, int threads);
// What vertices have that is not read: colours, and numbers that are not finite or too large.
// Points with such a number are NaN, normals and texture coordinates zero.
struct VerticesLeftOut {
    Counted colours, notFinite;
    void add(const VerticesLeftOut& others) {
        colours.add(others.colours);
        notFinite.add(others.notFinite);
    }
};
// Fails at the first vertex that is wrong.
VerticesLeftOut readVertices(const SourceFile& source, const ObjChunks& chunks, MeshDesc& mesh,
                             int threads);

// Is this the line of a vertex? Then the reader is behind its keyword, and it is counted.
inline bool takeVertex(LineReader& in, ObjCounts& counts) {
    if (in.take("v"))
        ++counts.points;
    else if (in.take("vn"))
        ++counts.normals;
    else if (in.take("vt"))
        ++counts.uvs;
    else
        return false;
    return true;
}
inline bool takeFace(LineReader& in) {
    return in.take("f") || in.take("fo"); // fo: an old word for the same
}
