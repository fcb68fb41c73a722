// Random scenes of the course COMP 557, as JSON in each of its three dialects.
#pragma once

#include <cstdint>
#include <string>

// The same text for the same seed everywhere; seed % 3 is the dialect. Spheres, boxes, meshes,
// nested nodes and instances over a floor that is often checkered, seen from above the floor and
// from outside of everything; lights anywhere outside, now and then below the floor.
std::string randomCourseScene(std::uint32_t seed);
