#include "film/sample_plan.h"

#include <array>
#include <cmath>

namespace {

using Group = NoiseMap::Group;
using Block = NoiseMap::Block;

// Passes end when the foreseen error is this part of the goal.
constexpr double kAim = 0.95;
// Where the clock ends the picture, a pass adds this part of the samples that there are.
constexpr double kShortPass = 0.25;
// Blocks whose light comes by single samples get so many at least. A mirror image of a lamp that one pixel alone sees is
// not known from light that all of them lack, and no number of samples is certain to tell.
constexpr int kSamplesToBeSure = 4 * Refinement::kFirstSamples;
// A job of more samples than these is cut into rows of groups, so that all threads have work.
constexpr double kSamplesOfJob = 1 << 16;
// One block of 100 may be worse than what a goal for the worst block says.
constexpr std::size_t kBlocksPerWorse = 100;

// Gains are sorted into steps of a quarter of an octave, and chosen by whole steps.
constexpr int kStepsPerOctave = 4;
constexpr int kSteps = 1024;
constexpr int kLeastExponent = -160;
// What is foreseen: samples that are well spread at an edge leave 0.35 of the squared error when they double
// (Mitchell 1996). Then half as much as that is left to gain per sample, 2 / 0.35 = 2^2.5.
constexpr double kLeftByDoubling = 0.35;
constexpr int kFall = 10;

int stepOf(double gain) {
    if (!(gain > 0)) return 0;
    int exponent = 0;
    const double mantissa = std::frexp(gain, &exponent); // from [0.5, 1)
    const double octave = exponent - kLeastExponent + (2 * mantissa - 1);
    return static_cast<int>(clamp(octave * kStepsPerOctave, 0.0, kSteps - 1.0));
}

double costOf(const Group& g) { return static_cast<double>(g.samples) * g.pixels; }
double gainOf(const Group& g) { return g.squares / costOf(g); }

double upperFactorOf(std::span<const Block> blocks) {
    double squares = 0, fourth = 0;
    for (const Block& b : blocks) squares += b.ownSquares, fourth += b.ownFourth;
    return NoiseMap::upperFactor(squares, fourth);
}
double boundOf(const Block& b) {
    return std::sqrt(b.squares / (3 * b.pixels)) *
           NoiseMap::upperFactor(b.ownSquares, b.ownFourth);
}

} // namespace

// The first samples come in doublings too. A pass of one sample is what a picture has at least when its time
// is over.
int SamplePlan::batchOf(const Group& g) const {
    for (int left = goal_.evenDoublings; left > 0; --left)
        if (const int wanted = goal_.mostSamples >> left; wanted > g.samples) return wanted - g.samples;
    if (isEven()) return goal_.mostSamples - g.samples;
    const int first = goal_.hasShortPasses() ? 1 : std::min(Refinement::kFirstSamples, goal_.mostSamples) / 2;
    return std::min(g.samples == 0 ? first : g.samples, goal_.mostSamples - g.samples);
}

double SamplePlan::error(const NoiseMap& noise) const {
    if (goal_.ofWorstBlock) {
        std::vector<double> bounds;
        for (const Block& b : noise.blocks()) bounds.push_back(boundOf(b));
        const auto worse = bounds.begin() + static_cast<std::ptrdiff_t>(bounds.size() / kBlocksPerWorse);
        std::nth_element(bounds.begin(), worse, bounds.end(), std::greater<>());
        return *worse;
    }
    double squares = 0;
    for (const Block& b : noise.blocks()) squares += b.squares;
    return std::sqrt(squares / (3 * noise.pixels())) * upperFactorOf(noise.blocks());
}

bool SamplePlan::isUnsure(const Block& b) const {
    return goal_.error && b.spike > *goal_.error;
}

bool SamplePlan::isChosen(const Group& g, const Choice& choice, bool isUnsureBlock) const {
    if (isFull(g)) return false;
    if (isEven()) return true;
    if (g.samples < g.least || (isUnsureBlock && g.samples < kSamplesToBeSure)) return true;
    return (g.squares > 0 && stepOf(gainOf(g)) > choice.level);
}

