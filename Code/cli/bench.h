// `raytracer bench`: how fast this machine builds the tree of a mesh, traces rays through it and
// makes a picture of it.
#pragma once

#include "cli/bench_rays.h"
#include "cli/exit_codes.h"
#include "cli/flag.h"

#include <span>
#include <string>
#include <vector>

struct BenchOptions {
    std::string mesh;
    std::string kernel = "auto";
    int threads = 1;
    int runs = 5;
    BenchView view = BenchView::Outside;
    bool bestTree = false;
    bool uv = false;
    bool picture = true;
    std::string raysFile; // written instead of measuring; empty: none
    bool help = false;
};

// The table of its options; the setters write into `options`, which must outlive the table.
std::vector<Flag> benchFlags(BenchOptions& options);

// Everything after "bench". Fails with ErrorKind::Usage.
BenchOptions parseBenchOptions(std::span<const std::string> arguments);

// Prints comma-separated lines: one for the build, one or two for each set of rays, one for a whole
// picture.
ExitCode bench(const BenchOptions& options);
