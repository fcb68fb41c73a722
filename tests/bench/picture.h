// A whole picture of a mesh, from its file to a PNG, each step timed.
#pragma once

#include "isa/isa.h"

#include <string>

struct BenchPicture {
    double read = 0, build = 0, render = 0, write = 0; // seconds
};

inline constexpr int kBenchPictureSide = 1024;

// The view and the lights that a mesh file gets (read/mesh/mesh_scene.h), or those of the scene;
// one sample per pixel. The PNG is written to the folder for temporary files and removed.
BenchPicture timePicture(const std::string& file, const Isa& isa, int threads);
