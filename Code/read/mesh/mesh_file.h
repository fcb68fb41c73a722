// MeshFile: what a file of triangles says (OBJ, PLY), before it becomes meshes and objects.
#pragma once

#include "desc/scene_desc.h"

#include <cstdint>
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
