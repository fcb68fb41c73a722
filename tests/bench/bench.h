// How fast this machine builds the tree of a mesh, traces rays through it and makes a picture of
// it.
#pragma once

#include "bench/rays.h"

#include <string>

struct BenchOptions {
    std::string mesh;
    std::string kernel = "auto";
    int threads = 1;
    int runs = 5;
    BenchView view = BenchView::Outside;
    bool uv = false;
    bool picture = true;
    std::string raysFile; // written instead of measuring; empty: none
    bool help = false;
};

// Prints comma-separated lines: one for the build, one or two for each set of rays, one for a whole
// picture. Fails with Error.
void bench(const BenchOptions& options);
