// MeshFile: what a file of triangles says (OBJ, PLY), before it becomes meshes and objects.
#pragma once

#include "desc/scene_desc.h"
#include "read/mesh/read_mtl.h"
#include "read/read_context.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

struct MeshFile {
    struct Part {         // an object or group of the file: its triangles up to the next part
        std::string name; // empty for what comes before the first name
        std::uint32_t firstTriangle = 0;
        SourceLoc loc;
    };
    struct Library { // a file of materials, as the text names it, with / for the backslashes
        std::string file;
        SourceLoc loc;
    };
    // All triangles of the file; triangleMaterials count in `materials` (empty: all use slot 0).
    MeshDesc mesh;
    // Names by slot, in the order of their first use; an empty one for the triangles that come
    // before the first name. None when the file names none.
    std::vector<std::string> materials;
    std::vector<SourceLoc> materialLocs; // where each is used first
    std::vector<Library> libraries;
    std::vector<Part> parts; // ascending from triangle 0, none empty; none when none are named
};

// Wavefront OBJ: v, vt, vn, f (any corner count, concave too, negative indices), o, g, s, usemtl,
// mtllib; line continuation, CRLF, comments. Other statements are skipped and counted.
// Fails with the place of a wrong line, and when nothing is left to show. Faces without area, with
// fewer than three corners and vertices that nothing uses are dropped; one warning says how many of
// each. Faces in a smoothing group (s 1) and without normals of their own get smooth ones.
MeshFile readObj(const SourceFile& source, const ReadContext& context);

// PLY (Stanford): ascii, binary little and big endian; vertex positions, normals and texture
// coordinates, faces of any corner count; other elements and properties are skipped.
// Fails with the place: line and column of the header or of ascii data, the byte of binary data.
MeshFile readPly(const SourceFile& source, const ReadContext& context);

// A scene around a file of triangles, for `raytracer bunny.obj`: its parts as objects with the
// materials of its libraries, and a camera and lights that show all of it. +Y is up, as in most of
// these files; the camera looks from the front, a little from the right and from above.

// `libraries`: the materials of file.libraries in their order; one that could not be read is empty.
// Materials that none of them has are grey, with a warning. Textures keep their names; their `file`
// is what the libraries say. Places (loc) are in `source`: a material's is where it is used first.
SceneDesc sceneAround(MeshFile file, std::span<const MtlFile> libraries, const SourceFile& source,
                      const ReadContext& context);
