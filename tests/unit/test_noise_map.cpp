// NoiseMap: what halves of samples say about the error of means, on integrals whose value is known.
#include "adaptive_kit.h"
#include "check.h"

namespace test_noise_map {

namespace {

using adaptive_kit::Integral;
using adaptive_kit::Rendered;

constexpr Tile kArea{0, 0, 64, 64};

// Half of the square is lit, behind an edge that lies differently in each pixel: well spread samples have a
// variance that falls as n^-1.5 (Mitchell 1996).
Integral edge(std::uint32_t seed) {
    const auto slope = [](int x) { return (x % 8 - 3.5) / 8; };
    return {kArea,
            [=](int x, int, Vec2 uv) {
                return static_cast<double>(uv.y) < 0.5 + slope(x) * (static_cast<double>(uv.x) - 0.5) ? 0.5 : 0.0;
            },
            [](int, int) { return 0.25; }, seed};
}
// A smooth one: its variance falls as n^-2 or faster.
Integral smooth(std::uint32_t seed) {
    return {kArea,
            [](int, int, Vec2 uv) { return 0.5 * static_cast<double>(uv.x * uv.x + uv.y); },
            [](int, int) { return 0.5 * (1.0 / 3 + 0.5); }, seed};
}
Integral constant(std::uint32_t seed) {
    return {kArea, [](int, int, Vec2) { return 0.3; }, [](int, int) { return static_cast<double>(0.3f); }, seed};
}
// One sample of 64 is lit.
Integral seldom(std::uint32_t seed) {
    return {kArea, [](int, int, Vec2 uv) { return uv.x < 1.0f / 8 && uv.y < 1.0f / 8 ? 8.0 : 0.0; },
            [](int, int) { return 0.125; }, seed, SamplerKind::Random};
}
// Of 4096 samples one, and so bright that its light is a quarter of what is shown.
Integral spike(std::uint32_t seed) {
    return {kArea, [](int, int, Vec2 uv) { return uv.x < 1.0f / 64 && uv.y < 1.0f / 64 ? 4096.0 : 0.1; },
            [](int, int) { return 1.1; }, seed, SamplerKind::Random};
}

// All pixels have the most samples.
Rendered even(const Integral& integral, int samples, ErrorUnit unit = ErrorUnit::Display) {
    return {integral, {.error = 1e-6, .unit = unit, .mostSamples = samples}};
}

} // namespace

// K95 of the table of degrees of freedom (chi-square at 0.05): 2.92, 1.80, 1.44, 1.17 and 1.04 for 3, 7, 15,
// 63 and 1023; Wilson and Hilferty's formula is within 4 %.
TEST(upper_factor_follows_chi_square) {
    const std::pair<double, double> table[] = {{3, 2.92}, {7, 1.80}, {15, 1.44}, {63, 1.17}, {1023, 1.04}};
    for (const auto& [freedom, factor] : table) // n equal squares s: (ns)^2 / ns^2 = n
        CHECK_NEAR(NoiseMap::upperFactor(freedom / 3, freedom / 3 / 1), factor, 0.04 * factor);
    CHECK_EQUAL(NoiseMap::upperFactor(0, 0), 1.0);
}

// theta within 0.25 of 1.5 for an edge, at its limit of 2 for a smooth integral, and 1 for independent samples.
TEST(noise_map_finds_how_errors_fall) {
    const auto thetaOf = [](const Rendered& r) {
        double sum = 0;
        for (const NoiseMap::Block& b : r.noise.blocks()) sum += std::log2(b.growth);
        return sum / static_cast<double>(r.noise.blocks().size());
    };
    CHECK_NEAR(thetaOf(even(edge(1), 128)), 1.5, 0.25);
    CHECK_NEAR(thetaOf(even(smooth(2), 128)), 2.0, 0.25);
    Integral independent = edge(3);
    independent.kind = SamplerKind::Random;
    CHECK_NEAR(thetaOf(even(independent, 128)), 1.0, 0.25);
}

// The estimate is the true error within 15 %, from the first look on, where it can't know that samples are
// better than independent ones: then it may be 1.8 times too large.
TEST(noise_map_tells_the_error) {
    for (std::uint32_t seed = 0; seed < 3; ++seed)
        for (const int samples : {16, 64, 256}) {
            const auto check = [&](const char* name, const Rendered& r, double most) {
                const double ratio = r.error() / r.trueError();
                CHECK_INFO(ratio > 0.9 && ratio < most, name << " " << samples << " samples, seed " << seed
                                                              << ": " << ratio);
            };
            check("edge", even(edge(seed), samples), samples < 64 ? 1.8 : 1.15);
            check("seldom", even(seldom(seed), samples, ErrorUnit::Linear), 1.2);
        }
    const Rendered still = even(constant(0), 16);
    CHECK_EQUAL(still.error(), 0.0);
    CHECK_NEAR(still.trueError(), 0.0, 1e-6);
}

// The bound of a block is above its true error in 93 % of the blocks or more.
TEST(noise_map_bounds_its_blocks) {
    for (const bool isEdge : {true, false}) {
        int blocks = 0, held = 0;
        for (std::uint32_t seed = 0; seed < check::scaled(100u); ++seed) {
            const Rendered r = isEdge ? even(edge(seed), 64) : even(seldom(seed), 64, ErrorUnit::Linear);
            for (const NoiseMap::Block& b : r.noise.blocks()) {
                double bound = 0;
                for (int y = b.area.y0; y < b.area.y1; ++y)
                    for (int x = b.area.x0; x < b.area.x1; ++x) bound += r.noise.boundSquaresAt(x, y);
                ++blocks;
                held += r.trueError(b.area) <= std::sqrt(bound / (3 * b.pixels));
            }
        }
        CHECK_INFO(held >= 0.93 * blocks, (isEdge ? "edge: " : "seldom: ") << held << " of " << blocks);
    }
}

// No estimate knows of what has not been seen; where single samples are a tenth of the light, it is said.
TEST(noise_map_is_not_sure_of_spikes) {
    const Rendered few{spike(4), {.error = 0.05, .mostSamples = 16}};
    CHECK(few.samples().unsureBlocks > 0);
    const Rendered more{spike(4), {.error = 0.05, .mostSamples = 256}};
    CHECK(more.samples().max >= 64);
    CHECK_EQUAL(more.samples().unsureBlocks, 0u);
    const Rendered sure{edge(4), {.error = 0.05, .mostSamples = 64}};
    CHECK_EQUAL(sure.samples().unsureBlocks, 0u);
}

} // namespace test_noise_map
