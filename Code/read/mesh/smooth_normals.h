// Normals for meshes that come without.
#pragma once

#include "desc/scene_desc.h"

#include <cstdint>
#include <span>

// Replaces the normals of the mesh: at each corner the mean of the normals of the triangles around
// the point, weighted with their angle there (Thürmer and Wüthrich 1998), over those triangles that
// bend less than smoothAngleDeg away from the corner's own. 180: all of them; 0: no normals, flat.
// Around points with more than 512 triangles directions are compared in steps of ten degrees. The
// normals do not depend on the number of threads (0: as many as the machine has).
void smoothByAngle(MeshDesc& mesh, double smoothAngleDeg, int threads = 1);

// The same over the triangles of equal group; group 0 stays flat. groups: one per triangle.
void smoothByGroup(MeshDesc& mesh, std::span<const std::uint32_t> groups, int threads = 1);