// Goes down the steps, doubling what is there, until what is left is small enough; groups above the step
// where this ends are worth a doubling now. Foresees the work on the way. Without a goal, or where the time is
// short, it ends when a pass has enough to do.
SamplePlan::Choice SamplePlan::choose(const NoiseMap& noise, std::span<const Block> blocks,
                                      double upperFactor) const {
    std::array<double, kSteps> squares{}, cost{}, now{};
    double left = 0, done = 0, pixels = 0, told = 0;
    for (const Block& b : blocks) {
        pixels += b.pixels;
        noise.forEachGroup(b.area, [&](const Group& g, const Tile&) {
            // Errors that nothing can be done about are no reason to work on the others.
            const double most = isFull(g) ? wantedSquares(g.pixels) : kInfinity;
            done += costOf(g), left += min(g.squares, most), told += min(g.told, most);
            if (isFull(g) || !(g.squares > 0) || !(g.squares < kInfinity)) return;
            const auto step = static_cast<std::size_t>(stepOf(gainOf(g)));
            squares[step] += g.squares;
            cost[step] += costOf(g), now[step] += costOf(g);
        });
    }
    // What decides is too low by chance where it was low, so the goal is as much lower.
    const double goal = wantedSquares(pixels) / sqr(upperFactor);
    const double wanted = told > left ? goal * (left / told) : goal;
    const double most = goal_.hasShortPasses() ? kShortPass * done : done;
    Choice choice{kSteps - 1, 0};
    double chosen = 0;
    if (!(told < kInfinity) || told <= goal) return choice;
    for (int step = kSteps - 1; step > 0 && left > wanted * sqr(kAim); --step) {
        const auto from = static_cast<std::size_t>(step);
        if (chosen < most) choice.level = step - 1;
        chosen += now[from];
        left -= squares[from] * (1 - kLeftByDoubling);
        choice.foreseen += cost[from];
        if (step < kFall) continue;
        const auto to = static_cast<std::size_t>(step - kFall);
        squares[to] += squares[from] * kLeftByDoubling;
        cost[to] += 2 * cost[from];
    }
    return choice;
}

void SamplePlan::addParts(const NoiseMap& noise, const Block& block, const Choice& choice,
                          std::vector<Part>& parts) const {
    const bool isUnsureBlock = isUnsure(block);
    const std::size_t first = parts.size();
    bool isWhole = true; // all groups, and all alike
    int row = -1;
    noise.forEachGroup(block.area, [&](const Group& g, const Tile& area) {
        if (!isChosen(g, choice, isUnsureBlock)) {
            isWhole = false;
            row = -1;
            return;
        }
        const Part part{area, g.samples, batchOf(g)};
        const bool isFirst = parts.size() == first;
        if (!isFirst && (parts.back().before != part.before || parts.back().batch != part.batch))
            isWhole = false;
        if (row == area.y0 && parts.back().before == part.before && parts.back().batch == part.batch)
            parts.back().tile.x1 = area.x1;
        else
            parts.push_back(part);
        row = area.y0;
    });
    if (parts.size() == first || !isWhole) return;
    const Part whole{block.area, parts[first].before, parts[first].batch};
    if (block.pixels * whole.batch > kSamplesOfJob) return;
    parts.resize(first);
    parts.push_back(whole);
}

std::vector<SamplePlan::Part> SamplePlan::next(const NoiseMap& noise) {
    if (goal_.passes && passes_ == *goal_.passes) return {};
    const auto blocks = noise.blocks();
    std::vector<Part> parts;
    double foreseen = 0;
    if (isEven()) {
        for (const Block& b : blocks) {
            addParts(noise, b, {}, parts);
            noise.forEachGroup(b.area, [&](const Group& g, const Tile&) {
                foreseen += static_cast<double>(goal_.mostSamples) * g.pixels - costOf(g);
            });
        }
    } else if (goal_.ofWorstBlock) {
        for (const Block& b : blocks) {
            const double factor = NoiseMap::upperFactor(b.ownSquares, b.ownFourth);
            const Choice choice = choose(noise, {&b, 1}, factor);
            addParts(noise, b, choice, parts);
            foreseen += choice.foreseen;
        }
    } else {
        const Choice choice = choose(noise, blocks, upperFactorOf(blocks));
        for (const Block& b : blocks) addParts(noise, b, choice, parts);
        foreseen = choice.foreseen;
    }
    double now = 0, done = 0;
    for (const Part& p : parts)
        now += static_cast<double>(p.batch) * p.tile.width() * p.tile.height();
    for (const Block& b : blocks)
        noise.forEachGroup(b.area, [&](const Group& g, const Tile&) { done += costOf(g); });
    const double all = done + max(foreseen, now);
    if (all > 0) share_ = {done / all, (done + now) / all};
    if (!parts.empty()) ++passes_;
    return parts;
}

SamplePlan::Samples SamplePlan::samples(const NoiseMap& noise) const {
    Samples out{goal_.mostSamples, 0};
    double sum = 0;
    for (const Block& b : noise.blocks()) {
        out.unsureBlocks += isUnsure(b);
        noise.forEachGroup(b.area, [&](const Group& g, const Tile&) {
            out.min = std::min(out.min, g.samples);
            out.max = std::max(out.max, g.samples);
            sum += costOf(g);
            if (hasGoal() && isFull(g) && g.squares > wantedSquares(g.pixels))
                out.cappedPixels += static_cast<std::uint64_t>(g.pixels);
        });
    }
    out.mean = sum / noise.pixels();
    return out;
}
