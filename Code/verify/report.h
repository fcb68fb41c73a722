// The battery's findings as text.
#pragma once

#include "verify/battery.h"

#include <string>

namespace battery {

// One line: id, what, how many cases, the worst, the mark, "ok" or "FAILED", and under a failure
// the case that shows it.
std::string reportHeading();
std::string reportLine(const Row& row, const Tally& tally, double seconds);

// The whole table for a page, with what was measured of other programs.
struct Finding {
    Row row;
    Tally tally;
};
std::string markdownTable(std::span<const Finding> findings);

} // namespace battery
