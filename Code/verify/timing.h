// Times for the rows that promise one: always a ratio of two things done in turn on this machine.
#pragma once

#include "base/math.h"
#include "verify/battery.h"

#include <ctime>

namespace battery {

constexpr Row timed(Row row) {
    row.timed = true;
    return row;
}

// Least time of `first` over least time of `second` in so many turns. Processor time of one thread:
// what else the machine does counts only as far as it takes caches away.
template <class First, class Second> double timeRatio(int turns, First&& first, Second&& second) {
    const auto ticksOf = [](auto&& work) {
        const std::clock_t start = std::clock();
        work();
        return static_cast<double>(std::clock() - start);
    };
    double least[2] = {kInfinity, kInfinity};
    for (int i = 0; i < turns; ++i) {
        least[0] = min(ticksOf(first), least[0]);
        least[1] = min(ticksOf(second), least[1]);
    }
    return least[0] / max(least[1], 1.0);
}

} // namespace battery
