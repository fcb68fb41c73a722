#include "film/noise_map.h"

#include <array>
#include <cmath>

namespace {

// Pixels up to two away tell of the noise of one.
constexpr int kReach = 2;
// Fewer degrees of freedom than these are not told apart.
constexpr double kLeastFreedom = 3;

// Pixels are coloured as a chessboard: the error is told from those of one colour, and the others decide where
// samples go. Groups that look good by chance get none, so that what decides is too low in the end.
constexpr std::size_t kTold = 0;
// But groups of which one colour says so many times as much as the other are taken to be as bad as it says.
constexpr double kOutlier = 9;
// More of a block's light than this by one sample is a sign of others that nothing has met yet.
constexpr double kLargeSample = 0.1;
constexpr std::size_t colourOf(int x, int y) { return static_cast<std::size_t>((x + y) & 1); }

// Numbers of the pixels of a block, row after row.
using Numbers = std::array<double, NoiseMap::kBlockSide * NoiseMap::kBlockSide>;
struct Halves {
    Numbers own{}, count{};
};

// Every number becomes the sum of those up to kReach away in its row (step 1) or column of the block.
void sumAlong(Numbers& numbers, std::size_t step) {
    constexpr std::size_t kSide = NoiseMap::kBlockSide;
    const std::size_t across = step == 1 ? kSide : 1;
    std::array<double, kSide + 2 * kReach> line{};
    for (std::size_t i = 0; i < kSide; ++i) {
        double* const at = numbers.data() + i * across;
        for (std::size_t j = 0; j < kSide; ++j) line[j + kReach] = at[j * step];
        for (std::size_t j = 0; j < kSide; ++j) {
            double sum = 0;
            for (std::size_t k = 0; k <= 2 * kReach; ++k) sum += line[j + k];
            at[j * step] = sum;
        }
    }
}
void sumAround(Numbers& numbers) {
    sumAlong(numbers, 1);
    sumAlong(numbers, NoiseMap::kBlockSide);
}

} // namespace

NoiseMap::NoiseMap(const Tile& area, const ErrorMeasure& measure)
    : area_(area), measure_(measure),
      groupColumns_((area.x1 - 1) / kGroupSide - area.x0 / kGroupSide + 1) {
    const int groupRows = (area.y1 - 1) / kGroupSide - area.y0 / kGroupSide + 1;
    const auto pixels =
        static_cast<std::size_t>(area.width()) * static_cast<std::size_t>(area.height());
    groups_.resize(static_cast<std::size_t>(groupColumns_) * static_cast<std::size_t>(groupRows));
    difference_.resize(pixels);
    squares_.resize(pixels);
    const auto next = [](int x) { return (x / kBlockSide + 1) * kBlockSide; };
    for (int y = area.y0; y < area.y1; y = next(y))
        for (int x = area.x0; x < area.x1; x = next(x)) {
            Block block;
            block.area = {x, y, std::min(next(x), area.x1), std::min(next(y), area.y1)};
            block.pixels = static_cast<double>(block.area.width()) * block.area.height();
            blocks_.push_back(block);
        }
    forEachGroup(area, [](Group& g, const Tile& part) { g.pixels = part.width() * part.height(); });
}

void NoiseMap::add(const Tile& part, int samples, const Film& before, const Film& batch, float largest) {
    forEachGroup(part, [&](Group& g, const Tile& area) {
        const bool hasTwoHalves = g.samples > 0;
        g.samples += samples;
        g.largest = std::max(g.largest, largest);
        if (!hasTwoHalves) return;
        double squares = 0;
        for (int y = area.y0; y < area.y1; ++y)
            for (int x = area.x0; x < area.x1; ++x) {
                const Vec3d half = Film::halfDifference(before.at(x - area_.x0, y - area_.y0),
                                                        batch.at(x - part.x0, y - part.y0),
                                                        before.perUnit());
                squares += dot(half, half);
                difference_[pixelIndex(x, y)] = toFloat(half);
            }
        g.halves = {squares, g.halves[0], g.halves[1]};
        ++g.doublings;
    });
}

