// Samplers: which numbers there are, and that they are always the same ones. How they are spread is
// in test_sampler_spread.cpp.
#include "check.h"
#include "sample/dimensions.h"
#include "sample/hash.h"
#include "unit/sampler_kit.h"

#include <bit>
#include <set>
#include <utility>

namespace test_sampler {

using sampler_kit::kKinds;
using sampler_kit::pairsOf;

TEST(sampler_range) {
    for (const SamplerKind kind : kKinds) {
        const Sampler sampler(kind, 16, 3);
        for (std::uint32_t pixel = 0; pixel < 100; ++pixel)
            for (std::uint32_t i = 0; i < 40; ++i) // beyond the count as well
                for (std::uint32_t d = 0; d < 14; ++d) {
                    const float u = sampler.get1D(pixel, i, d);
                    CHECK(u >= 0 && u < 1);
                    const Vec2 v = sampler.get2D(pixel, i, d & ~1u);
                    CHECK(v.x >= 0 && v.x < 1 && v.y >= 0 && v.y < 1);
                }
    }
}

TEST(sampler_of_no_samples_is_that_of_one) {
    for (const SamplerKind kind : kKinds)
        for (const int count : {0, -3})
            CHECK(Sampler(kind, count, 4, true).get2D(12, 0, kPixelDimension) ==
                  Sampler(kind, 1, 4, true).get2D(12, 0, kPixelDimension));
}

TEST(sampler_jitter_off) {
    for (const SamplerKind kind : kKinds) {
        const Sampler one(kind, 1, 4, false);
        CHECK(one.get2D(12, 0, kPixelDimension) == (Vec2{0.5f, 0.5f}));
        CHECK(!(one.get2D(12, 0, kLensDimension) == (Vec2{0.5f, 0.5f})));
    }
    const Sampler grid(SamplerKind::Grid, 6, 4, false); // in reading order
    for (int i = 0; i < 6; ++i) {
        const Vec2 p = grid.get2D(99, static_cast<std::uint32_t>(i), kPixelDimension);
        CHECK_NEAR(p.x, (i % 3 + 0.5) / 3, 1e-7);
        CHECK_NEAR(p.y, (i / 3 + 0.5) / 2, 1e-7);
    }
    const Sampler cells(SamplerKind::Stratified, 4, 4, false); // the same places, shuffled
    std::set<std::pair<float, float>> places;
    for (const Vec2 p : pairsOf(cells, 3, kPixelDimension, 4)) places.insert({p.x, p.y});
    const std::set<std::pair<float, float>> expected{
        {0.25f, 0.25f}, {0.75f, 0.25f}, {0.25f, 0.75f}, {0.75f, 0.75f}};
    CHECK(places == expected);
}

TEST(sampler_dimensions_do_not_overlap) {
    std::set<std::uint32_t> used{kPixelDimension, kPixelDimension + 1, kLensDimension,
                                 kLensDimension + 1, kTimeDimension};
    std::size_t expected = used.size();
    for (int depth = 0; depth < 100; ++depth)
        for (std::uint32_t slot = 0; slot < 8; ++slot) {
            used.insert(dimension(depth, static_cast<BounceSlot>(slot)));
            ++expected;
        }
    CHECK_EQUAL(used.size(), expected);
    CHECK_EQUAL(dimension(3, BounceSlot::LightUv) % 2, 0u);
    CHECK_EQUAL(dimension(3, BounceSlot::BsdfUv) % 2, 0u);
}

// The numbers themselves: pictures of this version and the next must agree.
TEST(sampler_same_numbers) {
    std::vector<std::uint64_t> hashes;
    for (const SamplerKind kind : kKinds) {
        const Sampler sampler(kind, 16, 1), light = sampler.stream(2, 3);
        std::uint64_t h = 0;
        for (std::uint32_t pixel = 0; pixel < 64; ++pixel)
            for (std::uint32_t i = 0; i < 20; ++i)
                for (std::uint32_t d = 0; d < 8; d += 2) {
                    const Vec2 p = sampler.get2D(pixel, i, d), q = light.get2D(pixel, i, d);
                    for (const float u : {p.x, p.y, q.x, q.y, sampler.get1D(pixel, i, d)})
                        h = mixBits(h + std::bit_cast<std::uint32_t>(u));
                }
        hashes.push_back(h);
    }
    CHECK_EQUAL(hashes[0], 308064272465862955u);
    CHECK_EQUAL(hashes[1], 16246176520291533878u);
    CHECK_EQUAL(hashes[2], 3729994422216524204u);
    CHECK_EQUAL(hashes[3], 4612904241768452566u);
    CHECK_EQUAL(hashes[4], 10919435146941527414u);
    const Sampler sampler(SamplerKind::Sobol, 16, 1);
    CHECK_EQUAL(sampler.get2D(0, 0, 0).x, 0.108975887f);
    CHECK_EQUAL(sampler.get2D(0, 0, 0).y, 0.643454015f);
    CHECK_EQUAL(sampler.get1D(0, 0, kTimeDimension), 0.0261703134f);
    CHECK_EQUAL(mixBits(1), 0x5692161d100b05e5u);
}

// Lanes that make pairs make single numbers so.
TEST(sampler_number_is_half_of_a_pair) {
    for (const SamplerKind kind : {SamplerKind::Sobol, SamplerKind::ZSobol}) {
        const Sampler sampler(kind, 16, 5);
        for (std::uint32_t pixel = 0; pixel < 300; pixel += 7)
            for (std::uint32_t i = 0; i < 40; ++i)
                for (std::uint32_t d = 0; d < 20; ++d)
                    CHECK_EQUAL(sampler.get2D(pixel, i, Sampler::alone(d)).x,
                                sampler.get1D(pixel, i, d));
    }
}

} // namespace test_sampler
