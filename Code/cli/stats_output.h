// The counters of a render as a table for people and as JSON for programs.
#pragma once

#include "render/stats.h"

#include <string>

std::string statsTable(const Stats& stats);

// One object on one line, with the keys of DESIGN.md section 3 (error_estimate: there is none
// without --error). Numbers that are not finite become null.
std::string statsJson(const Stats& stats);

// The most memory that the process has used so far.
std::uint64_t peakBytes();
