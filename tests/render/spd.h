// Scenes of the Standard Procedural Databases (Eric Haines 1987) as NFF text, made again from their
// recursive definitions: truth from outside, for their ray counts are published.
#pragma once

#include <string>

namespace spd {

// 4^(size-1) ... tetrahedra of a Sierpinski pyramid; the standard size is 6.
std::string tetra(int size);
// A sphereflake of (9^(size+1) - 1) / 8 spheres over a square; the standard size is 4.
std::string balls(int size);
// A pyramid of size * (size+1) * (2 size + 1) / 6 knots of six rings each, rods and balls; the
// standard size is 7.
std::string rings(int size);

} // namespace spd
