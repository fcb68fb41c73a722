// AdaptiveFilm: the samples of a whole picture that grows pass by pass, and where the next ones go. Knows
// nothing of how samples are made.
#pragma once

#include "film/film.h"
#include "film/film_units.h"
#include "film/noise_map.h"
#include "film/sample_plan.h"
#include "image/image.h"
#include "scene/stats.h"

#include <vector>

class ThreadPool;

class AdaptiveFilm {
public:
    // `area`: of the picture, in pixels; `settings` have a refinement.
    AdaptiveFilm(const Tile& area, const RenderSettings& settings, const FilmUnits& units);
    AdaptiveFilm(const AdaptiveFilm&) = delete;
    AdaptiveFilm& operator=(const AdaptiveFilm&) = delete;

    // The group of 4 x 4 pixels at this column and row of the picture gets at least so many samples.
    void setLeast(int column, int row, int samples);

    // Returns the parts of the picture that get samples now; none: it is done. All parts of the pass before
    // have been added.
    std::vector<SamplePlan::Part> nextPass(ThreadPool& pool);
    // The pass is not rendered: the clock has ended the picture.
    void cancelPass() { plan_.cancelPass(), parts_.clear(); }
    SamplePlan::Share share() const { return plan_.share(); }

    // Takes the batch of a part of the pass. Parts may come from several threads at once.
    void add(const SamplePlan::Part& part, const Film& color, float largest,
             const std::vector<Film>& aovs);

    const Film& color() const { return color_; }
    const Film& aov(std::size_t number) const { return aovs_[number]; }
    // Whether all pixels have had a doubling, which shows their noise.
    bool showsNoise() const;
    // Return half the difference of the samples of each pixel before its latest doubling and those that it brought,
    // of the colour and of an AOV: NoiseMap says what it means.
    Image difference() const;
    Image& aovDifference(std::size_t number) { return aovDifferences_[number]; }
    // Returns the mean square of that difference around each pixel, now in r, and two doublings before in g.
    Image pastDifferences() const;
    // Returns the upper bound of the error of each pixel, RMS over its channels, in all of them.
    Image error() const;
    void describe(Stats& stats) const;

private:
    template <class Fn> Image imageOf(const Fn& fn) const {
        Image image(area_.width(), area_.height());
        for (int y = 0; y < area_.height(); ++y)
            for (int x = 0; x < area_.width(); ++x)
                image.setPixel(x, y, fn(x + area_.x0, y + area_.y0));
        return image;
    }

    Tile area_;
    Refinement goal_;
    ErrorMeasure measure_;
    NoiseMap noise_;
    SamplePlan plan_;
    std::vector<SamplePlan::Part> parts_; // of the pass
    Film color_;
    std::vector<Film> aovs_;
    std::vector<Image> aovDifferences_;
};
