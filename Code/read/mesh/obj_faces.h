// Faces of an OBJ file where it has nothing but vertices and faces.
#pragma once

#include "read/mesh/mesh_builder.h"
#include "read/mesh/obj_chunks.h"

struct FacesLeftOut {
    Counted tooFewCorners, noArea;
    // What happened behind it.
    void add(const FacesLeftOut& later) {
        tooFewCorners.add(later.tooFewCorners);
        noArea.add(later.noArea);
    }
};

// Those of a plain chunk, for a builder that knows the points of the file; `total` are its
// vertices.
FacesLeftOut readPlainFaces(const SourceFile& source, const ObjChunk& chunk, const ObjCounts& total,
                            MeshBuilder& to);
