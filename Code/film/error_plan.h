// ErrorPlan: which parts of a picture need more samples, until its error is below what was asked
// for. Knows estimates of errors and numbers of samples, and nothing of what is seen.
//
// The picture is divided into blocks, and the samples of a block double or stay, round by round.
// Every doubling measures the error anew: the samples before it and those that it adds are two
// pictures of the same thing (Dammertz et al. 2010). Those blocks are chosen whose doubling takes
// most off the error of the picture per sample. What is chosen follows from the estimates of whole
// rounds alone, so that no thread, tile or kernel has a say in it.
#pragma once

#include "base/math.h"
#include "film/tile.h"
#include "scene/settings.h"

#include <algorithm>
#include <cstdint>
#include <vector>

class ErrorPlan {
public:
    // Of a block, in pixels; the last ones of rows and columns may be smaller. An edge in the
    // picture goes through few pixels; a block of few knows little of its error.
    static constexpr int kSide = 4;

    ErrorPlan(int width, int height, const ErrorGoal& goal);

    // Rows of blocks that have the same number of samples and get batchOf() more, none longer than
    // `longest` pixels. None at all: it is done.
    std::vector<Tile> nextRound(int longest);

    // Samples per pixel of a part of the round: what it has, and what it gets.
    int samplesOf(const Tile& part) const { return block(part.x0, part.y0).samples; }
    int batchOf(const Tile& part) const { return batchAfter(samplesOf(part)); }

    // A part of the round has got its batch: squares(x, y) is the squared error of a pixel that
    // this shows, summed over the channels. Several threads may tell of several parts at once.
    template <class Squares> void add(const Tile& part, const Squares& squares) {
        const int batch = batchOf(part);
        for (int y = part.y0; y < part.y1; y += kSide)
            for (int x = part.x0; x < part.x1; x += kSide) {
                double sum = 0;
                for (int j = y; j < std::min(y + kSide, part.y1); ++j)
                    for (int i = x; i < std::min(x + kSide, part.x1); ++i) sum += squares(i, j);
                addBatch(block(x, y), batch, sum);
            }
    }

    // RMSE over pixels and channels, estimated: of the picture, and of the block of a pixel.
    // As of the last nextRound().
    double error() const;
    double errorAt(int x, int y) const;

    // How much of the work is done when this round begins and ends, as far as can be told.
    struct Share {
        double begun = 0, done = 0;
    };
    Share share() const { return share_; }

    struct Samples {
        int min = 0, max = 0;
        double mean = 0;
        std::uint64_t cappedPixels = 0; // have all that they may have, and an error above the goal
    };
    Samples samples() const;

private:
    struct Block {
        int samples = 0;             // per pixel
        int pixels = 0;              // as many as it covers
        double squares = kInfinity;  // sum of the squared errors, by what the block has seen
        double expected = kInfinity; // the same, by what its neighbours have seen too

        double perSample() const { return expected / pixels / samples; }
        double cost() const { return static_cast<double>(samples) * pixels; }
    };

    int batchAfter(int samples) const;
    static void addBatch(Block& block, int batch, double squares);
    void askNeighbours();
    bool isFull(const Block& block) const { return block.samples >= goal_.mostSamples; }
    // Its error will be above the goal with the most samples.
    bool isHopeless(const Block& block) const;
    // What errors of the goal's size come to in so many pixels.
    double wantedSquares(double pixels) const { return sqr(goal_.rmse) * 3 * pixels; }
    int chooseStep();
    bool isChosen(const Block& block, int step) const;

    const Block& block(int x, int y) const { return blocks_[indexOf(x, y)]; }
    Block& block(int x, int y) { return blocks_[indexOf(x, y)]; }
    std::size_t indexOf(int x, int y) const {
        return static_cast<std::size_t>(y / kSide) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(x / kSide);
    }

    int width_, height_, columns_, rows_;
    ErrorGoal goal_;
    std::vector<Block> blocks_;
    Share share_;
};
