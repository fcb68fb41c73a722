#include "film/error_plan.h"

#include <array>
#include <cmath>

namespace {

// What a block is taken to have at least, of the variance per sample of the worst one beside it:
// things that few samples meet (thin ones, edges at the rim of a filter, small lamps in rough
// mirrors) have mostly been met next door. A block has samples of 1/4 of its neighbours' at least.
constexpr double kNeighboursShare = 1.0 / 16;

// No block's error may be larger than this many goals, however small the others are.
constexpr double kWorstBlock = 3;

// Weight of what a doubling has shown against what was known before. Blocks are chosen by their
// estimates, so that too low ones stay; half of the past makes them rarer.
constexpr double kNewsWeight = 0.5;

// What is foreseen: squared errors of well spread samples at an edge fall as samples^-3/2 (Mitchell
// 1996), which leaves this of them when samples double. Independent ones leave 1/2: then it takes
// some rounds more.
constexpr double kLeftByDoubling = 0.35;
double leftByTimes(double times) { return 1 / (times * std::sqrt(times)); }

// Gains are sorted into steps of an eighth of an octave, and chosen by whole steps.
constexpr int kStepsPerOctave = 8;
constexpr int kSteps = 2048;
constexpr int kLeastExponent = -160;

int stepOf(double gain) {
    if (!(gain > 0)) return 0;
    int exponent = 0;
    const double mantissa = std::frexp(gain, &exponent); // from [0.5, 1)
    const double octave = exponent - kLeastExponent + (2 * mantissa - 1);
    return static_cast<int>(clamp(octave * kStepsPerOctave, 0.0, kSteps - 1.0));
}

// A doubling leaves this much less to gain by the next one: a smaller error, for twice the samples.
constexpr int kFall = 20; // 8 log2(2 / 0.35)

} // namespace

ErrorPlan::ErrorPlan(int width, int height, const ErrorGoal& goal)
    : width_(width), height_(height), columns_((width + kSide - 1) / kSide),
      rows_((height + kSide - 1) / kSide), goal_(goal),
      blocks_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    for (int y = 0; y < height; y += kSide)
        for (int x = 0; x < width; x += kSide)
            block(x, y).pixels = std::min(kSide, width - x) * std::min(kSide, height - y);
}

// The first look is two batches, for without a second one nothing is known about the error.
int ErrorPlan::batchAfter(int samples) const {
    const int batch = samples == 0 ? ErrorGoal::kFirstSamples / 2 : samples;
    return std::min(batch, goal_.mostSamples - samples);
}

void ErrorPlan::addBatch(Block& b, int batch, double squares) {
    const int before = b.samples;
    b.samples += batch;
    if (before == 0) return;
    const bool isFirst = !(b.squares < kInfinity);
    const double foreseen = b.squares * before / b.samples; // as of independent samples
    b.squares = isFirst ? squares : lerp(foreseen, squares, kNewsWeight);
}

void ErrorPlan::askNeighbours() {
    const auto at = [&](int column, int row) -> Block& {
        return blocks_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                       static_cast<std::size_t>(column)];
    };
    for (int row = 0; row < rows_; ++row)
        for (int column = 0; column < columns_; ++column) {
            Block& b = at(column, row);
            b.expected = b.squares;
            if (!(b.squares < kInfinity)) continue;
            double most = 0; // variance per pixel and sample
            for (int j = std::max(row - 1, 0); j <= std::min(row + 1, rows_ - 1); ++j)
                for (int i = std::max(column - 1, 0); i <= std::min(column + 1, columns_ - 1); ++i)
                    if (const Block& n = at(i, j); n.squares < kInfinity)
                        most = max(most, n.squares * n.samples / n.pixels);
            b.expected = max(b.squares, kNeighboursShare * most * b.pixels / b.samples);
        }
}

double ErrorPlan::error() const {
    double sum = 0;
    for (const Block& b : blocks_) sum += b.expected;
    return std::sqrt(sum / (3.0 * width_ * height_));
}

double ErrorPlan::errorAt(int x, int y) const {
    const Block& b = block(x, y);
    return std::sqrt(b.expected / (3.0 * b.pixels));
}

bool ErrorPlan::isHopeless(const Block& b) const {
    if (!(b.expected < kInfinity)) return false; // who knows
    const double times = static_cast<double>(goal_.mostSamples) / b.samples;
    return b.expected * leftByTimes(times) > wantedSquares(b.pixels);
}

bool ErrorPlan::isChosen(const Block& b, int step) const {
    if (isFull(b)) return false;
    return !(b.expected < kInfinity) || stepOf(b.perSample()) > step || isHopeless(b) ||
           b.expected > sqr(kWorstBlock) * wantedSquares(b.pixels);
}

// Goes down the steps, doubling what is there, until what is left is small enough; blocks above the
// step where this ends are worth a doubling now. Foresees the work on the way.
int ErrorPlan::chooseStep() {
    std::array<double, kSteps> squares{}, cost{};
    double left = 0, done = 0, more = 0;
    for (const Block& b : blocks_) {
        done += b.cost();
        // Errors that nothing can be done about are no reason to work on the others.
        left += isHopeless(b) ? wantedSquares(b.pixels) : b.expected;
        if (isFull(b) || isHopeless(b) || !(b.expected < kInfinity)) continue;
        const auto step = static_cast<std::size_t>(stepOf(b.perSample()));
        squares[step] += b.expected;
        cost[step] += b.cost();
    }
    int step = 0;
    if (left < kInfinity) {
        const double wanted = wantedSquares(static_cast<double>(width_) * height_);
        for (step = kSteps - 1; step > 0 && left > wanted; --step) {
            const auto from = static_cast<std::size_t>(step);
            left -= squares[from] * (1 - kLeftByDoubling);
            more += cost[from];
            if (step < kFall) continue;
            const auto to = static_cast<std::size_t>(step - kFall);
            squares[to] += squares[from] * kLeftByDoubling;
            cost[to] += 2 * cost[from];
        }
    }
    double now = 0;
    for (const Block& b : blocks_)
        if (isChosen(b, step)) now += static_cast<double>(batchAfter(b.samples)) * b.pixels;
    const double all = done + max(more, now);
    share_ = {done / all, (done + now) / all};
    return step;
}

std::vector<Tile> ErrorPlan::nextRound(int longest) {
    askNeighbours();
    const int step = chooseStep();
    std::vector<Tile> parts;
    for (int y = 0; y < height_; y += kSide)
        for (int x = 0; x < width_;) {
            const int start = x, samples = block(x, y).samples;
            const bool isWanted = isChosen(block(x, y), step);
            x += kSide;
            if (!isWanted) continue;
            while (x < width_ && x - start + kSide <= longest && block(x, y).samples == samples &&
                   isChosen(block(x, y), step))
                x += kSide;
            parts.push_back({start, y, std::min(x, width_), std::min(y + kSide, height_)});
        }
    return parts;
}

ErrorPlan::Samples ErrorPlan::samples() const {
    Samples out{blocks_[0].samples, blocks_[0].samples};
    double sum = 0;
    for (const Block& b : blocks_) {
        out.min = std::min(out.min, b.samples);
        out.max = std::max(out.max, b.samples);
        sum += b.cost();
        if (isFull(b) && b.expected > wantedSquares(b.pixels))
            out.cappedPixels += static_cast<std::uint64_t>(b.pixels);
    }
    out.mean = sum / (static_cast<double>(width_) * height_);
    return out;
}
