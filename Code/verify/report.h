// The battery's findings as text.
#pragma once

#include "verify/battery.h"

#include <span>
#include <string>
#include <string_view>

namespace battery {

// One line: id, what, how many cases, the worst, the mark, "ok" or "FAILED", and under a failure
// the case that shows it.
std::string reportHeading();
std::string reportLine(const Row& row, const Tally& tally, double seconds);

// A page: how to read it and to repeat a case, the table with what was measured of other programs,
// and the worst cases.
struct Finding {
    Row row;
    Tally tally;
};
std::string markdownPage(std::span<const Finding> findings, std::string_view version,
                         double effort);

} // namespace battery
