// MeshFile: what a file of triangles says (OBJ, PLY), before it becomes meshes and objects.
#pragma once

#include "desc/scene_desc.h"

#include <cstdint>
#include <string>
#include <vector>

struct MeshFile {
    struct Part { // an object or group of the file: its triangles up to the next part
        std::string name;
        std::uint32_t firstTriangle = 0;
    };
    struct Library { // a file of materials, as the text names it
        std::string file;
        SourceLoc loc;
    };
    // All triangles of the file; triangleMaterials count in `materials` (empty: all use slot 0).
    MeshDesc mesh;
    std::vector<std::string> materials;  // names by slot, in the order of their first use
    std::vector<SourceLoc> materialLocs; // where each is used first
    std::vector<Library> libraries;
    std::vector<Part> parts; // ascending, without empty ones; none when the file names none
};