// Returns 2^theta, from how the squared differences of the block have fallen in the last two doublings, of
// those groups that have had three. theta is from 1 to 2, and nearer to 1 where few pixels tell of it: the
// ratio of two sums with nu degrees of freedom has a deviation of sqrt(4 / nu) or more, in itself.
double NoiseMap::growthOf(const Block& block) const {
    double now = 0, before = 0;
    forEachGroup(block.area, [&](const Group& g, const Tile&) {
        if (g.doublings < 3) return;
        now += g.halves[0], before += g.halves[2];
    });
    if (!(now > 0) || !(before > 0)) return 2;
    const double freedom = freedomOf(block.ownSquares, block.ownFourth);
    return clamp(std::sqrt(before / now / (1 + 2 * std::sqrt(8 / freedom))), 2.0, 4.0);
}

void NoiseMap::update(std::size_t number, const Film& sums) {
    Block& block = blocks_[number];
    block.growth = growthOf(block);
    block.squares = block.ownSquares = block.ownFourth = block.spike = 0;
    double largest = 0, light = 0, samples = 0;
    bool isKnown = true;
    forEachGroup(block.area, [&](Group& g, const Tile&) {
        isKnown = isKnown && g.doublings > 0;
        largest = max(largest, static_cast<double>(g.largest));
        samples += static_cast<double>(g.samples) * g.pixels;
        g.squares = g.told = 0;
    });

    // Each pixel's own D gives an error for one sample, which is kept by the colour of the pixel.
    std::array<Halves, 2> halves{};
    const double toMean = 1 / std::sqrt(block.growth - 1);
    forEachPixel(block, [&](std::size_t at, int x, int y) {
        const Group& g = group(x, y);
        const Vec3d mean = sums.meanAt(x - area_.x0, y - area_.y0);
        const Vec3 d = difference_[pixelIndex(x, y)];
        const auto squareOf = [&](double m, float half) {
            return sqr(measure_.of(m, static_cast<double>(half) * toMean));
        };
        const double squares = squareOf(mean.x, d.x) + squareOf(mean.y, d.y) + squareOf(mean.z, d.z);
        Halves& half = halves[colourOf(x, y)];
        half.own[at] = squares * g.samples, half.count[at] = 1;
        light += (mean.x + mean.y + mean.z) * g.samples;
        if (colourOf(x, y) == kTold) block.ownSquares += squares, block.ownFourth += sqr(squares);
    });
    for (Halves& half : halves) sumAround(half.own), sumAround(half.count);

    forEachPixel(block, [&](std::size_t at, int x, int y) {
        Group& g = groups_[groupIndex(x, y)];
        const auto meanOf = [&](std::size_t first) {
            const Halves& half = halves[halves[first].count[at] > 0 ? first : 1 - first];
            return half.own[at] / half.count[at] / g.samples;
        };
        const double told = meanOf(kTold);
        squares_[pixelIndex(x, y)] = static_cast<float>(told);
        block.squares += told, g.told += told;
        g.squares += meanOf(1 - kTold);
    });
    forEachGroup(block.area, [&](Group& g, const Tile&) {
        if (g.told > kOutlier * g.squares) g.squares = g.told;
    });
    if (largest > kLargeSample * light) block.spike = measure_.of(0, largest / (3 * samples));
    if (isKnown) return;
    block.squares = kInfinity;
    forEachGroup(block.area, [&](Group& g, const Tile&) { g.squares = g.told = kInfinity; });
}

double NoiseMap::freedomOf(double ownSquares, double ownFourth) {
    return ownFourth > 0 ? max(3 * ownSquares * ownSquares / ownFourth, kLeastFreedom)
                         : kLeastFreedom;
}

double NoiseMap::upperFactor(double ownSquares, double ownFourth) {
    if (!(ownFourth > 0)) return 1;
    const double a = 2 / (9 * freedomOf(ownSquares, ownFourth));
    const double root = 1 - a - 1.645 * std::sqrt(a);
    return 1 / std::sqrt(root * root * root);
}
