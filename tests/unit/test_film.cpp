// Sums of samples: two pixels at a time as one after the other, and what is no number left out.
#include "check.h"
#include "render/film.h"

#include <bit>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace test_film {

namespace {

bool areSame(const Film::Place& a, const Film::Place& b) {
    const auto same = [](double x, double y) {
        return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
    };
    return a.count == b.count && same(a.sum.x, b.sum.x) && same(a.sum.y, b.sum.y) &&
           same(a.sum.z, b.sum.z);
}

Film filmOfTwo() {
    Film film;
    film.reset(2, 1);
    return film;
}

} // namespace

// Bit by bit, for numbers of samples that fill registers and that don't, in one go and in several.
TEST(film_sums_of_two_are_those_of_each) {
    constexpr unsigned kSeed = 20;
    std::mt19937 random(kSeed);
    std::uniform_real_distribution<float> value(-1, 4);
    for (std::size_t each = 1; each <= 40; ++each) {
        Film together = filmOfTwo(), apart = filmOfTwo();
        for (int go = 0; go < 3; ++go) {
            std::vector<Rgb> values(2 * each);
            for (Rgb& c : values) c = {value(random), value(random), value(random)};
            values[random() % values.size()].g = -0.0f;
            const std::span<const Rgb> all(values);
            CHECK_EQUAL(together.addNumbersOfTwo(0, 0, all), 0u);
            for (int x : {0, 1})
                for (std::size_t i = 0; i < each; ++i)
                    apart.add(x, 0, values[each * static_cast<std::size_t>(x) + i]);
        }
        for (int x : {0, 1})
            CHECK_INFO(areSame(together.at(x, 0), apart.at(x, 0)),
                       each << " samples, place " << x << ", seed " << kSeed);
    }
}

// One odd sample of either place, in any component: left out if r + g + b is no number, else kept.
TEST(film_leaves_out_what_is_no_number) {
    struct Odd {
        Rgb value;
        bool isNumber;
    };
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kMost = 3.4e38f,
                    kInf = std::numeric_limits<float>::infinity();
    const Odd odds[] = {
        {{kNan, 1, 1}, false},     {{1, kInf, 1}, false},      {{1, 1, -kInf}, false},
        {{kInf, 0, -kInf}, false}, {{kMost, kMost, 0}, false}, {{0, -kMost, -kMost}, false},
        {{kMost, 0, 0}, true},     {{0, kMost, -kMost}, true}, {{1e-45f, -1e38f, 0}, true}};
    constexpr std::size_t kEach = 5;
    for (const Odd& odd : odds)
        for (std::size_t at = 0; at < 2 * kEach; ++at) {
            std::vector<Rgb> values(2 * kEach, Rgb{0.25f, 0.5f, 2});
            values[at] = odd.value;
            Film film = filmOfTwo(), expected = filmOfTwo();
            CHECK_EQUAL(film.addNumbersOfTwo(0, 0, values), odd.isNumber ? 0u : 1u);
            for (std::size_t i = 0; i < values.size(); ++i)
                if (i != at || odd.isNumber) expected.add(i < kEach ? 0 : 1, 0, values[i]);
            for (int x : {0, 1})
                CHECK_INFO(areSame(film.at(x, 0), expected.at(x, 0)),
                           "sample " << at << " of " << odd.value.r << ' ' << odd.value.g << ' '
                                     << odd.value.b);
        }
}

} // namespace test_film
