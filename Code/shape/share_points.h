// Corners in one place become one point.
#pragma once

#include "shape/mesh_geometry.h"

// Formats that write each triangle with corners of its own, and programs that do so, have many
// points several times. A leaf of the wide tree has room for so many different points: with shared
// ones it takes up to three times the triangles, of which rays meet the same. Points of the same
// bits are looked for where there are more points than triangles, and some thousands of them say
// that it pays. The same for any number of threads.
void sharePoints(MeshGeometry& mesh, int threads = 1);
