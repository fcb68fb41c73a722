#include "cli/skipped_work.h"

#include "render/camera_rays.h"

#include <algorithm>
#include <cmath>

namespace {

// What one of the things that were left out would have cost.
enum class Cost { Unknown, Ray, Sample };

struct Rule {
    const char *name, *key, *unit;
    Cost cost;
    std::uint64_t (*count)(const Stats&);
    std::uint64_t (*done)(const Stats&); // of the same things
};

// Returns how many more samples there would be, with an error goal, if all places had as many as the one
// with most.
std::uint64_t samplesOfSettled(const Stats& s) {
    if (!s.error || !(s.samplesMean > 0)) return 0;
    const double places = static_cast<double>(s.rays.camera) / s.samplesMean;
    return static_cast<std::uint64_t>(
        std::llround(places * std::max(0.0, s.samplesMax - s.samplesMean)));
}

constexpr Rule kRules[] = {
    {"rays of empty tiles", "empty_tile_rays", "rays", Cost::Unknown,
     [](const Stats& s) { return s.rays.skipped.emptyTileRays; },
     [](const Stats& s) { return s.rays.camera - s.rays.skipped.emptyTileRays; }},
    {"settled samples", "settled_samples", "samples", Cost::Sample, samplesOfSettled,
     [](const Stats& s) { return s.rays.camera; }},
    {"numbers of camera rays", "ray_numbers", "random numbers", Cost::Unknown,
     [](const Stats& s) { return s.rays.skipped.rayNumbers; },
     [](const Stats& s) {
         return CameraRays::kNumbers * (s.rays.camera - s.rays.skipped.emptyTileRays) -
                s.rays.skipped.rayNumbers;
     }},
    {"unshaded points", "unshaded_points", "points", Cost::Unknown,
     [](const Stats& s) { return s.rays.skipped.unshadedPoints; },
     [](const Stats& s) { return s.rays.points - s.rays.skipped.unshadedPoints; }},
    {"unlit samples of lamps", "unlit_samples", "shadow rays", Cost::Ray,
     [](const Stats& s) { return s.rays.skipped.unlitSamples; },
     [](const Stats& s) { return s.rays.shadow; }},
    {"lamps without shadows", "open_lamps", "shadow rays", Cost::Ray,
     [](const Stats& s) { return s.rays.shadow - s.rays.tracedShadow; },
     [](const Stats& s) { return s.rays.tracedShadow; }},
    {"rays below the cutoff", "weak_rays", "rays", Cost::Ray,
     [](const Stats& s) { return s.rays.skipped.weakRays; },
     [](const Stats& s) { return s.rays.reflect + s.rays.refract + s.rays.indirect; }},
    {"paths ended by roulette", "ended_paths", "rays", Cost::Ray,
     [](const Stats& s) { return s.rays.skipped.endedPaths; },
     [](const Stats& s) { return s.rays.reflect + s.rays.refract + s.rays.indirect; }},
    {"rays of two lobes", "shared_rays", "rays", Cost::Ray,
     [](const Stats& s) { return s.rays.skipped.sharedRays; },
     [](const Stats& s) { return s.rays.reflect + s.rays.refract + s.rays.indirect; }},
    {"pictures not read", "unread_picture_bytes", "bytes", Cost::Unknown,
     [](const Stats& s) { return s.unreadPictureBytes; },
     [](const Stats& s) { return s.readPictureBytes; }},
    {"mip levels not made", "unmade_mip_bytes", "bytes", Cost::Unknown,
     [](const Stats& s) { return s.unmadeMipBytes; }, [](const Stats& s) { return s.mipBytes; }},
};

// Seconds of rendering for each ray or sample that was done.
std::optional<double> secondsEach(Cost cost, const Stats& s) {
    const std::uint64_t done = cost == Cost::Ray ? s.rays.total() : s.rays.camera;
    if (cost == Cost::Unknown || done == 0) return {};
    return s.renderSeconds / static_cast<double>(done);
}

} // namespace

std::vector<SkippedRow> skippedWork(const Stats& stats) {
    std::vector<SkippedRow> rows;
    for (const Rule& rule : kRules) {
        const std::uint64_t count = rule.count(stats);
        SkippedRow row{rule.name, rule.key, rule.unit, count, count + rule.done(stats), {}};
        if (const auto each = secondsEach(rule.cost, stats))
            row.seconds = *each * static_cast<double>(count);
        rows.push_back(row);
    }
    return rows;
}
