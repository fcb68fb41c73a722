// PLY (Stanford): ascii, binary little and big endian; vertex positions, normals and texture
// coordinates, faces of any corner count; other elements and properties are skipped.
#pragma once

#include "read/mesh/mesh_file.h"
#include "read/read_context.h"

// Fails with the place: line and column of the header or of ascii data, the byte of binary data.
MeshFile readPly(const SourceFile& source, const ReadContext& context);
