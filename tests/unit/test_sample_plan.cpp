// SamplePlan: where samples go, on pictures whose noise and whose error are known.
#include "adaptive_kit.h"
#include "check.h"

#include <set>

namespace test_sample_plan {

namespace {

using adaptive_kit::Integral;
using adaptive_kit::Rendered;

// Independent samples of 0.5, spread evenly by sigma(x, y) sqrt(3) up and down.
Integral noisy(const Tile& area, const std::function<double(int x, int y)>& sigma, std::uint32_t seed = 0) {
    return {area,
            [=](int x, int y, Vec2 uv) {
                return 0.5 + sigma(x, y) * std::sqrt(12.0) * (static_cast<double>(uv.x) - 0.5);
            },
            [](int, int) { return 0.5; }, seed, SamplerKind::Random};
}
Integral noisy(int width, int height, const std::function<double(int x, int y)>& sigma, std::uint32_t seed = 0) {
    return noisy(Tile{0, 0, width, height}, sigma, seed);
}
int samplesAt(const Rendered& r, int x, int y) { return r.noise.group(x, y).samples; }

} // namespace

// The true error is below the goal in 95 % of all cases, and seldom far below: 64 seeds of a picture whose noise
// grows from nothing to a third.
TEST(sample_plan_reaches_its_goal) {
    const int cases = check::scaled(64);
    int held = 0;
    double sum = 0;
    for (int i = 0; i < cases; ++i) {
        const auto sigma = [](int x, int y) { return 0.3 * (x * y) / (97 * 61); };
        const double goal = 0.02 / (1 + i % 4);
        const Rendered r{noisy(97, 61, sigma, static_cast<std::uint32_t>(i)), {.error = goal}};
        CHECK_INFO(r.error() <= goal, "seed " << i << ": " << r.error() << " of " << goal);
        held += r.trueError() <= goal;
        sum += r.trueError() / goal;
    }
    CHECK_INFO(held >= 0.95 * cases, held << " of " << cases);
    CHECK_INFO(sum / cases > 0.6 && sum / cases < 1, sum / cases);
}

// Where the noise is 16 times as strong, the best picture of so many samples has 16 times as many of them.
// Against the same number everywhere: (1 + 15/8) / sqrt(1 + 255/8) = 1 / 2.
TEST(sample_plan_puts_samples_where_they_count) {
    const Rendered r{noisy(128, 128, [](int x, int) { return x < 16 ? 0.16 : 0.01; }), {.error = 0.003}};
    const double slope = 0.5 * (r.measure.of(0.5, 0.01) / 0.01) * 2; // of what is shown, at 0.5
    const double even = (sqr(0.16) / 8 + sqr(0.01) * 7 / 8) * sqr(slope) / sqr(r.trueError());
    const SamplePlan::Samples samples = r.samples();
    CHECK_INFO(samples.mean < 0.6 * even, samples.mean << " of " << even);
    CHECK(samples.max >= 8 * samples.min);
    CHECK_EQUAL(samples.cappedPixels, 0u);
    CHECK(r.noise.boundSquaresAt(8, 60) > r.noise.boundSquaresAt(100, 60));
}

// A picture without noise gets the first look and no more, however small it is.
TEST(sample_plan_leaves_alone_what_is_done) {
    for (const auto& [width, height] : {std::pair{1, 1}, {4, 4}, {5, 1}, {1, 9}, {63, 65}}) {
        const Rendered still{noisy(width, height, [](int, int) { return 0.0; }), {.error = 1e-6}};
        CHECK_EQUAL(still.passes.size(), 2u); // two halves
        CHECK_EQUAL(still.samples().min, Refinement::kFirstSamples);
        CHECK_EQUAL(still.samples().max, Refinement::kFirstSamples);
        const Rendered r{noisy(width, height, [](int, int) { return 0.1; }), {.error = 0.01}};
        CHECK(r.error() <= 0.01);
    }
}

// No pixel gets more than allowed; pixels that have all of it and are not good enough are counted.
TEST(sample_plan_knows_its_limit) {
    for (const int most : {2, 7, 64, 100}) {
        const Rendered r{noisy(64, 64, [](int x, int y) { return x < 8 && y < 8 ? 10 : 0.0005; }),
                         {.error = 0.01, .unit = ErrorUnit::Linear, .mostSamples = most}};
        const SamplePlan::Samples samples = r.samples();
        CHECK_EQUAL(samples.max, most);
        CHECK_EQUAL(samplesAt(r, 60, 60), std::min(most, Refinement::kFirstSamples));
        CHECK(r.error() > 0.1);
        // Pixels of the ring of groups beside them see their noise.
        CHECK_INFO(samples.cappedPixels >= 64 && samples.cappedPixels <= 12 * 12, samples.cappedPixels);
    }
}

// Parts cover what they say once, within blocks, and have one number of samples.
TEST(sample_plan_cuts_passes_into_parts) {
    const Tile area{13, 7, 83, 57};
    for (const Refinement& goal : {Refinement{.error = 0.003}, Refinement{.error = 0.01, .ofWorstBlock = true},
                                   Refinement{.passes = 12}}) {
        const Rendered r{noisy(area, [](int x, int y) { return 0.001 * (x + 2 * y); }), goal};
        std::vector<int> samples(static_cast<std::size_t>(area.width() * area.height()));
        for (const auto& parts : r.passes) {
            std::set<std::pair<int, int>> seen;
            for (const SamplePlan::Part& part : parts) {
                CHECK_EQUAL(part.tile.x0 / NoiseMap::kBlockSide, (part.tile.x1 - 1) / NoiseMap::kBlockSide);
                CHECK_EQUAL(part.tile.y0 / NoiseMap::kBlockSide, (part.tile.y1 - 1) / NoiseMap::kBlockSide);
                for (int y = part.tile.y0; y < part.tile.y1; ++y)
                    for (int x = part.tile.x0; x < part.tile.x1; ++x) {
                        CHECK(seen.insert({x, y}).second);
                        int& at = samples[static_cast<std::size_t>((y - area.y0) * area.width() + x - area.x0)];
                        CHECK_EQUAL(at, part.before);
                        at += part.batch;
                    }
            }
        }
        for (int y = area.y0; y < area.y1; ++y)
            for (int x = area.x0; x < area.x1; ++x)
                CHECK_EQUAL(samplesAt(r, x, y),
                            samples[static_cast<std::size_t>((y - area.y0) * area.width() + x - area.x0)]);
    }
}

// A goal for the worst block is kept by each of them alone, so that a crop of whole blocks is a part of the
// picture.
TEST(sample_plan_of_the_worst_block_is_local) {
    const auto sigma = [](int x, int y) { return 0.002 * (x + 2 * y); };
    const Refinement goal{.error = 0.02, .ofWorstBlock = true};
    const Rendered all{noisy(Tile{0, 0, 96, 96}, sigma), goal};
    const Rendered part{noisy(Tile{32, 64, 96, 96}, sigma), goal};
    for (int y = 64; y < 96; ++y)
        for (int x = 32; x < 96; ++x) {
            CHECK_EQUAL(samplesAt(all, x, y), samplesAt(part, x, y));
            CHECK_EQUAL(all.noise.boundSquaresAt(x, y), part.noise.boundSquaresAt(x, y));
        }
    for (const NoiseMap::Block& b : all.noise.blocks()) {
        double bound = 0;
        for (int y = b.area.y0; y < b.area.y1; ++y)
            for (int x = b.area.x0; x < b.area.x1; ++x) bound += all.noise.boundSquaresAt(x, y);
        CHECK(std::sqrt(bound / (3 * b.pixels)) <= 0.02);
    }
}

// Passes of a picture that the clock ends begin with one sample, and add a quarter later; fewer of them are a
// part of more.
TEST(sample_plan_has_short_passes) {
    const Integral integral = noisy(96, 64, [](int x, int) { return 0.01 * x; });
    const Rendered r{integral, {.passes = 14}}, less{integral, {.passes = 9}};
    CHECK_EQUAL(r.passes.size(), 14u);
    CHECK_EQUAL(less.passes.size(), 9u);
    double done = 0;
    for (std::size_t pass = 0; pass < r.passes.size(); ++pass) {
        double more = 0;
        for (const SamplePlan::Part& p : r.passes[pass])
            more += static_cast<double>(p.batch) * p.tile.width() * p.tile.height();
        if (pass == 0) CHECK_EQUAL(more, 96 * 64.0);
        if (pass >= 5) CHECK_INFO(more > 0 && more <= 0.5 * done, pass << ": " << more << " of " << done);
        done += more;
        if (pass >= less.passes.size()) continue;
        CHECK_EQUAL(r.passes[pass].size(), less.passes[pass].size());
    }
}

} // namespace test_sample_plan
