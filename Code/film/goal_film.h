// GoalFilm: the samples of a whole picture that is rendered until its error is small enough, and
// the plan of where the next ones go. The pictures of every round are compared with what there was
// before. Knows nothing of how samples are made.
#pragma once

#include "film/error_plan.h"
#include "film/film.h"
#include "film/film_units.h"
#include "image/image.h"
#include "scene/stats.h"

#include <vector>

class GoalFilm {
public:
    // `settings` has an error goal.
    GoalFilm(int width, int height, const RenderSettings& settings, const FilmUnits& units);

    // Parts of the picture that get samples now; none: it is done.
    std::vector<Tile> nextRound();
    int samplesOf(const Tile& part) const { return plan_.samplesOf(part); }
    int batchOf(const Tile& part) const { return plan_.batchOf(part); }
    ErrorPlan::Share share() const { return plan_.share(); }

    // The next batch of a part of the round. Parts may come from several threads at once.
    void add(const Tile& part, const Film& color, const std::vector<Film>& aovs);

    const Film& color() const { return color_; }
    const Film& aov(std::size_t number) const { return aovs_[number]; }
    // The error that is estimated around each pixel, in all channels.
    Image error() const;
    void describe(Stats& stats) const;

private:
    double squaredError(const Film::Place& before, const Film::Place& more) const;

    int width_, height_;
    ErrorGoal goal_;
    double exposure_; // a factor
    ErrorPlan plan_;
    Film color_;
    std::vector<Film> aovs_;
};
