// Measuring for `bench`: seconds by the wall clock and of the processor, over some runs.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

struct BenchSeconds {
    double wall = 0;
    double cpu = 0; // of all threads together
};

template <class Body> BenchSeconds secondsOf(Body&& body) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    body();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(),
            static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC};
}

inline double medianOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}
