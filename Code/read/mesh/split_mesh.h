// The parts of a mesh file as meshes of their own.
#pragma once

#include "read/mesh/mesh_file.h"

#include <cstdint>
#include <vector>

struct SeparatePart {
    MeshDesc mesh; // named as its part; triangleMaterials count in `slots`
    std::vector<std::uint32_t>
        slots; // which of MeshFile::materials it uses, none when there are none
};
// In the order of the file. One part takes the arrays as they are; several take only what they use.
std::vector<SeparatePart> splitMesh(MeshFile file);
