#include "film/adaptive_film.h"

#include "base/math.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace {

// Writes half the differences of what a part of the picture has and what it gets, which begins at (x0, y0).
void addDifference(const Film& before, const Film& batch, int x0, int y0, Image& to) {
    for (int y = 0; y < batch.height(); ++y)
        for (int x = 0; x < batch.width(); ++x) {
            const Vec3 half = toFloat(Film::halfDifference(before.at(x0 + x, y0 + y), batch.at(x, y),
                                                           before.perUnit()));
            to.setPixel(x0 + x, y0 + y, {half.x, half.y, half.z});
        }
}

} // namespace

AdaptiveFilm::AdaptiveFilm(const Tile& area, const RenderSettings& settings, const FilmUnits& units)
    : area_(area), goal_(*settings.refinement),
      measure_(goal_.unit, exact::exp2(settings.picture.exposureEv), settings.picture.transfer),
      noise_(area, measure_), plan_(goal_), aovs_(settings.aovs.size()) {
    color_.reset(area.width(), area.height(), units.color);
    for (std::size_t a = 0; a < aovs_.size(); ++a) {
        aovs_[a].reset(area.width(), area.height(), units.aovs[a]);
        if (settings.picture.denoise) aovDifferences_.emplace_back(area.width(), area.height());
    }
}

void AdaptiveFilm::setLeast(int column, int row, int samples) {
    const int x = std::max(column * NoiseMap::kGroupSide, area_.x0);
    const int y = std::max(row * NoiseMap::kGroupSide, area_.y0);
    if (x < area_.x1 && y < area_.y1 && (column + 1) * NoiseMap::kGroupSide > area_.x0 &&
        (row + 1) * NoiseMap::kGroupSide > area_.y0)
        noise_.setLeast(x, y, std::max(samples, Refinement::kFirstSamples));
}

std::vector<SamplePlan::Part> AdaptiveFilm::nextPass(ThreadPool& pool) {
    // A block is changed by its parts, which follow each other.
    std::vector<std::size_t> changed;
    for (const SamplePlan::Part& part : parts_) {
        const std::size_t block = noise_.blockAt(part.tile.x0, part.tile.y0);
        if (changed.empty() || changed.back() != block) changed.push_back(block);
    }
    const auto update = [&](std::size_t i, int) { noise_.update(changed[i], color_); };
    pool.run(changed.size(), update);
    parts_ = plan_.next(noise_);
    return parts_;
}

void AdaptiveFilm::add(const SamplePlan::Part& part, const Film& color, float largest,
                       const std::vector<Film>& aovs) {
    noise_.add(part.tile, part.batch, color_, color, largest);
    const int x = part.tile.x0 - area_.x0, y = part.tile.y0 - area_.y0;
    color_.add(color, x, y);
    for (std::size_t a = 0; a < aovs_.size(); ++a) {
        if (!aovDifferences_.empty()) addDifference(aovs_[a], aovs[a], x, y, aovDifferences_[a]);
        aovs_[a].add(aovs[a], x, y);
    }
}

bool AdaptiveFilm::showsNoise() const {
    const auto blocks = noise_.blocks();
    return std::all_of(blocks.begin(), blocks.end(),
                       [](const NoiseMap::Block& b) { return b.squares < kInfinity; });
}

Image AdaptiveFilm::difference() const {
    return imageOf([&](int x, int y) {
        const Vec3 d = noise_.differenceAt(x, y);
        return Rgb{d.x, d.y, d.z};
    });
}

Image AdaptiveFilm::pastDifferences() const {
    constexpr double kIndependent = 4; // so much greater is the square where samples know nothing of each other
    return imageOf([&](int x, int y) {
        const NoiseMap::Group& g = noise_.group(x, y);
        const double now = g.halves[0], before = g.doublings < 3 ? kIndependent * now : g.halves[2];
        return Rgb{static_cast<float>(now / g.pixels), static_cast<float>(before / g.pixels), 0};
    });
}

Image AdaptiveFilm::error() const {
    return imageOf([&](int x, int y) {
        const auto error = static_cast<float>(std::sqrt(noise_.boundSquaresAt(x, y) / 3));
        return Rgb{error, error, error};
    });
}

void AdaptiveFilm::describe(Stats& stats) const {
    const SamplePlan::Samples samples = plan_.samples(noise_);
    stats.samplesMin = samples.min;
    stats.samplesMax = samples.max;
    stats.samplesMean = samples.mean;
    if (goal_.evenDoublings > 0) return;
    stats.error = ErrorStats{.goal = goal_.error,
                             .unit = goal_.unit,
                             .ofWorstBlock = goal_.ofWorstBlock,
                             .estimate = plan_.error(noise_),
                             .passes = plan_.passes(),
                             .mostSamples = goal_.mostSamples,
                             .cappedPixels = samples.cappedPixels,
                             .unsureBlocks = samples.unsureBlocks};
}
