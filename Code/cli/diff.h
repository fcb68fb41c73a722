// `raytracer diff A B`: how far two pictures are apart, for people and for test scripts.
#pragma once

#include "cli/exit_codes.h"
#include "cli/flag.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

struct DiffOptions {
    std::string first, second;
    std::vector<std::string> metrics{"rmse"};
    std::optional<double> tolerance;
    std::string output; // empty: no picture of the differences
    bool help = false;
};

// The table of its options; the setters write into `options`, which must outlive the table.
std::vector<Flag> diffFlags(DiffOptions& options);

// Everything after "diff". Fails with ErrorKind::Usage.
DiffOptions parseDiffOptions(std::span<const std::string> arguments);

// Prints a line "metric value" for each metric; AboveTolerance when the value is worse than --tol.
ExitCode diff(const DiffOptions& options);
