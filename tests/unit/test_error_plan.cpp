// ErrorPlan on pictures that are nothing but noise of a known strength: there the true error is
// known as well, sigma^2 / samples.
#include "check.h"

#include "film/error_plan.h"
#include "sample/hash.h"

#include <functional>

namespace test_error_plan {

namespace {

// Three independent channels of one noise, and the choices of the plan for it.
struct Noise {
    int width, height;
    std::function<double(int x, int y)> sigma;
    std::uint32_t seed = 0;

    // Squared error that a doubling of the samples shows: of a difference of normal numbers, which
    // sums of twelve even ones are near enough to.
    double shown(int x, int y, int before, int batch) const {
        double sum = 0;
        for (std::uint32_t channel = 0; channel < 3; ++channel) {
            const auto place = static_cast<std::uint32_t>(y * width + x);
            std::uint64_t bits =
                hash(hash(seed, place, channel) & 0xffffffffu, static_cast<std::uint32_t>(before));
            double normal = -6;
            for (int i = 0; i < 12; ++i) {
                bits = mixBits(bits + kHashStep);
                normal += static_cast<double>(unitFloat(low32(bits)));
            }
            sum += sqr(normal * sigma(x, y)) / (before + batch);
        }
        return sum;
    }

    double trueError(const ErrorPlan& plan) const {
        double sum = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                sum += sqr(sigma(x, y)) / plan.samplesOf({x, y, x + 1, y + 1});
        return std::sqrt(sum / (width * height));
    }

