#include "film/adaptive_film.h"

#include "base/math.h"
#include "base/parallel.h"

#include <cmath>

AdaptiveFilm::AdaptiveFilm(const Tile& area, const RenderSettings& settings, const FilmUnits& units)
    : area_(area), goal_(*settings.refinement),
      measure_(goal_.unit, exact::exp2(settings.picture.exposureEv), settings.picture.transfer),
      noise_(area, measure_), plan_(goal_), aovs_(settings.aovs.size()) {
    color_.reset(area.width(), area.height(), units.color);
    for (std::size_t a = 0; a < aovs_.size(); ++a)
        aovs_[a].reset(area.width(), area.height(), units.aovs[a]);
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
    for (std::size_t a = 0; a < aovs_.size(); ++a) aovs_[a].add(aovs[a], x, y);
}

Image AdaptiveFilm::error() const {
    Image image(area_.width(), area_.height());
    for (int y = 0; y < area_.height(); ++y)
        for (int x = 0; x < area_.width(); ++x) {
            const double squares = noise_.boundSquaresAt(x + area_.x0, y + area_.y0);
            const auto error = static_cast<float>(std::sqrt(squares / 3));
            image.setPixel(x, y, {error, error, error});
        }
    return image;
}

void AdaptiveFilm::describe(Stats& stats) const {
    const SamplePlan::Samples samples = plan_.samples(noise_);
    stats.samplesMin = samples.min;
    stats.samplesMax = samples.max;
    stats.samplesMean = samples.mean;
    stats.error = ErrorStats{.goal = goal_.error,
                             .unit = goal_.unit,
                             .ofWorstBlock = goal_.ofWorstBlock,
                             .estimate = plan_.error(noise_),
                             .passes = plan_.passes(),
                             .mostSamples = goal_.mostSamples,
                             .cappedPixels = samples.cappedPixels,
                             .unsureBlocks = samples.unsureBlocks};
}
