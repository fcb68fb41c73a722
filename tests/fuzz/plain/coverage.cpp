#include "fuzz/plain/coverage.h"

#include <array>
#include <bit>
#include <cstdint>

namespace {

constexpr unsigned kBits =
    16; // places of code share a counter seldom: the readers have about 10000
std::array<std::uint8_t, 1u << kBits> passes;
std::array<std::uint8_t, 1u << kBits> most; // widths in bits of the highest count so far

} // namespace

// Called at every branch of the instrumented code.
extern "C" __attribute__((no_sanitize_coverage, no_sanitize("address", "undefined"))) void
__sanitizer_cov_trace_pc() {
    const auto place = reinterpret_cast<std::uintptr_t>(__builtin_return_address(0));
    // Fibonacci hashing (Knuth, TAOCP 3, 6.4).
    std::uint8_t& count = passes.data()[place * 0x9E3779B97F4A7C15u >> (64 - kBits)];
    if (count != 255) ++count;
}

namespace fuzz {

void startCoverage() { passes.fill(0); }

std::size_t newCoverage() {
    const auto reached = passes; // this function counts itself
    std::size_t found = 0;
    for (std::size_t i = 0; i < reached.size(); ++i) {
        const auto width = static_cast<std::uint8_t>(std::bit_width(reached[i]));
        if (width <= most[i]) continue;
        most[i] = width;
        ++found;
    }
    return found;
}

std::size_t placesCovered() {
    std::size_t count = 0;
    for (const std::uint8_t width : most) count += width > 0;
    return count;
}

} // namespace fuzz
