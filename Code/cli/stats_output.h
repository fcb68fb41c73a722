// The counters of a render as a table for people and as JSON for programs.
#pragma once

#include "render/stats.h"

#include <string>

std::string statsTable(const Stats& stats);

// One object on one line; scripts rely on its keys, which tests/unit/test_stats_output.cpp lists
// (error_estimate, error_goal and capped_pixels only with --error). Numbers that are not finite
// become null.
std::string statsJson(const Stats& stats);

// Three digits that count: "0.00594".
std::string significant(double value);
