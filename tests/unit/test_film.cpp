// Sums of samples in whole numbers: the same for any order and any division, right to 2^-41 units a
// sample, and without what is no number.
#include "check.h"
#include "film/film.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace test_film {

namespace {

Film filmOf(double perUnit) {
    Film film;
    film.reset(1, 1, perUnit);
    return film;
}

// Samples as renders have them: most below 4, some black, some very bright or dark.
std::vector<Rgb> someSamples(std::mt19937& random, std::size_t count, bool withExtremes) {
    std::uniform_real_distribution<float> value(-1, 4), power(-30, 30);
    std::vector<Rgb> samples(count);
    for (Rgb& c : samples) {
        const float factor = withExtremes && random() % 4 == 0 ? std::exp2(power(random)) : 1;
        c = {value(random) * factor, value(random) * factor, value(random) * factor};
        if (random() % 5 == 0) c = {0, -0.0f, 0};
    }
    return samples;
}

} // namespace

TEST(film_sums_know_no_order) {
    constexpr unsigned kSeed = 20;
    std::mt19937 random(kSeed);
    for (int n = 0; n < 300; ++n) {
        const double perUnit = std::ldexp(1.0, static_cast<int>(random() % 41) - 20);
        std::vector<Rgb> samples = someSamples(random, 1 + random() % 200, n % 2 == 0);
        Film all = filmOf(perUnit), oneByOne = filmOf(perUnit), divided = filmOf(perUnit);
        CHECK_EQUAL(all.addNumbers(0, 0, samples), 0u);
        std::shuffle(samples.begin(), samples.end(), random);
        for (const Rgb& sample : samples) oneByOne.add(0, 0, sample);
        for (std::span<const Rgb> rest(samples); !rest.empty();) {
            const auto some = rest.first(1 + random() % rest.size());
            Film part = filmOf(perUnit);
            part.addNumbers(0, 0, some);
            divided.add(part, 0, 0);
            rest = rest.subspan(some.size());
        }
        for (const Film* other : {&oneByOne, &divided})
            CHECK_INFO(other->at(0, 0).sum == all.at(0, 0).sum &&
                           other->at(0, 0).count == samples.size(),
                       "seed " << kSeed << " round " << n);
    }
}

// Against sums in long double, whose 64 bits hold a million samples below 16 exactly.
TEST(film_sums_are_right) {
    constexpr unsigned kSeed = 21;
    std::mt19937 random(kSeed);
    for (int n = 0; n < 100; ++n) {
        const std::vector<Rgb> samples = someSamples(random, 1 + random() % 2000, false);
        Film film = filmOf(1);
        film.addNumbers(0, 0, samples);
        long double sum = 0;
        for (const Rgb& c : samples) sum += static_cast<long double>(c.g);
        const auto count = static_cast<double>(samples.size());
        CHECK_NEAR(film.at(0, 0).sum.value().y, static_cast<double>(sum), count * 0x1p-41);
        CHECK_NEAR(film.mean(0, 0).g, static_cast<double>(sum) / count, 1e-6);
    }
    // Floats of 2^-16 units and above come back as they are, alone and a hundred times.
    std::uniform_real_distribution<float> digits(1, 2);
    for (int power = -16; power < 36; ++power)
        for (const double perUnit : {1.0, 0x1p-20, 0x1p20}) {
            const float v = std::ldexp(digits(random), power) / static_cast<float>(perUnit);
            Film film = filmOf(perUnit);
            film.addToAll({v, -v, 0}, 100);
            film.add(0, 0, {v, -v, 0});
            CHECK(film.mean(0, 0) == (Rgb{v, -v, 0}));
            CHECK((WholeSum::rounded({v, -v, -0.0f}, perUnit) == Rgb{v, -v, 0}));
        }
    CHECK((WholeSum::rounded({1e-20f, 3e30f, -3e30f}, 1) == Rgb{0, 0x1p36f, -0x1p36f}));
    // What is below has the nearest of the whole numbers, as a mean of one sample has it.
    Film small = filmOf(1);
    const Rgb dark{0x1.234568p-20f, 0x1.8p-41f, 0x1p-42f};
    small.add(0, 0, dark);
    CHECK(small.mean(0, 0) == WholeSum::rounded(dark, 1));
    CHECK_EQUAL(small.mean(0, 0).g, 0x1p-40f);
    CHECK_EQUAL(small.mean(0, 0).b, 0.0f);
}

// One odd sample, in any component: left out if r + g + b is no number, else kept.
TEST(film_leaves_out_what_is_no_number) {
    struct Odd {
        Rgb value;
        bool isNumber;
    };
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kLargest = 3.4e38f,
                    kInf = std::numeric_limits<float>::infinity();
    const Odd odds[] = {{{kNan, 1, 1}, false},
                        {{1, kInf, 1}, false},
                        {{1, 1, -kInf}, false},
                        {{kInf, 0, -kInf}, false},
                        {{kLargest, kLargest, 0}, false},
                        {{0, -kLargest, -kLargest}, false},
                        {{kLargest, 0, 0}, true},
                        {{0, kLargest, -kLargest}, true},
                        {{1e-45f, -1e38f, 0}, true}};
    constexpr std::size_t kCount = 10;
    for (const Odd& odd : odds)
        for (std::size_t at = 0; at < kCount; ++at) {
            std::vector<Rgb> values(kCount, Rgb{0.25f, 0.5f, 2});
            values[at] = odd.value;
            Film film = filmOf(1), expected = filmOf(1);
            CHECK_EQUAL(film.addNumbers(0, 0, values), odd.isNumber ? 0u : 1u);
            for (std::size_t i = 0; i < values.size(); ++i)
                if (i != at || odd.isNumber) expected.add(0, 0, values[i]);
            CHECK_INFO(film.at(0, 0).sum == expected.at(0, 0).sum &&
                           film.at(0, 0).count == expected.at(0, 0).count,
                       "sample " << at << " of " << odd.value.r << ' ' << odd.value.g << ' '
                                 << odd.value.b);
        }
}

} // namespace test_film
