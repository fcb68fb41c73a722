// Samplers and filters in whole pictures: all have the same mean, the good ones less error.
#include "check.h"
#include "shot.h"

#include "image/compare.h"

namespace test_sampling {

namespace {

// A lit ball with a soft shadow in the middle of black: what a filter spreads stays in the picture.
std::string scene(const std::string& sampler, const std::string& filter, int samples) {
    return cat("settings {\n resolution 24 24\n samples ", samples, "\n sampler ", sampler,
               "\n filter ", filter,
               "\n}\ncamera c {\n look_at 0 -9 4  0 0 0  0 0 1\n lens 60\n}\nsphere s {\n "
               "translate 0 0 0.6\n radius 0.6\n}\n"
               "plane p {\n scale 1.5 1.5 1\n}\nlight l {\n type rectangle\n look_at 2 0 4  0 0 0  "
               "0 0 1\n size 1.5 1.5\n color 9 9 9\n}\n");
}

} // namespace

// The mean of the picture of every sampler and filter, against random numbers' own error: 576
// pixels of 64 samples, so sigma is the pixels' spread over seeds; 8 seeds each.
TEST(samplersAndFiltersHaveOneMean) {
    const auto meanOf = [](const std::string& sampler, const std::string& filter) {
        double sum = 0, squares = 0;
        constexpr int kSeeds = 8;
        for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
            const double mean =
                shot::estimate(shot::render(scene(sampler, filter, 16),
                                            [&](RenderSettings& s) { s.picture.seed = seed; })
                                   .color)
                    .mean;
            sum += mean, squares += mean * mean;
        }
        const double mean = sum / kSeeds;
        return shot::Estimate{mean,
                              std::sqrt(max(squares / kSeeds - mean * mean, 0.0) / (kSeeds - 1))};
    };
    const shot::Estimate reference = meanOf("random", "box 1");
    for (const std::string sampler : {"sobol", "stratified", "random", "grid", "zsobol"})
        for (const std::string filter :
             {"box 1", "tent 2", "gaussian 1.5", "blackman-harris 1.5"}) {
            const shot::Estimate e = meanOf(sampler, filter);
            // With 8 seeds a sigma is known to 27 %, so 4 of the estimated for 3 of the true ones.
            const double sigma = std::sqrt(e.sigma * e.sigma + reference.sigma * reference.sigma);
            CHECK_INFO(std::fabs(e.mean - reference.mean) < 4 * sigma,
                       sampler << " " << filter << ": " << e.mean << " not " << reference.mean
                               << " +- " << sigma);
            CHECK_INFO(sigma < 0.01 * reference.mean,
                       sampler << " " << filter << " " << sigma / reference.mean);
        }
}

// Error at 64 samples against 4096: Sobol is far below random, stratified between.
TEST(sobolBeatsRandom) {
    const Image reference = shot::render(scene("sobol", "box 1", 4096), [](RenderSettings& s) {
                                s.picture.seed = 99;
                            }).color;
    const double sobol = rmse(shot::render(scene("sobol", "box 1", 64)).color, reference);
    const double stratified = rmse(shot::render(scene("stratified", "box 1", 64)).color, reference);
    const double random = rmse(shot::render(scene("random", "box 1", 64)).color, reference);
    std::printf("RMSE at 64 samples: sobol %.3g, stratified %.3g, random %.3g\n", sobol, stratified,
                random);
    CHECK(sobol < 0.6 * random); // pixels with two edges in four dimensions gain least
    CHECK(stratified < 0.75 * random);
}

// The filter's width is what the format says: an edge one pixel away is inside or outside.
TEST(filtersHaveTheirWidth) {
    const auto column = [](const std::string& filter, int x) {
        const std::string text =
            "settings {\n resolution 9 3\n samples 256\n filter " + filter +
            "\n}\ncamera c {\n type orthographic\n ortho_scale 9\n translate 0 0 5\n}\nmaterial w "
            "{\n emission 1 1 1\n diffuse 0 0 0\n}\n"
            "plane p {\n translate 5 0 0\n scale 5 5 1\n material w\n}\n"; // white from x = 0: the
                                                                           // middle of column 4
        return shot::render(text).color.pixel(x, 1).r;
    };
    for (const std::string filter : {"box 1", "tent 2", "gaussian 1", "blackman-harris 1.5"})
        CHECK_NEAR(column(filter, 4), 0.5, 0.01); // symmetric: 256 samples at an edge
    CHECK_EQUAL(column("box 1", 3), 0.0f);
    CHECK_NEAR(column("box 3", 3), 1.0 / 6, 0.01); // 1.5 to each side, 0.5 of 3 beyond the edge
    CHECK_NEAR(column("tent 2", 3), 0, 1e-9);
    CHECK_NEAR(column("tent 4", 3), 1.0 / 8, 0.01); // (1/2)^2 / 2
}

// Ambient occlusion: an open plane sees all of the sky, the foot of a wall without end half of it.
TEST(ambientOcclusionOfAWall) {
    const shot::TopView view{
        .pixels = 16, .side = 1e-3, .centre = {1e-3, 0}, .samples = 16, .more = "sampler random"};
    const auto ao = [](RenderSettings& s) { s.picture.integrator = IntegratorKind::Ao; };
    const std::string floor = "plane floor {\n scale 5 5 1\n}\n";
    CHECK_NEAR(shot::estimate(shot::render(view.text() + floor, ao).color).mean, 1, 1e-6);
    const shot::Estimate e = shot::estimate(
        shot::render(view.text() + floor + "plane wall {\n rotate 90 0 1 0\n scale 99 99 1\n}\n",
                     ao)
            .color);
    CHECK_NEAR(e.mean, 0.5, 3 * e.sigma + 1e-3); // the wall ends at 99 m, seen from 1 mm off
}

} // namespace test_sampling
