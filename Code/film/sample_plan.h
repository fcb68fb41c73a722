// SamplePlan: which pixels get more samples, pass by pass, until the error of the picture is small enough.
// Knows what a NoiseMap estimates and numbers of samples, and nothing of what is seen.
//
// Every pass doubles the samples of some groups of pixels: of those whose doubling takes most off the squared
// error of the picture per sample (Dammertz et al. 2010). What is chosen follows from the estimates of whole
// passes alone, so that neither threads nor tiles nor kernels have a say in it.
#pragma once

#include "film/noise_map.h"
#include "scene/settings.h"

#include <cstdint>
#include <vector>

class SamplePlan {
public:
    // Pixels with as many samples each, which get `batch` more; within a block.
    struct Part {
        Tile tile;
        int before, batch;
    };

    explicit SamplePlan(const Refinement& goal) : goal_(goal) {}

    // Returns the parts of the next pass; none: the picture is done.
    std::vector<Part> next(const NoiseMap& noise);
    // The last pass of next() does not take place.
    void cancelPass() { --passes_; }

    // Returns the estimated error of the picture, with the factor that makes it an upper bound in 95 % of all
    // cases; of a goal for the worst block the error that 99 % of the blocks are below.
    double error(const NoiseMap& noise) const;

    // How much of the work is done when the last pass of next() begins and ends, as far as can be told.
    struct Share {
        double begun = 0, done = 0;
    };
    Share share() const { return share_; }
    int passes() const { return passes_; }

    struct Samples {
        int min = 0, max = 0;
        double mean = 0;
        std::uint64_t cappedPixels = 0; // have all that they may have, and an error above the goal
        // Counts blocks where one sample brought a tenth of the light or more, so that others may be missing.
        std::uint64_t unsureBlocks = 0;
    };
    Samples samples(const NoiseMap& noise) const;

private:
    // Groups that are to be doubled now: those whose gain is above the level, and those that must.
    struct Choice {
        int level = 0;
        double foreseen = 0; // samples until the goal is reached
    };
    Choice choose(const NoiseMap& noise, std::span<const NoiseMap::Block> blocks,
                  double upperFactor) const;
    bool isChosen(const NoiseMap::Group& group, const Choice& choice, bool isUnsure) const;
    bool isUnsure(const NoiseMap::Block& block) const;
    int batchOf(const NoiseMap::Group& group) const;
    void addParts(const NoiseMap& noise, const NoiseMap::Block& block, const Choice& choice,
                  std::vector<Part>& parts) const;
    bool hasGoal() const { return goal_.error.has_value(); }
    // Returns the sum of squared errors that pixels of the goal's error have.
    double wantedSquares(double pixels) const { return goal_.error ? sqr(*goal_.error) * 3 * pixels : 0; }
    bool isEven() const { return goal_.evenDoublings > 0; }
    bool isFull(const NoiseMap::Group& group) const { return group.samples >= goal_.mostSamples; }

    Refinement goal_;
    Share share_;
    int passes_ = 0;
};
