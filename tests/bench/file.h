// A mesh and the ray sets of `bench` in a file, so that other programs can trace the same
// rays through the same triangles (tests/bench/peer_input.h reads it). In the space of the
// mesh's file, `frame` taken back: another program would have met the mesh there.
#pragma once

#include "bench/rays.h"
#include "scene/frame.h"

#include <cstdint>
#include <span>
#include <vector>

// Words of 4 bytes, the lowest first: whole numbers, and floats as their bits.
//   "RTRAYS01"                                  8 bytes
//   points, triangles, sets                     whole numbers
//   x y z of each point                         floats
//   the three points of each triangle           whole numbers from 0
//   of each set: its name                       16 bytes, filled with zeros
//     rays, 1 for any hit or 0 for the nearest  whole numbers
//     origin, tMin, direction, tMax of each     8 floats
std::vector<std::uint8_t> encodeBenchFile(const MeshGeometry& geometry, const SceneFrame& frame,
                                          std::span<const BenchRays> sets);
