// `raytracer bench`: how fast this machine builds the tree of a mesh and traces rays through it.
#pragma once

#include "cli/exit_codes.h"
#include "cli/flag.h"

#include <span>
#include <string>
#include <vector>

struct BenchOptions {
    std::string mesh;
    std::string kernel = "auto";
    int runs = 5;
    bool help = false;
};

// The table of its options; the setters write into `options`, which must outlive the table.
std::vector<Flag> benchFlags(BenchOptions& options);

// Everything after "bench". Fails with ErrorKind::Usage.
BenchOptions parseBenchOptions(std::span<const std::string> arguments);

// Prints comma-separated lines, one for the build and one for each set of rays.
ExitCode bench(const BenchOptions& options);
