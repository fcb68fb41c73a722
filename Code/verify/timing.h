// Times for the rows that promise one: always a ratio of two things done in turn on this machine.
#pragma once

#include "base/math.h"
#include "verify/battery.h"

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <vector>

namespace battery {

constexpr Row timed(Row row) {
    row.timed = true;
    return row;
}

// Memory that is freed stays with the program. Where glibc gives its end back to the system as soon
// as that is more than twice the largest block so far, the larger of two works pays for pages at
// each turn, the smaller one for none: 3 % of a scene of 10,000 triangles.
inline void keepFreedMemory() { std::vector<char>(std::size_t{1} << 24); }

// The time of `first` over that of `second`: the median of so many pairs, after one that does not
// count. What is done in a pair is done within milliseconds, by turns in either order, so that a
// machine that becomes slower or faster does so for both; least times would be those of two
// moments, and may be of two clock rates. Processor time of one thread: what else the machine does
// counts only as far as it takes caches away.
template <class First, class Second> double timeRatio(int turns, First&& first, Second&& second) {
    keepFreedMemory();
    const auto ticksOf = [](auto&& work) {
        const std::clock_t start = std::clock();
        work();
        return static_cast<double>(std::clock() - start);
    };
    std::vector<double> ratios;
    for (int i = 0; i <= turns; ++i) {
        const double before = i % 2 == 1 ? ticksOf(second) : 0;
        const double ticks = ticksOf(first);
        ratios.push_back(ticks / max(i % 2 == 1 ? before : ticksOf(second), 1.0));
    }
    ratios.erase(ratios.begin());
    const auto middle = ratios.begin() + turns / 2;
    std::nth_element(ratios.begin(), middle, ratios.end());
    return *middle;
}

} // namespace battery