    ErrorPlan refined(const ErrorGoal& goal, int longest = 64, int* rounds = nullptr) const {
        ErrorPlan plan(width, height, goal);
        double done = 0;
        for (int round = 0;; ++round) {
            const std::vector<Tile> parts = plan.nextRound(longest);
            if (rounds) *rounds = round;
            if (parts.empty()) return plan;
            const ErrorPlan::Share share = plan.share();
            CHECK_INFO(share.begun >= 0 && share.begun < share.done && share.done <= 1,
                       round << ": " << share.begun << " to " << share.done);
            done = share.done;
            CHECK(round < 100);
            if (round == 100) return plan;
            std::vector<int> covered(static_cast<std::size_t>(width * height));
            for (const Tile& part : parts) {
                CHECK(part.x0 >= 0 && part.y0 >= 0 && part.x1 <= width && part.y1 <= height);
                CHECK(part.width() > 0 && part.height() > 0 && part.width() <= longest);
                const int before = plan.samplesOf(part), batch = plan.batchOf(part);
                for (int y = part.y0; y < part.y1; ++y)
                    for (int x = part.x0; x < part.x1; ++x) {
                        CHECK_EQUAL(covered[static_cast<std::size_t>(y * width + x)]++, 0);
                        CHECK_EQUAL(plan.samplesOf({x, y, x + 1, y + 1}), before);
                    }
                plan.add(part, [&](int x, int y) { return shown(x, y, before, batch); });
                CHECK_EQUAL(plan.samplesOf(part), before + batch);
            }
        }
        CHECK_EQUAL(done, 1.0);
    }
};

} // namespace

// What is reported is what is there, within 10 % and seldom less: blocks are chosen by estimates of
// 48 numbers each, and who looks good by chance stays.
TEST(error_plan_tells_the_truth) {
    const int cases = check::scaled(30);
    double sum = 0;
    for (int i = 0; i < cases; ++i) {
        const Noise noise{97, 61, [](int x, int y) { return 0.01 + 0.3 * (x * y) / (97 * 61); },
                          static_cast<std::uint32_t>(i)};
        const double goal = 0.05 / (1 + i % 10);
        const ErrorPlan plan = noise.refined({.rmse = goal});
        const double truth = noise.trueError(plan);
        CHECK_INFO(plan.error() <= goal, "seed " << i << ": " << plan.error() << " of " << goal);
        CHECK_INFO(truth < 1.1 * plan.error() && truth > 0.75 * plan.error(),
                   "seed " << i << ": " << truth << " not " << plan.error());
        sum += truth / plan.error();
    }
    CHECK_NEAR(sum / cases, 0.96, 0.06);
}

// Where the noise is 16 times as strong, the best picture of so many samples has 16 times as many
// of them. Against the same number everywhere: (1 + 15/8) / sqrt(1 + 255/8) = 1 / 2.
TEST(error_plan_puts_samples_where_they_count) {
    const Noise noise{128, 128, [](int x, int) { return x < 16 ? 0.16 : 0.01; }};
    const ErrorPlan plan = noise.refined({.rmse = 0.003});
    const double truth = noise.trueError(plan);
    const double even = (sqr(0.16) / 8 + sqr(0.01) * 7 / 8) / sqr(truth); // samples for the same
    const ErrorPlan::Samples samples = plan.samples();
    CHECK_INFO(samples.mean < 0.5 * even, samples.mean << " of " << even);
    CHECK(samples.max >= 8 * samples.min);
    CHECK_EQUAL(samples.cappedPixels, 0u);
    CHECK(plan.errorAt(8, 60) > plan.errorAt(100, 60));
}

// A picture without noise gets the first look and no more.
TEST(error_plan_leaves_alone_what_is_done) {
    int rounds = 0;
    const ErrorPlan plan =
        Noise{30, 17, [](int, int) { return 0.0; }}.refined({.rmse = 1e-6}, 64, &rounds);
    CHECK_EQUAL(rounds, 2); // two halves
    CHECK_EQUAL(plan.samples().min, ErrorGoal::kFirstSamples);
    CHECK_EQUAL(plan.samples().max, ErrorGoal::kFirstSamples);
    CHECK_EQUAL(plan.error(), 0.0);
    for (const auto& [width, height] : {std::pair{1, 1}, {4, 4}, {5, 1}, {1, 9}, {63, 65}}) {
        const Noise noise{width, height, [](int, int) { return 0.1; }};
        CHECK(noise.refined({.rmse = 0.01}).error() <= 0.01);
    }
}

// Nobody gets more than allowed; what is hopeless is no reason to refine the rest, and is counted.
TEST(error_plan_knows_its_limit) {
    for (const int most : {4, 7, 64, 100}) {
        const Noise noise{64, 64, [](int x, int y) { return x < 8 && y < 8 ? 100 : 0.005; }};
        const ErrorPlan plan = noise.refined({.rmse = 0.01, .mostSamples = most});
        const ErrorPlan::Samples samples = plan.samples();
        CHECK_EQUAL(samples.max, most);
        CHECK_EQUAL(plan.samplesOf({60, 60, 61, 61}), ErrorGoal::kFirstSamples);
        CHECK(plan.error() > 0.1);
        // The ring of blocks beside the hopeless ones is taken to be a sixteenth as bad.
        CHECK_EQUAL(samples.cappedPixels, 12u * 12u);
    }
}

// One block among flat ones has seen something: those beside it look again, the others don't.
TEST(error_plan_asks_neighbours) {
    const Noise noise{40, 40, [](int x, int y) { return x / 4 == 5 && y / 4 == 5 ? 1.0 : 0.0; }};
    const ErrorPlan plan = noise.refined({.rmse = 0.003});
    const auto samplesAt = [&](int column, int row) {
        return plan.samplesOf({4 * column, 4 * row, 4 * column + 1, 4 * row + 1});
    };
    CHECK(samplesAt(5, 5) >= 64);
    for (int row = 4; row <= 6; ++row)
        for (int column = 4; column <= 6; ++column)
            CHECK_INFO(samplesAt(column, row) >= samplesAt(5, 5) / 8,
                       column << "," << row << ": " << samplesAt(column, row) << " beside "
                              << samplesAt(5, 5));
    CHECK_EQUAL(samplesAt(3, 5), ErrorGoal::kFirstSamples);
    CHECK_EQUAL(samplesAt(9, 9), ErrorGoal::kFirstSamples);
}

// How the work is cut changes nothing.
TEST(error_plan_does_not_depend_on_parts) {
    const Noise noise{70, 50, [](int x, int y) { return 0.001 * (x + 2 * y); }};
    const ErrorPlan a = noise.refined({.rmse = 0.01}, 64), b = noise.refined({.rmse = 0.01}, 4);
    CHECK_EQUAL(a.error(), b.error());
    for (int y = 0; y < 50; ++y)
        for (int x = 0; x < 70; ++x)
            CHECK_EQUAL(a.samplesOf({x, y, x + 1, y + 1}), b.samplesOf({x, y, x + 1, y + 1}));
}

} // namespace test_error_plan
