// What a render left out, as rows for --stats: how much of what, out of how much, and about how
// long it would have taken.
#pragma once

#include "scene/stats.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

struct SkippedRow {
    std::string name, key, unit; // "rays of empty tiles", "empty_tile_rays", "rays"
    std::uint64_t count = 0;
    std::uint64_t of = 0; // as many there would be in all
    // Seconds of this run, by the mean cost of the rays or samples that were done; none where what
    // was left out is of another kind than these.
    std::optional<double> seconds;

    double share() const {
        return of > 0 ? static_cast<double>(count) / static_cast<double>(of) : 0;
    }
};

// All rows, in a fixed order; many a scene skips nothing of some.
std::vector<SkippedRow> skippedWork(const Stats& stats);
