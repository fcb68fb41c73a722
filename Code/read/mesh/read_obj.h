// Wavefront OBJ: v, vt, vn, f (any corner count, concave too, negative indices), o, g, s, usemtl,
// mtllib; line continuation, CRLF, comments. Other statements are skipped and counted.
#pragma once

#include "read/mesh/mesh_file.h"
#include "read/read_context.h"

// Fails with the place of a wrong line, and when nothing is left to show. Faces without area, with
// fewer than three corners and vertices that nothing uses are dropped; one warning says how many of
// each. Faces in a smoothing group (s 1) and without normals of their own get smooth ones.
MeshFile readObj(const SourceFile& source, const ReadContext& context);
