#include "film/goal_film.h"

#include "base/math.h"

namespace {

// Enough pixels for a wave of rays when each gets few samples.
constexpr int kLongestPart = 64;

} // namespace

GoalFilm::GoalFilm(int width, int height, const RenderSettings& settings, const FilmUnits& units)
    : width_(width), height_(height), goal_(*settings.errorGoal),
      exposure_(exact::exp2(settings.picture.exposureEv)), plan_(width, height, goal_),
      aovs_(settings.aovs.size()) {
    color_.reset(width, height, units.color);
    for (std::size_t a = 0; a < aovs_.size(); ++a) aovs_[a].reset(width, height, units.aovs[a]);
}

std::vector<Tile> GoalFilm::nextRound() { return plan_.nextRound(kLongestPart); }

// Two means of independent samples of one thing, a and b of them, are apart by (1/a + 1/b) of its
// variance in the mean of the square; the mean of all is wrong by 1/(a + b) of it. Samples that are
// spread together are less wrong than that, for each batch fills the gaps of the others.
double GoalFilm::squaredError(const Film::Place& before, const Film::Place& more) const {
    if (before.count == 0 || more.count == 0) return 0; // no sample was finite
    const double a = before.count, b = more.count, exposure = exposure_ / color_.perUnit();
    const Vec3d was = before.sum.value(), is = more.sum.value();
    const auto apart = [&](double sumBefore, double sumMore) {
        const double p = sumBefore / a * exposure, q = sumMore / b * exposure;
        return sqr(min(p, goal_.white) - min(q, goal_.white));
    };
    return (apart(was.x, is.x) + apart(was.y, is.y) + apart(was.z, is.z)) * (a * b) / sqr(a + b);
}

void GoalFilm::add(const Tile& part, const Film& color, const std::vector<Film>& aovs) {
    plan_.add(part, [&](int x, int y) {
        return squaredError(color_.at(x, y), color.at(x - part.x0, y - part.y0));
    });
    color_.add(color, part.x0, part.y0);
    for (std::size_t a = 0; a < aovs_.size(); ++a) aovs_[a].add(aovs[a], part.x0, part.y0);
}

Image GoalFilm::error() const {
    Image image(width_, height_);
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            const float error = static_cast<float>(plan_.errorAt(x, y));
            image.setPixel(x, y, {error, error, error});
        }
    return image;
}

void GoalFilm::describe(Stats& stats) const {
    const ErrorPlan::Samples samples = plan_.samples();
    stats.samplesMin = samples.min;
    stats.samplesMax = samples.max;
    stats.samplesMean = samples.mean;
    stats.error = {goal_.rmse, plan_.error(), goal_.mostSamples, samples.cappedPixels};
}
