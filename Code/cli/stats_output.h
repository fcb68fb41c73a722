// The counters of a render as a table for people and as JSON for programs.
#pragma once

#include "scene/stats.h"

#include <string>
#include <vector>

struct PictureSize {
    int width = 0, height = 0;
};

// What was rendered and how it was called, for programs that gather the counters of many renders.
struct RunFacts {
    std::string scene, output;
    PictureSize size; // of the picture that was written
    std::vector<std::string> arguments;
};

// "12.5 MiB"
std::string mebibytes(std::uint64_t bytes);

std::string statsTable(const Stats& stats);

// One object on one line; scripts rely on its keys, which tests/unit/test_stats_output.cpp lists
// (error_estimate, error_goal and capped_pixels only with --error, error_estimate_denoised only with
// --denoise). Numbers that are not finite
// become null.
std::string statsJson(const Stats& stats, const RunFacts& run);
